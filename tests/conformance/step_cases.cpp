// The cases of contact within steps. Places are short binary fractions, so that times are what the
// comments derive.
#include <utility>

#include "tests/conformance/cases.h"
#include "tests/conformance/meshes.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

using Offsets = std::vector<Vec3>;  // per body

// Moves whole bodies from offsets to offsets.
Case moved(std::string name, std::vector<Body> bodies, const std::vector<Offsets>& frames,
           std::vector<StepCaseTruth> steps) {
  Case out{std::move(name), std::move(bodies), {}, {}, std::move(steps)};
  for (const Offsets& offsets : frames) {
    std::vector<std::vector<Vec3>> nodes;
    for (std::size_t b = 0; b < out.bodies.size(); ++b)
      nodes.push_back(rest_nodes_at(*out.bodies[b].shape, offsets[b]));
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
  }
  return out;
}

// Two bodies, the first of which stays at the origin.
Case second_moves(std::string name, TriangleMesh still, TriangleMesh moving,
                  const std::vector<Vec3>& offsets, std::vector<StepCaseTruth> steps) {
  std::vector<Offsets> frames;
  for (const Vec3& offset : offsets) frames.push_back({Vec3::Zero(), offset});
  return moved(std::move(name),
               {exact_body("still", std::move(still)), exact_body("moving", std::move(moving))},
               frames, std::move(steps));
}

// Bodies without lattices, by their vertices.
Case by_vertices(std::string name, const std::vector<TriangleMesh>& meshes,
                 const std::vector<std::vector<std::vector<Vec3>>>& frames,
                 std::vector<StepCaseTruth> steps) {
  Case out{std::move(name), {}, {}, {}, std::move(steps)};
  for (const TriangleMesh& mesh : meshes) out.bodies.push_back({"bare", make_bare_shape(mesh)});
  for (const std::vector<std::vector<Vec3>>& places : frames)
    out.frames.push_back(make_frame(out.bodies, places));
  return out;
}

TriangleMesh small_octahedron() { return scaled(octahedron_mesh(), 0.25); }

std::vector<Case> meetings() {
  return {
      // Octahedra meet where the sum of the three distances is 2: at x = 1.625.
      second_moves("step-crossing", octahedron_mesh(), octahedron_mesh(),
                   {Vec3(2.625, 0.125, 0.25), Vec3(0.625, 0.125, 0.25)}, {{1, 9, 2, 2, 0, 0, 0.5}}),
      // The tip is at the face x = -1 a quarter of the way, and leaves by x = 1; then it is gone.
      second_moves("step-tunnel", cube_mesh(2), small_octahedron(),
                   {Vec3(-5.25, 0.125, 0.0625), Vec3(10.75, 0.125, 0.0625), Vec3(20, 0, 0)},
                   {{1, 52, 16, 28, 0, 0, 0.25}, {}}),
      second_moves("step-tunnel-fast", cube_mesh(2), small_octahedron(),
                   {Vec3(-1.25 - 0x1p20, 0.125, 0.0625), Vec3(-1.25 + 0x1p20, 0.125, 0.0625)},
                   {{1, 52, 16, 28, 0, 0, 0.5}}),
      // Past each other, neither of them still.
      moved("step-two-that-pass",
            {exact_body("left", octahedron_mesh()), exact_body("right", octahedron_mesh())},
            {{Vec3(-2.125, 0, 0), Vec3(0.5, 0.125, 0.25)},
             {Vec3(0.875, 0, 0), Vec3(-4.5, 0.125, 0.25)}},
            {{1, 36, 12, 22, 0, 0, 0.125}}),
      // Overlapping, deeper, and apart.
      second_moves("step-from-contact", octahedron_mesh(), octahedron_mesh(),
                   {Vec3(1.5, 0.125, 0.25), Vec3(0.75, 0.5, 0.125), Vec3(4, 0, 0)},
                   {{1, 8, 0, 0, 0, 0, 0}, {1, 9, 2, 2, 0, 0, 0}})};
}

