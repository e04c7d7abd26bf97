// Seeded scenes of one step: small bodies at two moments, with and without lattices.
//
// No libm on the way to a coordinate: the same scenes on every machine.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/node_shape.h"
#include "core/detect/detector.h"
#include "core/types/frame.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// Bodies at both ends of a step.
struct StepScene {
  std::string name;
  std::vector<Body> bodies;
  FrameData start, end;
  /// Points into this object, as FrameData::frame().
  Step step() const { return {start.frame(0), end.frame(1)}; }
};

/// As a run gives it to the detector: without vertices to one that needs none.
inline Step given_to(const Detector& detector, Step step) {
  for (Frame* frame : {&step.start, &step.end})
    for (BodyState& body : frame->bodies)
      if (!detector.needs_vertices()) body.vertices = {};
  return step;
}

/// The same backwards in time.
inline StepScene reversed(StepScene scene) {
  std::swap(scene.start, scene.end);
  scene.name += " backwards";
  return scene;
}

/// The nodes of all bodies at one moment.
using NodesOfBodies = std::vector<std::vector<Vec3>>;

inline StepScene make_step_scene(const std::string& name, std::vector<Body> bodies,
                                 NodesOfBodies start, NodesOfBodies end) {
  StepScene scene{name, std::move(bodies), {}, {}};
  scene.start = make_frame(scene.bodies, std::move(start));
  scene.end = make_frame(scene.bodies, std::move(end));
  return scene;
}

/// A torus about the z axis of 8 x 4 quads of two triangles, or 4 x 4; about 2 wide.
inline TriangleMesh small_torus(bool fine) {
  constexpr std::array<std::array<double, 2>, 8> kRound = {{{1, 0},
                                                            {0.75, 0.75},
                                                            {0, 1},
                                                            {-0.75, 0.75},
                                                            {-1, 0},
                                                            {-0.75, -0.75},
                                                            {0, -1},
                                                            {0.75, -0.75}}};
  const std::uint32_t step = fine ? 1 : 2, around = 8 / step, across = 4;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const auto& u = kRound[i * step];
      const auto& v = kRound[2 * j];
      const double r = 0.7 + 0.3 * v[0];
      mesh.vertices.emplace_back(r * u[0], r * u[1], 0.3 * v[1]);
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return (i % around) * across + j % across;
  };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// About 2 wide, of 8 to 128 triangles, or of at most 32.
inline TriangleMesh draw_mesh(TriangleSource& random, bool few) {
  switch (random.below(few ? 4 : 7)) {
    case 0:
      return sphere_mesh(Vec3::Zero(), 1.0, 0);
    case 1:
      return sphere_mesh(Vec3::Zero(), 1.0, 1);
    case 2:
      return box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 1);
    case 3:
      return small_torus(false);
    case 4:
      return small_torus(true);
    case 5:
      return sphere_mesh(Vec3::Zero(), 1.0, 2);
    default:
      return box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 2 + random.below(2));
  }
}

