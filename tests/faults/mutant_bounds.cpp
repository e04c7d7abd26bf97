// Mapped values and the volumes round them.
#include <algorithm>
#include <limits>
#include <memory>

#include "core/broad/aabb_tree.h"
#include "core/broad/bd_tree.h"
#include "core/broad/triangle_sphere_tree.h"
#include "core/deform/mapping.h"
#include "core/detect/ffd_detector.h"
#include "core/detect/lazy_detector.h"
#include "core/dynamics/ground.h"
#include "core/lazy/kernels.h"
#include "tests/core/detect/safe_config.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

double plain_blend(double a, double b, double w) {
  const double kept = a * (1.0 - w), added = b * w;
  return kept + added;
}

Vec3 plainly_mapped(const std::array<Vec3, 8>& corners, const Vec3& local) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    double x[8];
    for (std::size_t c = 0; c < 8; ++c) x[c] = corners[c][k];
    for (int axis = 0, left = 4; axis < 3; ++axis, left /= 2)
      for (int i = 0; i < left; ++i) x[i] = plain_blend(x[2 * i], x[2 * i + 1], local[axis]);
    out[k] = x[0];
  }
  return out;
}

std::array<Vec3, 8> corners_of_cell(const BodyShape& shape, std::uint32_t cell,
                                    std::span<const Vec3> nodes) {
  std::array<Vec3, 8> corners;
  for (std::size_t c = 0; c < 8; ++c) corners[c] = nodes[shape.lattice->cell_nodes[cell][c]];
  return corners;
}

bool same_points(std::span<const Vec3> a, std::span<const Vec3> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

// One frame of one body, with what it is called.
struct BodyFrame {
  const BodyShape& shape;
  std::span<const Vec3> nodes, vertices;
  MutantCase named;
};

template <typename Check>
void for_bodies(const MutantScene& scene, const Check& check) {
  for (std::size_t f = 0; f < scene.scene.frames.size(); ++f)
    for (std::size_t b = 0; b < scene.scene.bodies.size(); ++b) {
      const FrameData& frame = scene.scene.frames[f];
      check(BodyFrame{*scene.scene.bodies[b].shape,
                      frame.nodes[b],
                      frame.vertices[b],
                      {scene.name, f, "", ""}});
    }
}

void enter(MutantFindings& out, const BodyFrame& body, const char* part, const char* level) {
  MutantCase named = body.named;
  named.detector = part, named.level = level;
  out.enter(named);
}

void check_mapped_vertices(const BodyFrame& body, MutantFindings& out) {
  enter(out, body, "map_vertices", "mapping");
  // What nobody writes is not to look right by chance.
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Vec3> mapped(body.vertices.size(), nowhere);
  map_body(body.shape, body.nodes, mapped);
  out.expect(same_points(mapped, body.vertices), "other bits than the canonical mapping");
}

void check_mapped_boxes(const BodyFrame& body, MutantFindings& out) {
  enter(out, body, "map_boxes", "mapping");
  TriangleSource random(61);
  std::vector<LocalBox> boxes;
  for (std::uint32_t cell = 0; cell < body.shape.lattice->cells.size(); ++cell) {
    LocalBox& box = boxes.emplace_back(LocalBox{cell, {}});
    for (int i = 0; i < 2; ++i) box.local.extend(random.point(Vec3::Constant(0.5), 0.5));
  }
  std::vector<Corners> corners(boxes.size());
  map_boxes(*body.shape.lattice, boxes, body.nodes, corners);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t c = 0; c < 8; ++c) {
      Vec3 local;
      for (int k = 0; k < 3; ++k)
        local[k] = c >> k & 1 ? boxes[i].local.hi[k] : boxes[i].local.lo[k];
      const auto cell = corners_of_cell(body.shape, boxes[i].home, body.nodes);
      if (corners[i][c] != plainly_mapped(cell, local))
        return out.add("a corner has other bits than the canonical mapping");
    }
}

void check_bd_tree(const BodyFrame& body, MutantFindings& out) {
  const auto model = make_bd_model(body.shape, 4);
  for (ReferenceKind reference : {ReferenceKind::kAffine, ReferenceKind::kNone}) {
    BdSettings settings;
    settings.reference = reference;
    settings.paper_bound = reference == ReferenceKind::kNone;
    BdTree tree(model, settings);
    tree.begin_frame(body.nodes);
    enter(out, body, "bd-tree", "spheres");
    out.expect(tree.validate().empty(), tree.validate());
    enter(out, body, "bd-tree", "mapping");
    for (std::uint32_t v = 0; v < body.vertices.size(); ++v)
      if (tree.vertex(v) != body.vertices[v])
        return out.add("a vertex has other bits than the canonical mapping");
  }
}

// All nodes in one point: all that a sphere of floats has to hold is the rounding of the mapping.
void check_single_bd_tree(const BodyFrame& body, MutantFindings& out) {
  enter(out, body, "bd-tree in floats", "spheres");
  BdTreeOf<float> tree(make_bd_model(body.shape, 4), {});
  const std::vector<Vec3> nodes(body.nodes.size(), Vec3f(0.1f, 0.2f, 0.3f).cast<double>());
  tree.begin_frame(nodes);
  const std::string fault = tree.validate();
  out.expect(fault.empty(), fault);
}

