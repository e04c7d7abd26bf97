#include "tests/support/impact_queries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>

namespace contactcheck::test {
namespace {

using Points = std::array<Vec3, 4>;

class Draw {
 public:
  explicit Draw(std::mt19937_64& random) : random_(random) {}

  ImpactQuery query(ImpactFamily family) {
    ImpactQuery query;
    query.kind = chance(2) ? ImpactKind::vertex_triangle : ImpactKind::edge_edge;
    fill(query, family);
    return query;
  }

 private:
  /// Uniform in 0 .. count - 1 (up to a bias of count / 2^64).
  std::size_t below(std::size_t count) { return random_() % count; }
  bool chance(std::size_t one_in) { return below(one_in) == 0; }
  /// Uniform in [-1, 1).
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0; }
  double whole(int limit) {
    return static_cast<double>(below(2 * static_cast<std::size_t>(limit) + 1)) - limit;
  }
  Vec3 whole_point(int limit) {
    const double x = whole(limit), y = whole(limit);
    return {x, y, whole(limit)};
  }
  /// Not zero.
  Vec3 whole_direction(int limit) {
    Vec3 direction = whole_point(limit);
    if (direction.isZero(0)) direction[static_cast<int>(below(3))] = 1;
    return direction;
  }

  template <typename Coordinate>
  static void for_all(ImpactQuery& query, const Coordinate& coordinate) {
    for (Points* points : {&query.start, &query.end})
      for (Vec3& point : *points)
        for (int axis = 0; axis < 3; ++axis) point[axis] = coordinate();
  }
  void whole_places(ImpactQuery& query, int limit) {
    for_all(query, [&] { return whole(limit); });
  }

  void fill(ImpactQuery& query, ImpactFamily family) {
    switch (family) {
      case ImpactFamily::kInSpace:
        return for_all(query, [&] { return unit(); });
      case ImpactFamily::kSmallWhole:
        return whole_places(query, 2);
      case ImpactFamily::kOneCrossing:
        return rounded_crossing(query, false);
      case ImpactFamily::kRoundedTouch:
        return rounded_crossing(query, true);
      case ImpactFamily::kExactTouch:
        return exact_touch(query);
      case ImpactFamily::kNudgedTouch:
        return exact_touch(query), nudge(query);
      case ImpactFamily::kNearlyPlanar:
        return nearly_planar(query);
      case ImpactFamily::kFallBesideEdge:
        return fall_beside_edge(query);
      case ImpactFamily::kMeetingEnds:
        return meeting_ends(query);
      case ImpactFamily::kFixedPlane:
        return fixed_plane(query);
      case ImpactFamily::kTurningPlane:
        return turning_plane(query);
      case ImpactFamily::kFixedCombination:
        return fixed_combination(query);
      case ImpactFamily::kPlanarEnds:
        return in_plane(query.start), in_plane(query.end);
      case ImpactFamily::kOnLine:
        return on_line(query);
      case ImpactFamily::kLinearEnds:
        return linear_ends(query);
      case ImpactFamily::kRepeated:
        return repeated(query);
      case ImpactFamily::kAtRest:
        return at_rest(query);
      case ImpactFamily::kFarAway:
        return far_away(query);
      case ImpactFamily::kFlips:
        return flips(query, 1.0);
      case ImpactFamily::kCloseFlips:
        return flips(query, 0x1p-45);
      case ImpactFamily::kScaledAxes:
        return scaled_axes(query);
      case ImpactFamily::kTinyAxis:
        return tiny_axis(query);
      case ImpactFamily::kWholeRange:
        return whole_range(query);
    }
  }

  /// A point of an edge or of a triangle, by weights that add up to 1, which are multiples of 1/4
  /// for `touch`: on its boundary, inside or, rarely, outside.
  std::array<double, 3> weights_in_triangle(bool touch) {
    if (!touch) {
      const double a = 0.5 * (unit() + 1), b = (1 - a) * 0.5 * (unit() + 1);
      return {a, b, 1 - a - b};
    }
    constexpr std::array<std::array<double, 3>, 6> kWeights = {{{1, 0, 0},
                                                                {0.5, 0.5, 0},
                                                                {0.75, 0.25, 0},
                                                                {0.5, 0.25, 0.25},
                                                                {0.75, 0.5, -0.25},
                                                                {1.25, -0.25, 0}}};
    std::array<double, 3> weights = kWeights[below(kWeights.size())];
    std::rotate(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(below(3)),
                weights.end());
    return weights;
  }
  double share_of_edge(bool touch) {
    if (!touch) return 0.5 * (unit() + 1);
    constexpr std::array<double, 6> kShares = {0, 0.25, 0.5, 1, -0.25, 1};
    return kShares[below(kShares.size())];
  }