std::vector<Case> touches() {
  return {
      // To the point of touching and away: at t = 1, and at t = 0.
      second_moves("step-touch-vertex-vertex", octahedron_mesh(), octahedron_mesh(),
                   {Vec3(4, 0, 0), Vec3(2, 0, 0), Vec3(4, 0, 0)},
                   {{1, 16, 8, 16, 0, 0, 1}, {1, 16, 8, 16, 0, 0, 0}}),
      second_moves("step-touch-vertex-face", octahedron_mesh(), cube_mesh(1),
                   {Vec3(4, 0.5, 0.25), Vec3(2, 0.5, 0.25), Vec3(4, 0.5, 0.25)},
                   {{1, 4, 1, 0, 0, 0, 1}, {1, 4, 1, 0, 0, 0, 0}}),
      second_moves("step-touch-edge-edge", tetrahedron_mesh(), tetrahedron_mesh(),
                   {Vec3(0, 0, 4), Vec3(0, 0, 2), Vec3(0, 0, 4)},
                   {{1, 4, 0, 1, 0, 0, 1}, {1, 4, 0, 1, 0, 0, 0}}),
      second_moves("step-touch-face-face", cube_mesh(2), cube_mesh(2),
                   {Vec3(3, 0.75, 0.25), Vec3(2, 0.75, 0.25), Vec3(3, 0.75, 0.25)},
                   {{1, 51, 8, 20, 0, 0, 1}, {1, 51, 8, 20, 0, 0, 0}}),
      // Tip past tip: they touch half-way and at no other time; then they miss by 2^-40.
      second_moves("step-graze", octahedron_mesh(), octahedron_mesh(),
                   {Vec3(2, -1, 0), Vec3(2, 1, 0)}, {{1, 16, 8, 16, 0, 0, 0.5}}),
      second_moves("step-miss", octahedron_mesh(), octahedron_mesh(),
                   {Vec3(2 + 0x1p-40, -1, 0), Vec3(2 + 0x1p-40, 1, 0)}, {{}}),
      // The face y = 1 slides in the plane of another's y = -1 until the rims touch, a quarter of
      // the way, and over it.
      second_moves("step-slide", cube_mesh(1), cube_mesh(1), {Vec3(2.5, 2, 0), Vec3(0.5, 2, 0)},
                   {{1, 44, 20, 47, 0, 0, 0.25}})};
}

std::vector<Case> stillness() {
  const Vec3 apart(3, 0.125, 0.25), touching(2, 0, 0), crossing(1.5, 0.125, 0.25);
  return {second_moves("step-no-motion", octahedron_mesh(), octahedron_mesh(),
                       {apart, apart, touching, touching, crossing, crossing},
                       {{},
                        {1, 16, 8, 16, 0, 0, 1},
                        {1, 16, 8, 16, 0, 0, 0},
                        {1, 16, 8, 16, 0, 0, 0},
                        {1, 8, 0, 0, 0, 0, 0}}),
          // Inside, to and fro without contact; to the wall at t = 1; out through it.
          second_moves("step-within", cube_mesh(2), scaled(cube_mesh(1), 0.25),
                       {Vec3(0.25, 0.125, 0), Vec3(-0.25, 0, 0.125), Vec3(0.75, 0, 0.125),
                        Vec3(4, 0, 0.125)},
                       {{}, {1, 23, 5, 8, 0, 0, 1}, {1, 38, 10, 22, 0, 0, 0}}),
          moved("step-empty-scene", {}, {{}, {}}, {{}}),
          moved("step-one-body", {exact_body("cube", cube_mesh(2))},
                {{Vec3::Zero()}, {Vec3(0.5, 0, 0)}}, {{}})};
}