void check_mapped_leaves(const BodyFrame& body, MutantFindings& out) {
  enter(out, body, "ffd-lazy", "mapping");
  const LatticeTree tree = make_lattice_tree(body.shape, TreeUse::kNodes);
  std::vector<LazyState> states(1);
  LazyState& state = states[0];
  state.shape = &body.shape, state.tree = &tree;
  begin_frame_by_nodes(state, body.nodes);
  place(states);
  find_cells(state);
  FrameArena arena;
  for (std::uint32_t l = 0; l < tree.leaves.size(); ++l) {
    const LeafCache& leaf = lazy_kernels().map_leaf(state, l, arena);
    for (std::uint32_t i = 0; i < tree.leaves[l].vertices; ++i) {
      const Vec3 mapped(leaf.x[i], leaf.y[i], leaf.z[i]);
      if (mapped != body.vertices[tree.leaf_vertices[tree.leaves[l].first_vertex + i]])
        return out.add("a vertex of a leaf has other bits than the canonical mapping");
    }
  }
}

void check_triangle_trees(const BodyFrame& body, MutantFindings& out) {
  const auto tree = std::make_shared<TriangleTree>(make_triangle_tree(body.shape.mesh, 2));
  enter(out, body, "triangle tree", "slots");
  out.expect(tree->validate(body.shape.mesh).empty(), tree->validate(body.shape.mesh));
  AabbTree boxes(tree);
  boxes.refit(body.vertices);
  enter(out, body, "aabb-tree", "boxes");
  out.expect(boxes.validate(body.vertices).empty(), boxes.validate(body.vertices));
  Aabb all;
  for (const Triangle& t : body.shape.mesh.triangles)
    for (std::uint32_t v : t) all.extend(body.vertices[v]);
  out.expect(boxes.box(0).contains(all), "the root does not hold the body");
}

void check_lazy_bounds(const MutantScene& scene, MutantFindings& out) {
  for (BoundSource bounds : {BoundSource::kNodes, BoundSource::kVertices}) {
    LazyDetector detector({bounds, "best", 1});
    detector.prepare(scene.scene.bodies);
    for (std::size_t f = 0; f < scene.scene.frames.size(); ++f) {
      out.enter(
          {scene.name, f, bounds == BoundSource::kNodes ? "ffd-lazy" : "full-refit", "bounds"});
      detector.update(scene.scene.frames[f].frame(f));
      const std::string broken = detector.validate(scene.scene.frames[f].vertices);
      out.expect(broken.empty(), broken);
    }
  }
}

void check_family_bounds(const MutantScene& scene, CellVolume volume, MutantFindings& out) {
  FfdDetector detector(safe_config(volume, 3));
  detector.prepare(scene.scene.bodies);
  for (std::size_t f = 0; f < scene.scene.frames.size(); ++f) {
    const bool whole = volume == CellVolume::kLatticeCell;
    out.enter({scene.name, f, whole ? "ffd-grid+tri" : "ffd-aabb-sphereN+tri", "bounds"});
    detector.update(scene.scene.frames[f].frame(f));
    for (std::size_t b = 0; b < scene.scene.bodies.size(); ++b) {
      const std::string broken =
          validate(detector.models()[b], detector.states()[b], scene.scene.frames[f].vertices[b]);
      out.expect(broken.empty(), broken);
    }
  }
}

std::vector<std::uint32_t> plainly_held(const BodyFrame& body, const Ground& ground) {
  std::vector<std::uint32_t> held;
  for (std::uint32_t v = 0; v < body.vertices.size(); ++v)
    if (body.vertices[v][ground.axis] <= ground.height) held.push_back(v);
  return held;
}

}  // namespace

std::vector<Vec3> plainly_mapped(const BodyShape& shape, std::span<const Vec3> nodes) {
  if (!shape.lattice) return {nodes.begin(), nodes.end()};
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < shape.mesh.vertices.size(); ++v)
    out.push_back(plainly_mapped(corners_of_cell(shape, shape.embedding.home_cell[v], nodes),
                                 shape.embedding.local[v]));
  return out;
}

void check_mapping(const MutantScene& scene, MutantFindings& out) {
  for_bodies(scene, [&](const BodyFrame& body) {
    check_mapped_vertices(body, out);
    if (!body.shape.lattice) return;
    check_mapped_boxes(body, out);
    check_mapped_leaves(body, out);
    enter(out, body, "embedding", "rest");
    const std::vector<Vec3> rest = plainly_mapped(body.shape, body.shape.lattice->rest_nodes());
    const double size = bounding_box(body.shape.mesh.vertices).extent().maxCoeff();
    for (std::size_t v = 0; v < rest.size(); ++v)
      if (!((rest[v] - body.shape.mesh.vertices[v]).norm() <= 1e-12 * size))
        return out.add("a vertex at rest is not where the mesh has it");
  });
}

void check_bounds(const MutantScene& scene, MutantFindings& out) {
  for_bodies(scene, [&](const BodyFrame& body) {
    check_triangle_trees(body, out);
    if (!body.shape.lattice) return;
    check_bd_tree(body, out);
    check_single_bd_tree(body, out);
  });
  check_lazy_bounds(scene, out);
  if (!scene.lattices) return;
  for (CellVolume volume : {CellVolume::kLatticeCell, CellVolume::kFfdAabb})
    check_family_bounds(scene, volume, out);
}

void check_ground(const MutantScene& scene, MutantFindings& out) {
  for_bodies(scene, [&](const BodyFrame& body) {
    enter(out, body, "ground", "vertex");
    for (std::size_t v = 0; v < body.vertices.size(); v += 1 + body.vertices.size() / 8) {
      Ground ground;
      ground.axis = static_cast<int>(v % 3);
      ground.height = body.vertices[v][ground.axis];
      out.expect_same(plainly_held(body, ground),
                      vertices_in_ground(body.shape, body.nodes, ground));
    }
  });
}

}  // namespace contactcheck::test
