#include "tests/conformance/cases.h"

#include <memory>
#include <utility>

#include "tests/conformance/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using Offsets = std::vector<Vec3>;  // per body

// Moves whole bodies: every frame gives each body's place and what is true there.
struct Pose {
  Offsets offsets;
  CaseTruth truth;
};

FrameData frame_at(const std::vector<Body>& bodies, const Offsets& offsets) {
  std::vector<std::vector<Vec3>> nodes;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    nodes.push_back(rest_nodes_at(*bodies[b].shape, offsets[b]));
  return make_frame(bodies, std::move(nodes));
}

Case placed(std::string name, std::vector<Body> bodies, const std::vector<Pose>& poses) {
  Case out{std::move(name), std::move(bodies), {}, {}};
  for (const Pose& pose : poses) {
    out.frames.push_back(frame_at(out.bodies, pose.offsets));
    out.truth.push_back(pose.truth);
  }
  return out;
}

// Two bodies, the first of which stays at the origin.
Case pair_at(std::string name, TriangleMesh still, TriangleMesh moved, const Vec3& offset,
             const CaseTruth& truth) {
  return placed(std::move(name),
                {exact_body("still", std::move(still)), exact_body("moved", std::move(moved))},
                {{{Vec3::Zero(), offset}, truth}});
}

TriangleMesh ball_mesh(int levels) { return sphere_mesh(Vec3::Zero(), kHalfSide, levels); }

std::vector<Case> few_bodies() {
  const Body cube = exact_body("cube", cube_mesh(2));
  return {placed("empty-scene", {}, {{{}, {}}}),
          placed("one-body", {cube}, {{{Vec3::Zero()}, {}}, {{Vec3(0.5, 0, 0)}, {}}})};
}

std::vector<Case> touching() {
  return {
      pair_at("touching-vertex-vertex", octahedron_mesh(), octahedron_mesh(), Vec3(2, 0, 0),
              {1, 16, 0, 0}),
      // The tip meets the inside of one triangle of the cube's face x = 1.
      pair_at("touching-vertex-face", octahedron_mesh(), cube_mesh(1), Vec3(2, 0.5, 0.25),
              {1, 4, 0, 0}),
      pair_at("touching-edge-edge", tetrahedron_mesh(), tetrahedron_mesh(), Vec3(0, 0, 2),
              {1, 4, 0, 0}),
      pair_at("coplanar-overlap", cube_mesh(2), cube_mesh(2), Vec3(2, 0.75, 0.25), {1, 51, 0, 0})};
}

std::vector<Case> overlapping() {
  const Body ball = make_body("ball", ball_mesh(2), {4, 4, 4}, 0.5);
  return {
      placed("crossing", {ball, ball},
             {{{Vec3::Zero(), Vec3(1.5, 0.25, 0.125)}, {1, 36, 0, 16}},
              {{Vec3::Zero(), Vec3(0.75, 0.5, 0.25)}, {1, 52, 0, 36}}}),
      pair_at("coincident", cube_mesh(4), cube_mesh(4), Vec3::Zero(), {1, 2448, 0, 0}),
      placed("coincident-balls", {ball, ball}, {{{Vec3::Zero(), Vec3::Zero()}, {1, 1616, 0, 0}}})};
}

std::vector<Case> separate() {
  return {
      pair_at("containment", cube_mesh(2), scaled(cube_mesh(2), 0.25), Vec3(0.25, 0.125, 0),
              {0, 0, 1, 26}),
      pair_at("far-apart", cube_mesh(2), octahedron_mesh(), Vec3(1024, 512, 0), {}),
      // Faces in one plane, the rims 1/2 apart.
      pair_at("coplanar-apart", cube_mesh(2), cube_mesh(2), Vec3(2.5, 0, 0), {}),
      // The boxes of the two overlap by far.
      pair_at("diagonal-neighbours", octahedron_mesh(), octahedron_mesh(), Vec3(1, 1, 0.25), {}),
      pair_at("gap-of-a-billionth", cube_mesh(2), cube_mesh(2), Vec3(2 + 0x1p-30, 0, 0), {})};
}

