#include "reference/report/pictures/label_layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace contactcheck::report {
namespace {

constexpr double kGap = 3.0, kWordGap = 6.0;  // between a name and what it must not touch
constexpr double kRow = 4.0;                  // from one row of places to the next
constexpr int kRows = 70;                     // above and below a point
constexpr int kOrders = 50, kPasses = 3;
constexpr double kLeaderFrom = 9.0;  // nearer names need no leader
// A place whose leader crosses something, or whose name covers a line, may be that much nearer, in
// pixels, and is still worse.
constexpr double kCrossing = 150.0, kCovering = 40.0;
constexpr double kNoPlace = 1e4;
// Beside is read most easily, then above, then below.
constexpr double kLeft = 1.0, kAbove = 2.0, kBelow = 5.0;
// Which part of a name is left of its point, best first; beyond [0, 1] the point is outside it.
constexpr double kPartsLeft[] = {0.5,   0.35, 0.65, 0.2, 0.8,  0.05, 0.95,
                                 -0.15, 1.15, -0.4, 1.4, -0.8, 1.8};

Box grown(const Box& b, double sideways, double upwards) {
  return {b.x - sideways, b.y - upwards, b.width + 2 * sideways, b.height + 2 * upwards};
}

bool inside(const Box& inner, const Box& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.right() <= outer.right() &&
         inner.bottom() <= outer.bottom();
}

double side_of(const PicturePoint& a, const PicturePoint& b, const PicturePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const PictureSegment& a, const PictureSegment& b) {
  return side_of(a.from, a.to, b.from) * side_of(a.from, a.to, b.to) <= 0.0 &&
         side_of(b.from, b.to, a.from) * side_of(b.from, b.to, a.to) <= 0.0;
}

bool cross(const PictureSegment& s, const Box& b) {
  const PicturePoint corners[] = {
      {b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}};
  for (int i = 0; i < 4; ++i)
    if (cross(s, PictureSegment{corners[i], corners[(i + 1) % 4]})) return true;
  return false;
}

class Layout {
 public:
  Layout(const std::vector<LabelledPoint>& points, const Box& area, double radius,
         const std::vector<PictureSegment>& lines)
      : points_(points), area_(area), radius_(radius), lines_(lines), places_(points.size()) {
    for (const LabelledPoint& p : points)
      markers_.push_back({p.x - radius, p.y - radius, 2 * radius, 2 * radius});
  }

  /// Places all names anew, one after the other, each where the others leave it room.
  void place_all(const std::vector<std::size_t>& order) {
    cost_ = 0.0;
    for (const std::size_t i : order) place(i);
  }

  /// The cost of the last place_all; the lower, the easier the names are to read.
  double cost() const { return cost_; }
  const std::vector<std::optional<LabelPlace>>& places() const { return places_; }

 private:
  void place(std::size_t i) {
    places_[i].reset();
    least_ = kNoPlace;
    const auto [x, y, w, h] = points_[i];
    const double far = radius_ + kGap;
    try_place(i, {x + far, y - h / 2, w, h}, 0.0);
    try_place(i, {x - far - w, y - h / 2, w, h}, kLeft);
    for (int row = 0; row < kRows; ++row) {
      const double away = far + row * kRow;
      for (const double part : kPartsLeft) {
        try_place(i, {x - part * w, y - away - h, w, h}, kAbove);
        try_place(i, {x - part * w, y + away, w, h}, kBelow);
      }
    }
    cost_ += least_;
  }

  void try_place(std::size_t own, const Box& box, double dislike) {
    const LabelledPoint& point = points_[own];
    const PicturePoint end{std::clamp(point.x, box.x, box.right()),
                           std::clamp(point.y, box.y, box.bottom())};
    const double distance = std::hypot(end.x - point.x, end.y - point.y);
    if (distance + dislike >= least_ || !is_free(own, box)) return;
    LabelPlace place{box, {}};
    if (distance > radius_ + kLeaderFrom) place.leader = end;
    const double cost =
        distance + dislike + kCrossing * crossings(own, place) + kCovering * covered_lines(box);
    if (cost >= least_) return;
    places_[own] = place;
    least_ = cost;
  }

  bool is_free(std::size_t own, const Box& box) const {
    if (!inside(box, area_)) return false;
    const Box to_marker = grown(box, kGap / 2, kGap / 2), to_name = grown(box, kWordGap, kGap / 2);
    for (const Box& marker : markers_)
      if (overlap(to_marker, marker)) return false;
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (i != own && places_[i] && overlap(to_name, places_[i]->box)) return false;
    return true;
  }

  PictureSegment leader_of(std::size_t i, const LabelPlace& place) const {
    return {{points_[i].x, points_[i].y}, *place.leader};
  }

  // Crossings: of the leader with other leaders, names and markers; of other leaders with the name.
  double crossings(std::size_t own, const LabelPlace& place) const {
    double count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i == own) continue;
      if (place.leader) count += cross(leader_of(own, place), markers_[i]);
      if (places_[i]) count += crossings(own, place, i, *places_[i]);
    }
    return count;
  }
  double crossings(std::size_t own, const LabelPlace& place, std::size_t other,
                   const LabelPlace& others) const {
    double count = 0;
    if (place.leader) count += cross(leader_of(own, place), others.box);
    if (others.leader) count += cross(leader_of(other, others), place.box);
    if (place.leader && others.leader)
      count += cross(leader_of(own, place), leader_of(other, others));
    return count;
  }

  double covered_lines(const Box& box) const {
    double count = 0;
    for (const PictureSegment& line : lines_) count += cross(line, box);
    return count;
  }

  const std::vector<LabelledPoint>& points_;
  Box area_;
  double radius_;
  const std::vector<PictureSegment>& lines_;
  std::vector<Box> markers_;
  std::vector<std::optional<LabelPlace>> places_;
  double least_ = 0.0, cost_ = 0.0;
};

}  // namespace

bool overlap(const Box& a, const Box& b) {
  return a.x <= b.right() && b.x <= a.right() && a.y <= b.bottom() && b.y <= a.bottom();
}

// A name that is placed first takes places from others: several orders are tried, each with a
// second chance for all, and the best is taken. (mt19937's numbers are the same everywhere,
// std::shuffle's are not.)
std::vector<std::optional<LabelPlace>> place_labels(const std::vector<LabelledPoint>& points,
                                                    const Box& area, double radius,
                                                    const std::vector<PictureSegment>& lines) {
  std::mt19937 random(1);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::optional<LabelPlace>> best;
  double least = 0.0;
  for (int attempt = 0; attempt < kOrders; ++attempt) {
    Layout layout(points, area, radius, lines);
    for (int pass = 0; pass < kPasses; ++pass) layout.place_all(order);
    if (attempt == 0 || layout.cost() < least) {
      best = layout.places();
      least = layout.cost();
    }
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  }
  return best;
}

}  // namespace contactcheck::report
