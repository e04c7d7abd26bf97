#include "reference/scene/approach.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace contactcheck::scene {
RigidPair::RigidPair(const TriangleMesh& resting, const TriangleMesh& moved)
    : bodies_{{"resting", make_bare_shape(resting)}, {"moved", make_bare_shape(moved)}},
      resting_(resting.vertices),
      turned_(moved.vertices),
      oracle_(bodies_) {}

oracle::DistanceInterval RigidPair::distance(const Vec3& offset) {
  placed_.clear();
  for (const Vec3& v : turned_) placed_.push_back(v + offset);
  Frame frame;
  frame.bodies = {{resting_, resting_}, {placed_, placed_}};
  return oracle_.distance(frame, {0, 1});
}

namespace {

// Relative to the smaller body's largest side.
constexpr double kDepths[] = {0.08, 0.02, 0.005, 0.00125};
// Shares of a depth: how closely contact is watched on the path in, how far aside it must hold.
constexpr double kShareStep = 1.0 / 8.0, kAside = 1.0 / 4.0;
// A share of the smaller body's largest side: the steps that end the path to the first touch.
constexpr double kNearness = 1.0 / 512.0;
// Steps to the first touch: distances are walked off at once, and what grazes takes short steps.
constexpr int kMostApproachSteps = 500;

double largest_side(const std::vector<Vec3>& points) {
  return bounding_box(points).extent().maxCoeff();
}

const Vec3& foremost(const std::vector<Vec3>& points, const Vec3& direction) {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return a.dot(direction) < b.dot(direction);
  });
}

// A quarter turn without rounding: the next axis goes to the one after it.
std::vector<Vec3> turned(const std::vector<Vec3>& points, int about) {
  std::vector<Vec3> out = points;
  const int u = (about + 1) % 3, v = (about + 2) % 3;
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i][u] = -points[i][v];
    out[i][v] = points[i][u];
  }
  return out;
}

/// One direction, aim and turn.
struct Path {
  AxisDirection from;
  Vec3 aside = Vec3::Zero();  // of the moved body, across the direction
  std::optional<int> turned_about;
  double separated = 0.0;  // along the direction: from here on, a plane separates the two
  double end = 0.0;        // below, a plane separates them again: the moved body has gone through
  std::optional<double> touch;
  bool searched = false;

  Vec3 at(double along) const { return aside + along * from.vector(); }
};

}  // namespace

std::optional<Approach> find_approach(const TriangleMesh& resting, const TriangleMesh& moved,
                                      const std::vector<AxisDirection>& directions) {
  const double small = std::min(largest_side(resting.vertices), largest_side(moved.vertices));
  RigidPair pair(resting, moved);
  const auto turn = [&](const std::optional<int>& about) {
    pair.turn(about ? turned(moved.vertices, *about) : moved.vertices);
  };

  std::vector<Path> paths;
  for (const std::optional<int> about : std::initializer_list<std::optional<int>>{{}, 0, 1, 2}) {
    turn(about);
    for (const AxisDirection& from : directions) {
      const Vec3 d = from.vector();
      const Vec3 &a = foremost(pair.resting(), d), &b = foremost(pair.moved(), -d);
      Path path;
      path.from = from;
      path.turned_about = about;
      path.separated = (a - b).dot(d);
      path.end = (foremost(pair.resting(), -d) - foremost(pair.moved(), d)).dot(d);
      paths.push_back(path);
      path.aside = (a - b) - (a - b).dot(d) * d;
      paths.push_back(path);
    }
  }

  // A body that moves by less than the distance touches nothing on its path.
  const auto first_touch = [&](const Path& path) -> std::optional<double> {
    double along = path.separated;
    for (int step = 0; step < kMostApproachSteps && along >= path.end; ++step) {
      const oracle::DistanceInterval distance = pair.distance(path.at(along));
      if (distance.upper == 0.0) return along;
      along -= std::max(distance.lower, kNearness * small);
    }
    return std::nullopt;
  };

  std::optional<Approach> any;
  for (const double depth_share : kDepths) {
    const double depth = depth_share * small;
    for (Path& path : paths) {
      turn(path.turned_about);
      if (!path.searched) path.touch = first_touch(path);
      path.searched = true;
      if (!path.touch) continue;
      bool meets_on_path = true;
      for (double share = kShareStep; share <= 1.0 && meets_on_path; share += kShareStep)
        meets_on_path = pair.touches(path.at(*path.touch - share * depth));
      if (!meets_on_path) continue;

      Approach found;
      found.from = path.from;
      found.turned_about = path.turned_about;
      found.separated = path.at(path.separated);
      found.meeting = path.at(*path.touch - depth);
      found.depth = depth;
      found.robust = true;
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
          if (found.robust && axis != path.from.axis)
            found.robust = pair.touches(found.meeting + sign * kAside * depth * Vec3::Unit(axis));
      if (found.robust) return found;
      if (!any) any = found;
    }
  }
  return any;
}

}  // namespace contactcheck::scene