  /// Changes one point of `at`, the places at one time, so that the elements touch there. Returns
  /// that point.
  std::size_t make_touch(ImpactKind kind, Points& at, bool touch) {
    if (kind == ImpactKind::vertex_triangle) {
      const auto [a, b, c] = weights_in_triangle(touch);
      at[0] = a * at[1] + b * at[2] + c * at[3];
      return 0;
    }
    const double share = share_of_edge(touch);
    const Vec3 met = (1 - share) * at[0] + share * at[1];
    if (touch && chance(2)) {  // an end of the second edge
      const std::size_t end = 2 + below(2);
      at[end] = met;
      return end;
    }
    // The middle of the second edge for `touch`: twice the weight of its other end is exact.
    const double other_share = touch ? 0.5 : 0.25 + 0.25 * (unit() + 1);
    at[3] = (met - (1 - other_share) * at[2]) / other_share;
    return 3;
  }

  void rounded_crossing(ImpactQuery& query, bool touch) {
    for_all(query, [&] { return unit(); });
    const double time = 0.125 + 0.375 * (unit() + 1);
    Points at;
    for (std::size_t i = 0; i < 4; ++i) at[i] = (1 - time) * query.start[i] + time * query.end[i];
    const std::size_t changed = make_touch(query.kind, at, touch);
    query.end[changed] = (at[changed] - (1 - time) * query.start[changed]) / time;
  }

  void exact_touch(ImpactQuery& query) {
    for_all(query, [&] { return 32 * whole(8); });
    const std::size_t when = below(4);
    if (when == 0) {
      make_touch(query.kind, query.start, true);
    } else if (when == 1) {
      make_touch(query.kind, query.end, true);
    } else {
      Points middle;
      for (std::size_t i = 0; i < 4; ++i) middle[i] = 0.5 * (query.start[i] + query.end[i]);
      const std::size_t changed = make_touch(query.kind, middle, true);
      query.end[changed] = 2 * middle[changed] - query.start[changed];
    }
  }

  /// In half of the queries, every coordinate near 1 or -1: products are as large as extents allow.
  void nearly_planar(ImpactQuery& query) {
    const bool near_corners = chance(2);
    for_all(query, [&] {
      if (!near_corners) return unit();
      return (chance(2) ? 1 : -1) + std::ldexp(unit(), -static_cast<int>(below(40)));
    });
    const auto weights = weights_in_triangle(chance(2));
    const std::size_t changed = below(4);
    for (Points* points : {&query.start, &query.end}) {
      Vec3& point = (*points)[changed];
      point = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i) point += weights[i] * (*points)[(changed + 1 + i) % 4];
    }
  }

  /// All rest but point 0 and, of edges, point 1, which move along an axis.
  void fall_beside_edge(ImpactQuery& query) {
    for_all(query, [&] { return unit(); });
    const auto axis = static_cast<int>(below(3));
    const double share = 0.5 * (unit() + 1);
    const std::size_t first = query.kind == ImpactKind::vertex_triangle ? 1 + below(3) : 2;
    const std::size_t second = first == 3 ? 1 : first + 1;
    query.start[0] = (1 - share) * query.start[first] + share * query.start[second];
    if (chance(2)) nudge(query.start[0]);
    query.end = query.start;
    const std::size_t moving = query.kind == ImpactKind::vertex_triangle ? 1 : 2;
    const double height = unit(), fall = unit();
    for (std::size_t i = 0; i < moving; ++i) {
      query.start[i][axis] += height;
      query.end[i][axis] -= fall;
    }
  }

