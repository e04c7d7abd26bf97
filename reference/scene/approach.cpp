#include "reference/scene/approach.h"

#include <algorithm>
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

// Of the smaller body's largest side.
constexpr double kDepths[] = {0.08, 0.02, 0.005, 0.00125};
// Of a depth: how closely contact is watched on the way in, and how far to the sides it must hold.
constexpr double kShareStep = 1.0 / 8.0, kAside = 1.0 / 4.0;
// Of the smaller body's largest side: the way to the first touch ends in steps of this length.
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
struct Way {
  AxisDirection from;
  Vec3 aside = Vec3::Zero();  // of the moved body, across the direction
  std::optional<int> turned_about;
  double apart = 0.0;  // along the direction: from here on, a plane parts the two
  double end = 0.0;    // and from here on, one that has gone through
  std::optional<double> touch;
  bool searched = false;

  Vec3 at(double along) const { return aside + along * from.vector(); }
};

class Finder {
 public:
  Finder(const TriangleMesh& resting, const TriangleMesh& moved,
         const std::vector<AxisDirection>& directions)
      : pair_(resting, moved),
        upright_(moved.vertices),
        small_(std::min(largest_side(resting.vertices), largest_side(moved.vertices))) {
    add_ways(std::nullopt, directions);
    for (int axis = 0; axis < 3; ++axis) add_ways(axis, directions);
  }

  std::optional<Approach> find() {
    std::optional<Approach> any;
    for (const double share : kDepths) {
      for (Way& way : ways_) {
        std::optional<Approach> found = try_way(share * small_, way);
        if (found && found->robust) return found;
        if (found && !any) any = found;
      }
    }
    return any;
  }

 private:
  void turn(const std::optional<int>& about) {
    pair_.turn(about ? turned(upright_, *about) : upright_);
  }

  void add_ways(const std::optional<int>& about, const std::vector<AxisDirection>& directions) {
    turn(about);
    for (const AxisDirection& from : directions) {
      const Vec3 d = from.vector();
      const Vec3 &a = foremost(pair_.resting(), d), &b = foremost(pair_.moved(), -d);
      Way way;
      way.from = from;
      way.turned_about = about;
      way.apart = (a - b).dot(d);
      way.end = (foremost(pair_.resting(), -d) - foremost(pair_.moved(), d)).dot(d);
      ways_.push_back(way);
      way.aside = (a - b) - (a - b).dot(d) * d;
      ways_.push_back(way);
    }
  }

  // A body that moves by less than the distance touches nothing on the way.
  std::optional<double> first_touch(const Way& way) {
    double along = way.apart;
    for (int step = 0; step < kMostApproachSteps && along >= way.end; ++step) {
      const oracle::DistanceInterval distance = pair_.distance(way.at(along));
      if (distance.upper == 0.0) return along;
      along -= std::max(distance.lower, kNearness * small_);
    }
    return std::nullopt;
  }

  bool meets_all_the_way(const Way& way, double depth) {
    for (double share = kShareStep; share <= 1.0; share += kShareStep)
      if (!pair_.touches(way.at(*way.touch - share * depth))) return false;
    return true;
  }

  bool meets_to_the_sides(const Way& way, double depth) {
    const Vec3 meeting = way.at(*way.touch - depth);
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0})
        if (axis != way.from.axis &&
            !pair_.touches(meeting + sign * kAside * depth * Vec3::Unit(axis)))
          return false;
    return true;
  }

  std::optional<Approach> try_way(double depth, Way& way) {
    turn(way.turned_about);
    if (!way.searched) way.touch = first_touch(way);
    way.searched = true;
    if (!way.touch || !meets_all_the_way(way, depth)) return std::nullopt;
    Approach out;
    out.from = way.from;
    out.turned_about = way.turned_about;
    out.apart = way.at(way.apart);
    out.meeting = way.at(*way.touch - depth);
    out.depth = depth;
    out.robust = meets_to_the_sides(way, depth);
    return out;
  }

  RigidPair pair_;
  const std::vector<Vec3> upright_;
  const double small_;
  std::vector<Way> ways_;
};

}  // namespace

std::optional<Approach> find_approach(const TriangleMesh& resting, const TriangleMesh& moved,
                                      const std::vector<AxisDirection>& directions) {
  return Finder(resting, moved, directions).find();
}

}  // namespace contactcheck::scene