std::vector<Case> many() {
  const Body ball = make_body("ball", ball_mesh(1), {4, 4, 4}, 0.5);
  const std::vector<Body> bodies(8, ball);
  Offsets coincident(8, Vec3::Zero()), grid, apart;
  for (int c = 0; c < 8; ++c) {
    const Vec3 corner(c & 1, c >> 1 & 1, c >> 2 & 1);
    grid.push_back(1.75 * corner);
    apart.push_back(3.0 * corner);
  }
  return {placed("eight-identical-coincident", bodies, {{coincident, {28, 10304, 0, 0}}}),
          placed("eight-identical-spread", bodies, {{grid, {12, 144, 0, 24}}, {apart, {}}})};
}

// A cube of 12 triangles of which the middle lines of nodes are pulled away: no vertex hangs on
// these, so the surface stays where it is and the boxes of the middle cells leave it.
Case long_triangles() {
  Case out = placed("long-triangles",
                    {exact_body("cube", cube_mesh(1)), exact_body("ball", octahedron_mesh())},
                    {{{Vec3::Zero(), Vec3(0, 0, 1.75)}, {1, 6, 0, 1}}});
  std::vector<std::vector<Vec3>> nodes = out.frames[0].nodes;
  const Lattice& lattice = *out.bodies[0].shape->lattice;
  for (std::size_t n = 0; n < nodes[0].size(); ++n)
    if (lattice.nodes[n][1] == 2) nodes[0][n] += Vec3(0, 0, -8);
  out.frames[0] = make_frame(out.bodies, std::move(nodes));
  return out;
}

// The first body is turned inside out by its nodes: a mirror image.
Case inside_out() {
  Case out =
      pair_at("inside-out", ball_mesh(1), cube_mesh(2), Vec3(1.5, 0.25, 0.125), {1, 22, 0, 6});
  std::vector<std::vector<Vec3>> nodes = out.frames[0].nodes;
  for (Vec3& n : nodes[0]) n.x() = -n.x();
  out.frames[0] = make_frame(out.bodies, std::move(nodes));
  return out;
}

std::vector<Case> degenerate() {
  const Vec3 origin = Vec3::Zero();
  const Body cube = exact_body("cube", cube_mesh(2)), ball = exact_body("ball", octahedron_mesh());
  return {
      // The segment goes through the face x = 0.875, the point lies on it; then all are apart.
      placed("zero-area-triangles", {exact_body("bad", mesh_with_degenerate_triangles()), cube},
             {{{origin, Vec3(1.875, 0.25, 0.125)}, {1, 13, 0, 2}}, {{origin, Vec3(4, 0, 0)}, {}}}),
      // The lone vertex would be inside the cube, the surface is outside; then that crosses it.
      placed("isolated-vertex", {exact_body("bad", mesh_with_isolated_vertex()), cube},
             {{{origin, Vec3::Constant(1.75)}, {0, 0, 0, 0}},
              {{origin, Vec3(1.75, 0.25, 0.125)}, {1, 10, 0, 1}}}),
      // Through the opening without contact, round the place of a vertex that the lid alone used;
      // then through the wall.
      placed("open-mesh",
             {exact_body("bowl", open_mesh()), exact_body("ball", scaled(octahedron_mesh(), 0.25))},
             {{{origin, Vec3(1, 0.125, 0)}, {0, 0, 0, 0}},
              {{origin, Vec3(-1, 0.25, 0.125)}, {1, 20, 0, 0}}}),
      // Between the components without contact; then into the second one.
      placed("two-components",
             {exact_body("two", mesh_of_two_components()),
              exact_body("ball", scaled(octahedron_mesh(), 0.25))},
             {{{origin, origin}, {}}, {{origin, Vec3(0.25, 0.5, 0.375)}, {1, 10, 0, 2}}}),
      long_triangles(), inside_out()};
}