// A triangle that falls through another and over its rim, corner first, a quarter of the way; then,
// as a segment, through one that is a point: half-way.
Case bare_triangles() {
  const TriangleMesh flat = triangle_mesh(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  const TriangleMesh upright =
      triangle_mesh(Vec3(0.5, 0.5, 1), Vec3(1.5, 1.5, 2), Vec3(0.75, 0.5, 2));
  std::vector<Vec3> below = upright.vertices, point = flat.vertices;
  for (Vec3& v : below) v.z() -= 4;
  for (Vec3& v : point) v = Vec3(0.5, 0.5, -1);
  return by_vertices("step-bare-triangles", {flat, upright},
                     {{flat.vertices, upright.vertices},
                      {flat.vertices, below},
                      {point, {Vec3(-1, 0.5, -3), Vec3(0, 0.5, -3), Vec3(3, 0.5, -3)}},
                      {point, {Vec3(0, 0.5, 1), Vec3(1, 0.5, 1), Vec3(2, 0.5, 1)}}},
                     {{1, 1, 2, 2, 0, 0, 0.25}, {}, {1, 1, 4, 9, 0, 0, 0.5}});
}

std::vector<Case> degenerate_steps() {
  const Vec3 origin = Vec3::Zero();
  const Body cube = exact_body("cube", cube_mesh(2));
  return {
      bare_triangles(),
      // The cube comes over the segment and the point, and goes on through all.
      moved("step-zero-area-triangles", {exact_body("bad", mesh_with_degenerate_triangles()), cube},
            {{origin, Vec3(4, 0.25, 0.125)},
             {origin, Vec3(1.875, 0.25, 0.125)},
             {origin, Vec3(-4, 0.25, 0.125)}},
            {{1, 13, 5, 3, 0, 0, 0.9411764706}, {1, 110, 28, 72, 0, 0, 0}}),
      // The lone vertex would pass the cube, the surface does not.
      moved("step-isolated-vertex", {exact_body("bad", mesh_with_isolated_vertex()), cube},
            {{origin, Vec3(4, 1.75, 1.75)}, {origin, Vec3(-0.5, 1.75, 1.75)}}, {{}}),
      // Through the opening and out by the wall.
      moved("step-open-mesh",
            {exact_body("bowl", open_mesh()), exact_body("ball", small_octahedron())},
            {{origin, Vec3(3, 0.125, 0)},
             {origin, Vec3(0.25, 0.125, 0)},
             {origin, Vec3(-3, 0.125, 0)}},
            {{0, 0, 0, 0, 13, 26}, {1, 34, 14, 28, 13, 26, 0.3076923077}})};
}

// An octahedron that its nodes turn inside out: half-way it is flat, and tip meets tip.
Case turned_inside_out() {
  Case out = moved("step-inside-out", {exact_body("ball", octahedron_mesh())},
                   {{Vec3::Zero()}, {Vec3::Zero()}}, {{0, 0, 0, 0, 8, 12}});
  std::vector<std::vector<Vec3>> nodes = out.frames[1].nodes;
  for (Vec3& n : nodes[0]) n.x() = -n.x();
  out.frames[1] = make_frame(out.bodies, std::move(nodes));
  return out;
}

std::vector<Case> own() {
  // Two triangles of one body, of which one falls through the other.
  TriangleMesh two = triangle_mesh(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  for (const Vec3& v : {Vec3(0.5, 0.5, 1), Vec3(1.5, 1.5, 2), Vec3(0.75, 0.5, 2)})
    two.vertices.push_back(v);
  two.triangles.push_back({3, 4, 5});
  std::vector<Vec3> fallen = two.vertices;
  for (std::size_t v = 3; v < 6; ++v) fallen[v].z() -= 4;
  // A strip of two triangles that folds about their edge: neighbours meet and are no contact, but
  // for the corners that do not hang on it.
  const TriangleMesh strip = {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(2, 2, 0)},
                              {{0, 1, 2}, {1, 3, 2}}};
  std::vector<Vec3> folded = strip.vertices;
  folded[3] = Vec3(-0.5, -0.5, 0);
  return {
      by_vertices("step-own-triangles", {two}, {{two.vertices}, {fallen}}, {{0, 0, 0, 0, 2, 2}}),
      by_vertices("step-fold", {strip}, {{strip.vertices}, {folded}}, {{0, 0, 0, 0, 2, 2}}),
      turned_inside_out()};
}

Case step_of_size(const std::string& name, double factor) {
  const Body ball = exact_body("ball", scaled(octahedron_mesh(), factor));
  return moved(name, {ball, ball},
               {{Vec3::Zero(), factor * Vec3(2.625, 0.125, 0.25)},
                {Vec3::Zero(), factor * Vec3(0.625, 0.125, 0.25)},
                {Vec3::Zero(), factor * Vec3(-4, 0.125, 0.25)}},
               {{1, 9, 2, 2, 0, 0, 0.5}, {1, 35, 10, 20, 0, 0, 0}});
}

std::vector<Case> steps_of_many_sizes() {
  const Vec3 away(0x1p20, -0x1p19, 0x1p18);
  const Body ball = exact_body("ball", octahedron_mesh());
  return {step_of_size("step-a-millimetre-wide", 0x1p-10),
          step_of_size("step-a-micrometre-wide", 0x1p-20),
          step_of_size("step-a-thousand-kilometres-wide", 0x1p20),
          moved("step-far-from-the-origin", {ball, ball},
                {{away, away + Vec3(4, 0, 0)}, {away, away + Vec3(2, 0, 0)}, {away, away}},
                {{1, 16, 8, 16, 0, 0, 1}, {1, 60, 56, 96, 0, 0, 0}})};
}

Case deforming() {
  TriangleSource random(159);
  Case out{"step-moving", {}, {}, {}};
  out.bodies = {make_body("ball", sphere_mesh(Vec3::Zero(), kHalfSide, 1), {3, 3, 3}),
                make_body("cube", cube_mesh(2), {2, 3, 2}),
                make_body("fine ball", sphere_mesh(Vec3::Zero(), kHalfSide, 2), {4, 3, 3})};
  for (int f = 0; f < 6; ++f) {
    const double gap = 4.0 - 0.6 * f;
    std::vector<std::vector<Vec3>> nodes;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(gap, 0.25, 0.1), Vec3(0.5 * gap, gap, 0.3)}) {
      nodes.push_back(rest_nodes_at(*out.bodies[nodes.size()].shape, at));
      for (Vec3& n : nodes.back()) n = random.point(n, 0.4);
    }
    out.frames.push_back(make_frame(out.bodies, std::move(nodes)));
  }
  out.steps = {{0, 0, 0, 0, 1, 2},
               {},
               {1, 29, 4, 12, 0, 0, 0.791792062},
               {3, 123, 16, 47, 0, 0, 0},
               {3, 311, 38, 134, 0, 0, 0}};
  return out;
}

std::vector<Case> every_step_case() {
  std::vector<Case> out;
  for (const auto& part :
       {meetings(), touches(), stillness(), degenerate_steps(), own(), steps_of_many_sizes()})
    out.insert(out.end(), part.begin(), part.end());
  out.push_back(moving_step_case());
  return out;
}

}  // namespace

const std::vector<Case>& step_cases() {
  static const std::vector<Case> cases = every_step_case();
  return cases;
}

const Case& moving_step_case() {
  static const Case scene = deforming();
  return scene;
}

}  // namespace contactcheck::test
