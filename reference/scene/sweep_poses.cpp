#include "reference/scene/sweep_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "core/types/check.h"
#include "reference/oracle/oracle.h"
#include "reference/scene/seeded_random.h"

namespace contactcheck::scene {
namespace {

using Nodes = std::vector<Vec3>;

constexpr int kMostSweepSteps = 20'000;  // of one path: what grazes comes nearer and nearer
constexpr int kMostDraws = 200;          // of one orientation

// No library function: the same bits on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}

  template <std::size_t N>
  std::array<double, N> unit() {
    return drawn_on_sphere<N>(
        [this] { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1.0; });
  }

 private:
  std::mt19937_64 engine_;
};

Vec3 rotated(const std::array<double, 4>& q, const Vec3& p) {
  const Vec3 v(q[1], q[2], q[3]);
  const Vec3 t = 2.0 * v.cross(p);
  return p + q[0] * t + v.cross(t);
}

double support(const Nodes& points, const Vec3& direction) {
  double out = points.front().dot(direction);
  for (const Vec3& p : points) out = std::max(out, p.dot(direction));
  return out;
}

class Poses {
 public:
  explicit Poses(const Scene& scene)
      : scene_(scene),
        oracle_(scene.bodies),
        size_(scene.size()),
        tolerance_(kSweepTolerance * size_),
        still_(scene.nodes_at(0.0)),
        target_(bounding_box(mapped(0, still_[0])).center()) {}

  /// The nodes of the second body at every separation, or nothing when this path misses.
  std::optional<std::vector<Nodes>> along(const std::array<double, 4>& turn,
                                          const Vec3& direction) {
    aim(turn, direction);
    std::vector<Nodes> out(separations().size());
    double at = separated_ + std::max(0.0, separations().back()) * size_;
    for (std::size_t s = separations().size(); s-- > 0 && separations()[s] > 0.0;) {
      if (!walk(separations()[s] * size_, at)) return std::nullopt;
      out[s] = placed(at);
    }
    if (!walk(0.0, at)) return std::nullopt;
    for (std::size_t s = 0; s < separations().size() && separations()[s] <= 0.0; ++s)
      out[s] = placed(at + separations()[s] * size_);
    return out;
  }

  const Nodes& first() const { return still_[0]; }

 private:
  const std::vector<double>& separations() const { return scene_.sweep()->separations; }

  Nodes mapped(std::size_t body, const Nodes& nodes) const {
    Nodes out(scene_.bodies[body].shape->mesh.vertices.size());
    map_body(*scene_.bodies[body].shape, nodes, out);
    return out;
  }

  void aim(const std::array<double, 4>& turn, const Vec3& direction) {
    direction_ = direction;
    turned_ = still_[1];
    const Vec3 center = bounding_box(mapped(1, still_[1])).center();
    for (Vec3& p : turned_) p = rotated(turn, p - center);
    const Nodes surface = mapped(0, still_[0]), moving = mapped(1, turned_);
    separated_ = support(surface, direction) + support(moving, -direction) - target_.dot(direction);
    through_ =
        -(support(surface, -direction) + support(moving, direction) + target_.dot(direction));
  }

  Nodes placed(double at) const {
    Nodes out = turned_;
    const Vec3 place = target_ + at * direction_;
    for (Vec3& p : out) p += place;
    return out;
  }

  oracle::DistanceInterval distance(double at) {
    const Nodes nodes = placed(at), first = mapped(0, still_[0]), second = mapped(1, nodes);
    Frame frame;
    frame.bodies = {{still_[0], first}, {nodes, second}};
    return oracle_.distance(frame, {0, 1});
  }

  // Moves `at` inward to where the distance first is the separation wanted. A body that moves by
  // less than what is left cannot have passed that place.
  bool walk(double wanted, double& at) {
    for (int step = 0; step < kMostSweepSteps && at > through_; ++step) {
      const oracle::DistanceInterval now = distance(at);
      if (now.upper <= wanted + tolerance_) return true;
      at -= std::max(now.lower - wanted, 0.5 * tolerance_);
    }
    return false;
  }

  const Scene& scene_;
  oracle::Oracle oracle_;
  const double size_, tolerance_;
  const std::vector<Nodes> still_;
  const Vec3 target_;
  Nodes turned_;  // about the origin
  Vec3 direction_ = Vec3::UnitX();
  double separated_ = 0.0, through_ = 0.0;
};

std::vector<Nodes> drawn(const Scene& scene, std::size_t orientation, Draws& draws, Poses& poses) {
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const auto turn = draws.unit<4>();
    const auto direction = draws.unit<3>();
    if (auto found = poses.along(turn, Vec3(direction.data()))) return std::move(*found);
  }
  throw InputError("scene \"" + scene.id + "\": of " + std::to_string(kMostDraws) +
                   " ways for orientation " + std::to_string(orientation) +
                   " of its sweep none leads \"" + scene.bodies[1].name + "\" to \"" +
                   scene.bodies[0].name + "\"");
}

}  // namespace

void place_sweep(const OnPose& on_pose, Scene& scene) {
  if (!scene.sweep()) return;
  const std::size_t separations = scene.sweep()->separations.size(),
                    orientations = scene.sweep()->orientations;
  Draws draws(scene.sweep()->seed);
  Poses poses(scene);
  std::vector<std::vector<Nodes>> frames(separations * orientations);
  for (std::size_t o = 0; o < orientations; ++o) {
    on_pose(o);
    std::vector<Nodes> found = drawn(scene, o, draws, poses);
    for (std::size_t s = 0; s < separations; ++s)
      frames[s * orientations + o] = {poses.first(), std::move(found[s])};
  }
  scene.recorded = std::move(frames);
}

}  // namespace contactcheck::scene