  /// Two points meet at t = 1/2 or 1/4, or miss by one unit in the last place. All 53 bits of
  /// coordinates are in use, so differences need 54.
  void meeting_ends(ImpactQuery& query) {
    constexpr std::int64_t kOne = std::int64_t{1} << 53;
    const auto bits = [&] { return static_cast<std::int64_t>(random_() >> 10) - kOne; };
    const bool vertex = query.kind == ImpactKind::vertex_triangle;
    const std::size_t meeting = vertex ? 0 : below(2);
    const std::size_t met = vertex ? 1 + below(3) : 2 + below(2);
    const std::int64_t weight = chance(2) ? 1 : 3;  // (1 - t) / t
    for_all(query, [&] { return static_cast<double>(bits()) * 0x1p-53; });
    for (int axis = 0; axis < 3; ++axis) {
      std::int64_t met_start = 0, met_end = 0, start = 0, end = 0;
      do {
        met_start = bits(), met_end = bits(), start = bits();
        end = met_end + weight * (met_start - start);
      } while (end < -kOne || end > kOne);
      const auto place = [&](std::int64_t value) { return static_cast<double>(value) * 0x1p-53; };
      query.start[met][axis] = place(met_start);
      query.end[met][axis] = place(met_end);
      query.start[meeting][axis] = place(start);
      query.end[meeting][axis] = place(end);
    }
    if (chance(2)) nudge(query.end[meeting]);
  }

  /// One coordinate by one unit in the last place.
  void nudge(ImpactQuery& query) { nudge((chance(2) ? query.start : query.end)[below(4)]); }
  void nudge(Vec3& point) {
    double& value = point[static_cast<int>(below(3))];
    const double infinity = std::numeric_limits<double>::infinity();
    value = std::nextafter(value, chance(2) ? infinity : -infinity);
  }

  void in_plane(Points& points) {
    const double by_x = whole(2), by_y = whole(2);
    for (Vec3& point : points) {
      point = whole_point(4);
      point.z() = by_x * point.x() + by_y * point.y();
    }
    turn_axes(points, below(3));
  }
  static void turn_axes(Points& points, std::size_t turns) {
    for (std::size_t i = 0; i < turns; ++i)
      for (Vec3& point : points) point = Vec3(point.y(), point.z(), point.x());
  }

  void fixed_plane(ImpactQuery& query) {
    const double by_x = whole(1), by_y = whole(1);
    const int limit = chance(2) ? 4 : 40;
    const std::size_t turns = below(3);
    for (Points* points : {&query.start, &query.end}) {
      for (Vec3& point : *points) {
        point = whole_point(limit);
        point.z() = by_x * point.x() + by_y * point.y();
      }
      turn_axes(*points, turns);
    }
  }

  /// Each point is x(t) u + k w(t): at all times in the plane of u and w(t).
  void turning_plane(ImpactQuery& query) {
    const Vec3 u = whole_direction(1);
    const Vec3 w_start = whole_direction(2), w_end = whole_direction(2);
    for (std::size_t i = 0; i < 4; ++i) {
      const double k = whole(2), x_start = whole(3), x_end = whole(3);
      query.start[i] = x_start * u + k * w_start;
      query.end[i] = x_end * u + k * w_end;
    }
  }

