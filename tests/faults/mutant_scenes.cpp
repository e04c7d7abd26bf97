#include "tests/faults/mutant_scenes.h"

#include <cmath>
#include <memory>

#include "tests/core/detect/bare_scenes.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

std::vector<Vec3> shaken(TriangleSource& random, std::vector<Vec3> nodes, double strength) {
  for (Vec3& n : nodes) n = random.point(n, strength);
  return nodes;
}

Scene with_nodes(std::vector<Body> bodies, std::vector<std::vector<std::vector<Vec3>>> frames) {
  Scene scene;
  scene.bodies = std::move(bodies);
  for (std::vector<std::vector<Vec3>>& nodes : frames)
    scene.frames.push_back(make_frame(scene.bodies, std::move(nodes)));
  return scene;
}

// The nodes of a box in one cell that has its corner `at` the given point and lies on one side of
// it along every axis: `side` below 0 below, else above, and about this long. Shaken ones stay on
// that side.
std::vector<Vec3> box_at_corner(TriangleSource& random, const Vec3& at, double side, bool shake) {
  const int touching = side < 0 ? 7 : 0;
  Vec3 edge;
  for (int k = 0; k < 3; ++k) edge[k] = 1.0 + 0.5 * random.unit();
  std::vector<Vec3> nodes(8, at);
  for (int c = 0; c < 8; ++c)
    for (int k = 0; k < 3; ++k) {
      const double away = (c >> k & 1) == (touching >> k & 1) ? 0.0 : edge[k];
      const double more = shake && c != touching ? 0.2 * std::abs(random.unit()) : 0.0;
      nodes[static_cast<std::size_t>(c)][k] = at[k] + side * (away + more);
    }
  return nodes;
}

// The box [0, 1]^3 in a lattice of one cell that is no larger: its corners are the nodes, to the
// last bit. (make_lattice() leaves some room.)
std::shared_ptr<const BodyShape> box_of_one_cell() {
  return make_shape_on_lines(unit_box_mesh(2), {{{0, 1}, {0, 1}, {0, 1}}});
}