Case of_size(const std::string& name, double factor, const CaseTruth& meeting) {
  const Body ball = make_body("ball", scaled(ball_mesh(2), factor), {4, 4, 4}, 0.5);
  return placed(name, {ball, ball},
                {{{Vec3::Zero(), factor * Vec3(1.5, 0.25, 0.125)}, meeting},
                 {{Vec3::Zero(), factor * Vec3(2.25, 0, 0)}, {}}});
}

std::vector<Case> sizes() {
  const Vec3 away(0x1p20, -0x1p19, 0x1p18);
  const Body cube = exact_body("cube", cube_mesh(2));
  return {of_size("triangles-of-a-centimetre", 0x1p-5, {1, 36, 0, 16}),
          of_size("a-millimetre-wide", 0x1p-10, {1, 36, 0, 16}),
          of_size("a-micrometre-wide", 0x1p-20, {1, 36, 0, 16}),
          of_size("a-thousand-kilometres-wide", 0x1p20, {1, 36, 0, 16}),
          placed("touching-far-from-the-origin", {cube, cube},
                 {{{away, away + Vec3(2, 0.75, 0.25)}, {1, 51, 0, 0}},
                  {{away, away + Vec3(2.5, 0.75, 0.25)}, {}}})};
}

std::vector<Vec3> deformed(TriangleSource& random, const BodyShape& shape, const Vec3& at) {
  std::vector<Vec3> nodes = rest_nodes_at(shape, at);
  for (Vec3& n : nodes) n = random.point(n, 0.2);
  return nodes;
}

Case moving() {
  TriangleSource random(314);
  Case out{"moving", {}, {}, {}};
  out.bodies = {make_body("ball", ball_mesh(2), {4, 4, 4}),
                make_body("cube", cube_mesh(3), {3, 3, 3}),
                make_body("fine ball", ball_mesh(3), {5, 4, 3})};
  for (int f = 0; f < 6; ++f) {
    const double gap = 2.75 - 0.4 * f;
    std::vector<std::vector<Vec3>> nodes;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(gap, 0.25, 0.1), Vec3(0.5 * gap, gap, 0.3)})
      nodes.push_back(deformed(random, *out.bodies[nodes.size()].shape, at));
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
  }
  out.truth = {{}, {}, {2, 52, 0, 27}, {3, 156, 0, 88}, {3, 224, 0, 170}, {3, 264, 0, 264}};
  return out;
}

std::vector<Case> every_case() {
  std::vector<Case> out;
  for (CaseGroup group :
       {CaseGroup::kFew, CaseGroup::kTouching, CaseGroup::kOverlapping, CaseGroup::kSeparate,
        CaseGroup::kMany, CaseGroup::kDegenerate, CaseGroup::kSizes})
    for (Case& c : cases_of(group)) out.push_back(std::move(c));
  out.push_back(moving_case());
  return out;
}

}  // namespace

std::vector<Case> cases_of(CaseGroup group) {
  switch (group) {
    case CaseGroup::kFew:
      return few_bodies();
    case CaseGroup::kTouching:
      return touching();
    case CaseGroup::kOverlapping:
      return overlapping();
    case CaseGroup::kSeparate:
      return separate();
    case CaseGroup::kMany:
      return many();
    case CaseGroup::kDegenerate:
      return degenerate();
    case CaseGroup::kSizes:
      return sizes();
  }
  return {};
}

std::size_t count_of(const Case& scene, Moment of) {
  const std::size_t frames = scene.frames.size();
  return of == Moment::kFrame ? frames : frames - (frames > 0 ? 1 : 0);
}

// These are made once: the lifecycle checks ask for them again and again.
const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = every_case();
  return cases;
}

const Case& moving_case() {
  static const Case scene = moving();
  return scene;
}

}  // namespace contactcheck::test