  void fixed_combination(ImpactQuery& query) {
    for_all(query, [&] { return 4 * whole(3); });
    const std::size_t changed = below(4);
    const auto weights = weights_in_triangle(true);
    for (Points* points : {&query.start, &query.end}) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * (*points)[(changed + 1 + i) % 4];
      (*points)[changed] = sum;
    }
  }

  void on_line(ImpactQuery& query) {
    const Vec3 direction = whole_direction(2);
    for (Points* points : {&query.start, &query.end})
      for (Vec3& point : *points) point = whole(4) * direction;
  }

  void linear_ends(ImpactQuery& query) {
    for (Points* points : {&query.start, &query.end}) {
      const Vec3 direction = whole_direction(2), offset = whole_point(1);
      for (Vec3& point : *points) point = offset + whole(3) * direction;
    }
  }

  void repeated(ImpactQuery& query) {
    whole_places(query, 3);
    const std::size_t from = below(4), to = (from + 1 + below(3)) % 4, ends = below(3);
    if (ends != 0) query.start[to] = query.start[from];
    if (ends != 1) query.end[to] = query.end[from];
    if (chance(3)) query.end[(to + 1) % 4] = query.end[from];
  }

  void at_rest(ImpactQuery& query) {
    whole_places(query, 3);
    const bool all = chance(4);
    for (std::size_t i = 0; i < 4; ++i)
      if (all || chance(2)) query.end[i] = query.start[i];
  }

  void far_away(ImpactQuery& query) {
    const std::array<double, 4> offsets = {0, 1e6, -0x1p30, 0x1p44};
    for (int axis = 0; axis < 3; ++axis) {
      const double offset = offsets[below(offsets.size())];
      for (Points* points : {&query.start, &query.end})
        for (Vec3& point : *points) point[axis] = offset + std::floor(100 * unit());
    }
  }

  /// Coordinate `axis` of every point goes from x to -(2 + k step) x: all become zero at the same
  /// time.
  void flips(ImpactQuery& query, double step) {
    for (int axis = 0; axis < 3; ++axis) {
      const double factor = 2 + step * static_cast<double>(below(3));
      for (std::size_t i = 0; i < 4; ++i) {
        query.start[i][axis] = whole(4);
        query.end[i][axis] = -factor * query.start[i][axis];
      }
    }
  }

  void scaled_axes(ImpactQuery& query) {
    fill(query, static_cast<ImpactFamily>(below(kImpactFamilies - 3)));
    std::array<int, 3> exponents;
    for (int& exponent : exponents) exponent = static_cast<int>(whole(chance(2) ? 950 : 320));
    if (auto result = scaled(query, exponents)) query = *std::move(result);
  }

  void tiny_axis(ImpactQuery& query) {
    const auto tiny = static_cast<int>(below(3));
    const bool few_bits = chance(2);
    const int limit = few_bits ? 4 : 1 << 20;
    const int exponent = static_cast<int>(below(few_bits ? 4 : 140)) - 1074;
    for (Points* points : {&query.start, &query.end})
      for (Vec3& point : *points)
        for (int axis = 0; axis < 3; ++axis)
          point[axis] = axis == tiny ? std::ldexp(whole(limit), exponent) : std::ldexp(unit(), 298);
  }

  void whole_range(ImpactQuery& query) {
    for_all(query, [&] {
      if (chance(4)) return 0.0;
      return std::ldexp(unit(), static_cast<int>(below(2096)) - 1072);
    });
  }

  std::mt19937_64& random_;
};

/// Replaces each coordinate by what `change` makes of it; nothing where it makes nothing.
template <typename Change>
std::optional<ImpactQuery> changed(ImpactQuery query, const Change& change) {
  for (Points* points : {&query.start, &query.end})
    for (Vec3& point : *points)
      for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> value = change(point[axis], axis, points == &query.end);
        if (!value) return std::nullopt;
        point[axis] = *value;
      }
  return query;
}

std::optional<double> exact_ldexp(double value, int exponent) {
  const double result = std::ldexp(value, exponent);
  if (!std::isfinite(result) || std::ldexp(result, -exponent) != value) return std::nullopt;
  return result;
}

std::optional<double> exact_sum(double a, double b) {
  const double sum = a + b;
  if (!std::isfinite(sum)) return std::nullopt;
  const double from_b = sum - a;  // Knuth's error of the sum
  const double error = (a - (sum - from_b)) + (b - from_b);
  if (!(error == 0)) return std::nullopt;
  return sum;
}

ImpactQuery with_points(const ImpactQuery& query, const std::array<std::size_t, 4>& order) {
  ImpactQuery result = query;
  for (std::size_t i = 0; i < 4; ++i) {
    result.start[i] = query.start[order[i]];
    result.end[i] = query.end[order[i]];
  }
  return result;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> line;
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

}  // namespace

const char* name_of(ImpactFamily family) {
  constexpr std::array<const char*, kImpactFamilies> kNames = {
      "InSpace",      "SmallWhole",       "OneCrossing",    "RoundedTouch", "ExactTouch",
      "NudgedTouch",  "NearlyPlanar",     "FallBesideEdge", "MeetingEnds",  "FixedPlane",
      "TurningPlane", "FixedCombination", "PlanarEnds",     "OnLine",       "LinearEnds",
      "Repeated",     "AtRest",           "FarAway",        "Flips",        "CloseFlips",
      "ScaledAxes",   "TinyAxis",         "WholeRange"};
  return kNames[static_cast<std::size_t>(family)];
}