// Two boxes that share one corner to the last bit, or miss each other by one unit in the last place
// of one coordinate. Nothing is as tight for spheres, boxes and slacks. `size` is that of the
// second one beside the first, below it and above: far below 1, each has a frame of its own.
Scene boxes_at_corners(std::uint64_t seed, double size) {
  TriangleSource random(seed);
  const std::shared_ptr<const BodyShape> box = box_of_one_cell();
  std::vector<Body> bodies = {{"first", box}, {"second", box}};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (int f = 0; f < 48; ++f) {
    const double offset = f % 3 == 0 ? 0.0 : f % 3 == 1 ? 10.0 : 1e6;
    const Vec3 corner = random.point(Vec3::Constant(offset), 1.0);
    Vec3 other = corner;
    if (f % 4 == 3) other[f % 3] = std::nextafter(other[f % 3], 1e300);
    std::vector<Vec3> first = box_at_corner(random, corner, f % 8 < 4 ? -1.0 : 1.0, f % 2 == 0);
    const double side = f % 8 < 4 ? size : -size;
    frames.push_back({std::move(first), box_at_corner(random, other, side, f % 2 == 0)});
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// Twenty-four small bodies: strung out along each axis in turn, then all in one heap.
Scene many_bodies() {
  TriangleSource random(92);
  std::vector<Body> bodies;
  for (int b = 0; b < 24; ++b)
    bodies.push_back(
        make_body("body " + std::to_string(b), sphere_mesh(Vec3::Zero(), 0.5, 1), {2, 2, 2}));
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (int f = 0; f < 4; ++f) {
    Vec3 room = Vec3::Constant(f < 3 ? 0.9 : 0.3);
    if (f < 3) room[f] = 8.0;
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : bodies) {
      const Vec3 at = random.point(Vec3::Zero(), 1.0).cwiseProduct(room);
      nodes.push_back(shaken(random, rest_nodes_at(*body.shape, at), 0.1));
    }
    frames.push_back(std::move(nodes));
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// Enough triangles per cell for bounds from nodes, and enough of them for three levels of blocks.
Scene fine_spheres() {
  TriangleSource random(93);
  const TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 4);
  std::vector<Body> bodies = {make_body("left", mesh, {3, 3, 3}),
                              make_body("right", mesh, {2, 3, 2})};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (double gap : {1.97, 1.7, 0.4}) {
    const Vec3 at(gap, 0.1, -0.2);
    frames.push_back({shaken(random, rest_nodes_at(*bodies[0].shape, Vec3::Zero()), 0.12),
                      shaken(random, rest_nodes_at(*bodies[1].shape, at), 0.12)});
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// One node after the other is pulled far away along a diagonal: what moves with it and what does
// not is as far apart as bounds by weights allow.
Scene pulled_nodes() {
  const TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 1);
  std::vector<Body> bodies = {make_body("still", mesh, {2, 2, 2}),
                              make_body("pulled", mesh, {2, 2, 2})};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (std::size_t node = 0; node < bodies[1].shape->node_count(); node += 2) {
    std::vector<Vec3> pulled = rest_nodes_at(*bodies[1].shape, Vec3(1.5, 0.1, 0.2));
    pulled[node] += Vec3(-20, 20, node % 4 == 0 ? 20 : -20);
    frames.push_back({rest_nodes_at(*bodies[0].shape, Vec3::Zero()), std::move(pulled)});
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// A sliver of which two corners have one home: nodes there move two corners with nearly all their
// weight, and the third one not at all.
Scene pulled_slivers() {
  const TriangleMesh mesh = triangle_mesh({0, 0, 0}, {3, 1, 1}, {0.1, 0.05, 0.02});
  std::vector<Body> bodies = {make_body("still", mesh, {3, 1, 1}, 0.0),
                              make_body("pulled", mesh, {3, 1, 1}, 0.0)};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (std::size_t node = 0; node < bodies[1].shape->node_count(); ++node) {
    std::vector<Vec3> pulled = rest_nodes_at(*bodies[1].shape, Vec3(0, 0, 0.1));
    pulled[node] += Vec3(-2e3, 1e3, -3e3);
    frames.push_back({rest_nodes_at(*bodies[0].shape, Vec3::Zero()), std::move(pulled)});
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// Both bodies pressed into one plane: mapped vertices leave it by their rounding, and boxes made
// from nodes have no extent to spare.
Scene flattened() {
  TriangleSource random(95);
  const TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 1);
  std::vector<Body> bodies = {make_body("one", mesh, {3, 3, 3}),
                              make_body("other", mesh, {3, 2, 3})};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (int f = 0; f < 6; ++f) {
    std::vector<std::vector<Vec3>> nodes;
    const double plane = 0.1 + random.unit();
    for (const Body& body : bodies) {
      Vec3 at = random.point(Vec3::Zero(), 0.5);
      nodes.push_back(shaken(random, rest_nodes_at(*body.shape, at), 0.1));
      for (Vec3& n : nodes.back()) n[f % 3] = plane;
    }
    frames.push_back(std::move(nodes));
  }
  return with_nodes(std::move(bodies), std::move(frames));
}

// A triangle far larger than the others: it meets more buckets of any grid than are allowed.
Scene large_triangle() {
  TriangleSource random(94);
  TriangleMesh sheet = triangle_mesh({-9, -8, 0.1}, {10, -7, 0.2}, {0, 11, -0.1});
  std::vector<Body> bodies = {
      make_body("sheet", std::move(sheet), {6, 6, 1}),
      make_body("box", box_mesh(Vec3::Constant(-0.5), Vec3::Constant(0.5), 6), {3, 3, 3})};
  std::vector<std::vector<std::vector<Vec3>>> frames;
  for (int f = 0; f < 3; ++f)
    frames.push_back({shaken(random, rest_nodes_at(*bodies[0].shape, Vec3::Zero()), 0.05),
                      shaken(random, rest_nodes_at(*bodies[1].shape, Vec3(f, -f, 0)), 0.05)});
  return with_nodes(std::move(bodies), std::move(frames));
}

// Triangles beside others that touch them in corners, edges and planes, or by an ulp do not.
std::vector<TriangleMesh> near_degenerate_soups(std::uint64_t seed, double scale,
                                                const Vec3& offset) {
  TriangleSource random(seed);
  std::vector<TrianglePoints> first, second;
  for (int i = 0; i < 150; ++i) {
    const Vec3 at = scale * random.point(Vec3::Zero(), 3.0) + offset;
    first.push_back(random.triangle(at, scale));
    second.push_back(random.near_degenerate_partner(first.back(), scale));
  }
  return {soup(first), soup(second)};
}

std::vector<TriangleMesh> grid_soups(std::uint64_t seed, double scale, const Vec3& offset) {
  TriangleSource random(seed);
  return {scaled(grid_soup(random, 90, 2), scale, offset),
          scaled(grid_soup(random, 90, 2), scale, offset)};
}

void add_bare_scenes(std::vector<MutantScene>& out) {
  const auto add = [&](const std::string& name, const std::vector<TriangleMesh>& meshes) {
    out.push_back({name, still(meshes), false});
  };
  add("grid-soup", grid_soups(81, 1.0, Vec3::Zero()));
  add("grid-soup-1e-9", grid_soups(82, 1e-9, Vec3::Zero()));
  add("grid-soup-1e9", grid_soups(83, 1e9, Vec3::Constant(-3e9)));
  add("near-degenerate", near_degenerate_soups(84, 1.0, Vec3::Zero()));
  add("near-degenerate-1e-9", near_degenerate_soups(85, 1e-9, Vec3::Zero()));
  add("near-degenerate-1e9", near_degenerate_soups(86, 1e9, Vec3::Zero()));
  add("near-degenerate-far", near_degenerate_soups(87, 1.0, Vec3(1e6, -1e6, 1e6)));
  TriangleSource random(88);
  const TriangleMesh other = generic_soup(random, 120);
  add("generic-soup", {generic_soup(random, 120), other});
}

void add_approaches(std::vector<MutantScene>& out) {
  const auto add = [&](const std::string& name, std::uint64_t seed, double scale,
                       const Vec3& offset) {
    SceneSettings settings;
    settings.seed = seed, settings.scale = scale, settings.offset = offset;
    out.push_back({name, approach(settings, 4), true});
  };
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    add("approach-" + std::to_string(seed), seed, 1.0, Vec3::Zero());
  add("approach-1e-9", 7, 1e-9, Vec3::Zero());
  add("approach-1e9", 8, 1e9, Vec3::Zero());
  add("approach-far", 9, 1.0, Vec3(1e6, -1e6, 1e6));
}

}  // namespace

std::vector<MutantScene> mutant_scenes() {
  std::vector<MutantScene> scenes;
  add_approaches(scenes);
  for (std::uint64_t seed : {11u, 12u}) {
    SceneSettings settings;
    settings.seed = seed;
    scenes.push_back({"three-bodies-" + std::to_string(seed), three_bodies(settings), true});
  }
  scenes.push_back({"exact-boxes", exact_boxes(Vec3::Zero()), true});
  scenes.push_back({"exact-boxes-shifted", exact_boxes(Vec3(-101, 57, -33)), true});
  scenes.push_back({"boxes-at-corners", boxes_at_corners(91, 1.0), true});
  scenes.push_back({"small-box-at-a-corner", boxes_at_corners(96, 0.001), true});
  scenes.push_back({"pulled-nodes", pulled_nodes(), true});
  scenes.push_back({"pulled-slivers", pulled_slivers(), true});
  scenes.push_back({"flattened", flattened(), true});
  scenes.push_back({"many-bodies", many_bodies(), true});
  scenes.push_back({"fine-spheres", fine_spheres(), true});
  scenes.push_back({"large-triangle", large_triangle(), true});
  add_bare_scenes(scenes);
  for (MutantScene& s : scenes)
    for (FrameData& frame : s.scene.frames)
      for (std::size_t b = 0; b < s.scene.bodies.size(); ++b)
        frame.vertices[b] = plainly_mapped(*s.scene.bodies[b].shape, frame.nodes[b]);
  return scenes;
}

}  // namespace contactcheck::test