/// Every triangle has its own corners, as in STL files.
inline TriangleMesh unshared_corners(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (const std::uint32_t v : t) out.vertices.push_back(mesh.vertices[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

/// In a lattice of one to four cells an axis, or, once in three times, without one.
inline Body draw_body(TriangleSource& random, TriangleMesh mesh) {
  if (random.below(3) == 0) return {"bare", make_bare_shape(std::move(mesh))};
  const auto cells = [&] { return static_cast<std::uint32_t>(1 + random.below(4)); };
  const Resolution resolution{cells(), cells(), cells()};
  return make_body("in a lattice", std::move(mesh), resolution);
}

inline Eigen::Matrix3d draw_rotation(TriangleSource& random) {
  const double w = random.unit(), x = random.unit(), y = random.unit();
  return Eigen::Quaterniond(w, x, y, random.unit()).normalized().toRotationMatrix();
}

/// How the bodies of a scene move. Lengths are those of bodies that are about 2 wide.
enum class StepFamily : std::uint8_t {
  kSlow,             ///< each by a third of its size
  kFast,             ///< each by some sizes: through one another
  kTogether,         ///< all by a thousand sizes, and each by a third beside that
  kTurning,          ///< each turns
  kTogetherTurning,  ///< the two above
  kTwisting,         ///< each twists, and each node moves by itself
  kFolding,          ///< through the flat state, to the inside out: contact with itself
  kInContact,        ///< deep in one another from the start on
  kAtRest,           ///< nothing moves
  kFar,              ///< far from the origin
  kTiny,             ///< a millionth in size
  kHuge,             ///< 1e100 in size
  kGrid,             ///< whole numbers at both ends, with and without lattices: exact touches
  kDegenerate,       ///< whole numbers, and triangles that name a vertex twice or lie on a line
  kWelded,           ///< corners that are welded, and stay together or come apart
};
inline constexpr std::array kStepFamilies = {StepFamily::kSlow,
                                             StepFamily::kFast,
                                             StepFamily::kTogether,
                                             StepFamily::kTurning,
                                             StepFamily::kTogetherTurning,
                                             StepFamily::kTwisting,
                                             StepFamily::kFolding,
                                             StepFamily::kInContact,
                                             StepFamily::kAtRest,
                                             StepFamily::kFar,
                                             StepFamily::kTiny,
                                             StepFamily::kHuge,
                                             StepFamily::kGrid,
                                             StepFamily::kDegenerate,
                                             StepFamily::kWelded};

inline const char* name_of(StepFamily family) {
  constexpr std::array kNames = {
      "slow",     "fast",    "together",   "turning",    "together turning",
      "twisting", "folding", "in contact", "at rest",    "far",
      "tiny",     "huge",    "grid",       "degenerate", "welded"};
  static_assert(kNames.size() == kStepFamilies.size());
  return kNames[static_cast<std::size_t>(family)];
}

namespace step_scene_detail {

struct Ways {
  double spread = 1.6;    ///< of the bodies' places at the start
  double speed = 0.8;     ///< of each body
  double together = 0.0;  ///< of all of them
  bool turns = false, twists = false, folds = false;
  double strength = 0.05;  ///< by which each node moves by itself, at both ends
};

inline Ways ways_of(StepFamily family) {
  switch (family) {
    case StepFamily::kFast:
      return {3.0, 6.0};
    case StepFamily::kTogether:
      return {1.8, 0.8, 2000.0};
    case StepFamily::kTurning:
      return {1.8, 0.5, 0.0, true};
    case StepFamily::kTogetherTurning:
      return {2.0, 0.8, 2000.0, true};
    case StepFamily::kTwisting:
      return {1.5, 0.5, 0.0, false, true, false, 0.2};
    case StepFamily::kFolding:
      return {2.0, 1.0, 0.0, false, false, true};
    case StepFamily::kInContact:
      return {0.4, 0.3};
    case StepFamily::kAtRest:
      return {1.2, 0.0, 0.0, false, false, false, 0.0};
    default:
      return {};
  }
}

inline Vec3 twisted(const Vec3& p, double by) {
  return {p.x() - by * p.z() * p.y(), p.y() + by * p.z() * p.x(), p.z()};
}

inline StepScene draw_moving(TriangleSource& random, StepFamily family) {
  const Ways ways = ways_of(family);
  const bool few = family == StepFamily::kFolding || family == StepFamily::kHuge;
  const double scale = family == StepFamily::kTiny ? 1e-6 : family == StepFamily::kHuge ? 1e100 : 1;
  const Vec3 offset = family == StepFamily::kFar ? Vec3(1e6, -1e6, 3e5) : Vec3(Vec3::Zero());
  const int count = 2 + random.below(few ? 2 : 4);
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  const Vec3 all = random.point(Vec3::Zero(), ways.together);
  for (int b = 0; b < count; ++b) {
    // Half of the later ones are instances.
    if (b > 0 && random.below(2) == 0) {
      bodies.push_back(bodies[static_cast<std::size_t>(random.below(b))]);
    } else {
      bodies.push_back(draw_body(random, draw_mesh(random, few || count > 3)));
    }
    const Vec3 from = random.point(Vec3::Zero(), ways.spread);
    const Vec3 to = from + all + random.point(Vec3::Zero(), ways.speed);
    Eigen::Matrix3d first = Eigen::Matrix3d::Identity(), last = first;
    if (ways.turns) first = draw_rotation(random), last = draw_rotation(random);
    if (ways.folds)
      last.diagonal() << -0.7 - 0.3 * random.unit(), random.unit(), 0.7 + 0.3 * random.unit();
    const double twist = ways.twists ? random.unit() : 0.0;
    std::vector<Vec3>& begins = start.emplace_back();
    std::vector<Vec3>& ends = end.emplace_back();
    for (const Vec3& node : rest_nodes_at(*bodies.back().shape, Vec3::Zero())) {
      const Vec3 p = random.point(first * node + from, ways.strength);
      const Vec3 q = random.point(last * twisted(node, twist) + to, ways.strength);
      begins.push_back(scale * p + offset);
      ends.push_back(scale * (family == StepFamily::kAtRest ? p : q) + offset);
    }
  }
  return make_step_scene(name_of(family), std::move(bodies), std::move(start), std::move(end));
}

/// Triangles of random vertices, each of which may be named twice.
inline std::vector<Triangle> draw_triangles(TriangleSource& random, int vertices, int count) {
  const auto vertex = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
  std::vector<Triangle> out;
  for (int t = 0; t < count; ++t) {
    const std::uint32_t a = vertex(), b = vertex();
    out.push_back({a, b, random.below(4) == 0 ? a : vertex()});
  }
  return out;
}

/// Each node lies on a vertex, so that mapping is exact.
inline StepScene draw_on_grid(TriangleSource& random, bool degenerate) {
  const int count = 2 + random.below(2);
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  for (int b = 0; b < count; ++b) {
    TriangleMesh mesh = random.below(2) == 0
                            ? box_mesh(Vec3::Constant(-1), Vec3::Ones(), 1 + random.below(2))
                            : sphere_mesh(Vec3::Zero(), 1.0, 0);
    if (degenerate) mesh.triangles = draw_triangles(random, 8, 10);
    if (degenerate) mesh.vertices.resize(8, Vec3::Ones());
    const Vec3 from = random.grid_point(2), to = from + random.grid_point(3);
    const auto moved = [&](const Vec3& at) {
      std::vector<Vec3> out;
      for (const Vec3& v : mesh.vertices)
        out.push_back(v + at + (random.below(3) == 0 ? random.grid_point(1) : Vec3(Vec3::Zero())));
      return out;
    };
    const std::vector<Vec3> begins = moved(from), ends = random.below(8) == 0 ? begins : moved(to);
    const NodeShape shape = make_node_shape(mesh.vertices.size(), mesh.triangles);
    if (random.below(2) == 0) {
      bodies.push_back({"nodes", shape.shape});
      start.push_back(shape.nodes_for(begins));
      end.push_back(shape.nodes_for(ends));
    } else {
      bodies.push_back({"bare", make_bare_shape(mesh)});
      const GivenVertices& given = bodies.back().shape->given;
      start.push_back(given.kept(begins));
      end.push_back(given.kept(ends));
    }
  }
  return make_step_scene(degenerate ? "degenerate" : "grid", std::move(bodies), std::move(start),
                         std::move(end));
}

inline StepScene draw_welded(TriangleSource& random) {
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  for (int b = 0; b < 2; ++b) {
    const TriangleMesh mesh = unshared_corners(draw_mesh(random, true));
    const Body body = draw_body(random, mesh);
    bodies.push_back({body.name, welded(*body.shape)});
    const bool tears = random.below(3) == 0;
    const Vec3 from = random.point(Vec3::Zero(), 1.0);
    Eigen::Matrix3d last = Eigen::Matrix3d::Identity();
    last.diagonal() << -random.unit(), random.unit(), 1.0;
    start.emplace_back(), end.emplace_back();
    for (const Vec3& node : rest_nodes_at(*body.shape, Vec3::Zero())) {
      start.back().push_back(node + from);
      end.back().push_back(last * twisted(node, 0.5));
      if (tears) end.back().back() = random.point(end.back().back(), 0.1);
    }
  }
  return make_step_scene("welded", std::move(bodies), std::move(start), std::move(end));
}

}  // namespace step_scene_detail

inline StepScene draw_step_scene(TriangleSource& random, StepFamily family) {
  switch (family) {
    case StepFamily::kGrid:
      return step_scene_detail::draw_on_grid(random, false);
    case StepFamily::kDegenerate:
      return step_scene_detail::draw_on_grid(random, true);
    case StepFamily::kWelded:
      return step_scene_detail::draw_welded(random);
    default:
      return step_scene_detail::draw_moving(random, family);
  }
}

/// Two bodies that nearly touch along x of a frame which moves and turns with both.
struct Graze {
  Eigen::Matrix3d turned_at_start = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d turned_at_end = Eigen::Matrix3d::Identity();
  Vec3 at_start = Vec3::Zero(), at_end = Vec3::Zero();  ///< of the frame
  double apart_at_start = 0.0, apart_at_end = 0.0;      ///< added to the gap
  Vec3 slide = Vec3::Zero();                            ///< of the second body in the frame
  double grows = 1.0;                                   ///< both bodies, about the first's middle
};

/// `gap`: between the boxes of the bodies at rest, along x. The bodies' boxes at rest are [-1, 1]
/// along x.
inline StepScene grazing(const std::vector<Body>& bodies, const Graze& graze, double gap) {
  NodesOfBodies start, end;
  for (std::size_t b = 0; b < 2; ++b) {
    start.emplace_back(), end.emplace_back();
    for (const Vec3& node : rest_nodes_at(*bodies[b].shape, Vec3::Zero())) {
      Vec3 p = node, q = node;
      if (b == 1) {
        p.x() += 2.0 + gap + graze.apart_at_start;
        q += graze.slide;
        q.x() += 2.0 + gap + graze.apart_at_end;
      }
      start.back().push_back(graze.turned_at_start * p + graze.at_start);
      end.back().push_back(graze.grows * (graze.turned_at_end * q) + graze.at_end);
    }
  }
  return make_step_scene("grazing", bodies, std::move(start), std::move(end));
}

}  // namespace contactcheck::test