ImpactQuery draw_impact_query(std::mt19937_64& random, ImpactFamily family) {
  return Draw(random).query(family);
}

ImpactFamily draw_impact_family(std::mt19937_64& random) {
  if (random() % 2000 == 0) return ImpactFamily::kWholeRange;
  return static_cast<ImpactFamily>(random() % (kImpactFamilies - 1));
}

ImpactQuery close_roots(double time, double square) {
  const double height = square - time * time;
  ImpactQuery query{ImpactKind::vertex_triangle, {}, {}};
  query.start = {Vec3(0, 0.25, height), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  query.end = {Vec3(1, 0.25, 2 * time + height), Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 0)};
  return query;
}

ImpactQuery reversed(const ImpactQuery& query) { return {query.kind, query.end, query.start}; }

std::vector<ImpactQuery> relabelled(const ImpactQuery& query) {
  std::vector<ImpactQuery> result;
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    const bool same_elements = query.kind == ImpactKind::vertex_triangle
                                   ? order[0] == 0
                                   : (order[0] < 2) == (order[1] < 2);
    if (same_elements) result.push_back(with_points(query, order));
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

std::vector<ImpactQuery> with_axes_permuted(const ImpactQuery& query) {
  std::vector<ImpactQuery> result;
  std::array<int, 3> order = {0, 1, 2};
  do {
    ImpactQuery permuted = query;
    for (Points* points : {&permuted.start, &permuted.end})
      for (Vec3& point : *points) point = Vec3(point[order[0]], point[order[1]], point[order[2]]);
    result.push_back(permuted);
  } while (std::next_permutation(order.begin(), order.end()));
  return result;
}

std::optional<ImpactQuery> scaled(const ImpactQuery& query, const std::array<int, 3>& exponents) {
  return changed(query, [&](double value, int axis, bool) {
    return exact_ldexp(value, exponents[static_cast<std::size_t>(axis)]);
  });
}

std::optional<ImpactQuery> translated(const ImpactQuery& query, const Vec3& at_start,
                                      const Vec3& at_end) {
  return changed(query, [&](double value, int axis, bool end) {
    return exact_sum(value, (end ? at_end : at_start)[axis]);
  });
}

std::optional<std::array<ImpactQuery, 2>> halves(const ImpactQuery& query) {
  std::array<ImpactQuery, 2> result = {query, query};
  for (std::size_t i = 0; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto sum = exact_sum(query.start[i][axis], query.end[i][axis]);
      const auto middle = sum ? exact_ldexp(*sum, -1) : std::nullopt;
      if (!middle) return std::nullopt;
      result[0].end[i][axis] = result[1].start[i][axis] = *middle;
    }
  return result;
}

std::string inconsistency(const Impact& answer) {
  const auto& [contact, at_start, earliest, latest] = answer;
  if (!(0 <= earliest && earliest <= latest && latest <= 1))
    return "times are not ordered in [0, 1]";
  if (latest - earliest > kImpactTimeWidth) return "the interval is too wide";
  if (at_start && !contact) return "starts in contact without contact";
  if ((at_start || !contact) && latest != 0) return "times are not 0";
  return "";
}

std::string contradiction(const Impact& a, const Impact& b) {
  for (const Impact* answer : {&a, &b})
    if (std::string wrong = inconsistency(*answer); !wrong.empty()) return wrong;
  if (a.contact != b.contact) return "only one says contact";
  if (a.starts_in_contact != b.starts_in_contact) return "only one says contact at t = 0";
  if (a.latest < b.earliest || b.latest < a.earliest) return "times are disjoint";
  return "";
}

std::string text(const Impact& answer) {
  if (!answer.contact) return "no contact";
  if (answer.starts_in_contact) return "contact at t = 0";
  return formatted("contact in [%.17g, %.17g] (%a, %a)", answer.earliest, answer.latest,
                   answer.earliest, answer.latest);
}

std::string text(const ImpactQuery& query) {
  std::string result =
      query.kind == ImpactKind::vertex_triangle ? "vertex-triangle\n" : "edge-edge\n";
  for (const Points* points : {&query.start, &query.end})
    for (const Vec3& point : *points)
      result += formatted("  %a %a %a\n", point.x(), point.y(), point.z());
  return result;
}

}  // namespace contactcheck::test
