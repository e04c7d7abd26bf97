// What tests of core/narrow/moving_triangles.h and the judge of the mutants ask of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/narrow/impact.h"
#include "core/narrow/moving_triangles.h"
#include "tests/support/observed_error.h"
#include "tests/support/random_triangles.h"
#include "tests/support/wide.h"

namespace contactcheck::test {

/// The corners of two triangles at both ends of a step.
struct TrianglesOfStep {
  TrianglePoints p_start, p_end, q_start, q_end;

  MovingTriangle p() const { return moving(p_start, p_end); }
  MovingTriangle q() const { return moving(q_start, q_end); }
  std::array<TrianglePoints*, 4> all() { return {&p_start, &p_end, &q_start, &q_end}; }

 private:
  static MovingTriangle moving(const TrianglePoints& start, const TrianglePoints& end) {
    return {{&start[0], &start[1], &start[2]}, {&end[0], &end[1], &end[2]}};
  }
};

/// Whether two triangles meet within the step, by exact tests of triangles and elements alone.
inline bool meet(const TrianglesOfStep& s) {
  if (triangles_intersect(s.p_start, s.q_start)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t to = (i + 1) % 3;
    if (find_impact({ImpactKind::vertex_triangle,
                     {s.p_start[i], s.q_start[0], s.q_start[1], s.q_start[2]},
                     {s.p_end[i], s.q_end[0], s.q_end[1], s.q_end[2]}})
            .contact ||
        find_impact({ImpactKind::vertex_triangle,
                     {s.q_start[i], s.p_start[0], s.p_start[1], s.p_start[2]},
                     {s.q_end[i], s.p_end[0], s.p_end[1], s.p_end[2]}})
            .contact)
      return true;
    for (std::size_t j = 0; j < 3; ++j)
      if (find_impact({ImpactKind::edge_edge,
                       {s.p_start[i], s.p_start[to], s.q_start[j], s.q_start[(j + 1) % 3]},
                       {s.p_end[i], s.p_end[to], s.q_end[j], s.q_end[(j + 1) % 3]}})
              .contact)
        return true;
  }
  return false;
}

/// Pairs of triangles by what they do, and by what is said of them at any scale.
struct Separations {
  int meet = 0, apart = 0, separated = 0;
  int wrong = 0;   ///< meet and are separated
  int unlike = 0;  ///< a motion that both share changes the verdict
};

/// A corner of one triangle on a side of another, which in many cases is all that they share.
/// Neither moves.
inline TrianglesOfStep draw_touching(TriangleSource& random) {
  TrianglesOfStep s;
  for (Vec3& corner : s.q_start) corner = 2 * random.grid_point(9);
  s.p_start = {0.5 * (s.q_start[1] + s.q_start[2]), random.grid_point(20), random.grid_point(20)};
  s.p_end = s.p_start, s.q_end = s.q_start;
  return s;
}

/// Whole numbers, where nothing rounds but what underflows: near 2^-359 products of three lengths
/// do. At every scale the same pairs meet.
inline Separations judged_separations(int count) {
  TriangleSource random(561);
  Separations out;
  for (int i = 0; i < count; ++i) {
    const TrianglesOfStep touching = draw_touching(random);
    for (int exponent = 350; exponent < 366; ++exponent) {
      TrianglesOfStep scaled = touching;
      for (TrianglePoints* corners : scaled.all())
        for (Vec3& corner : *corners) corner *= std::ldexp(1.0, -exponent);
      out.wrong += separated(scaled.p(), scaled.q());
    }
    TrianglesOfStep s;
    // Every second pair moves without turning.
    const Vec3 at = random.grid_point(2), to = random.grid_point(2);
    const Vec3 p_by = random.grid_point(2), q_by = random.grid_point(2);
    for (std::size_t c = 0; c < 3; ++c) {
      s.p_start[c] = random.grid_point(1);
      s.q_start[c] = random.grid_point(1) + at;
      s.p_end[c] = i % 2 == 0 ? Vec3(s.p_start[c] + p_by) : random.grid_point(1);
      s.q_end[c] = i % 2 == 0 ? Vec3(s.q_start[c] + q_by) : Vec3(random.grid_point(1) + to);
    }
    const bool contact = meet(s);
    (contact ? out.meet : out.apart) += 1;
    const bool seen = separated(s.p(), s.q());
    out.separated += seen;
    for (const double scale : {1.0, 0x1p-1070, 0x1p342, 0x1p1000}) {
      TrianglesOfStep scaled = s;
      for (TrianglePoints* corners : scaled.all())
        for (Vec3& corner : *corners) corner *= scale;
      out.wrong += contact && separated(scaled.p(), scaled.q());
    }
    for (TrianglePoints* end : {&s.p_end, &s.q_end})
      for (Vec3& corner : *end) corner += Vec3(0x1p50, -0x1p47, 0x1p49);
    out.unlike += separated(s.p(), s.q()) != seen;
  }
  return out;
}

/// Over the error that gap_along() names, with its last rounding taken off, in a search for large
/// errors from corners of a cube on.
inline double largest_gap_error(int starts) {
  struct Case {
    Vec3 normal;
    TrianglesOfStep triangles;
  };
  TriangleSource random(562);
  // A little more than 1, where doubles are as coarse as they can be beside their size.
  const auto above_one = [&] {
    return 1.0 + std::abs(std::ldexp(random.unit(), -4 - random.below(48)));
  };
  // All corners far out along the normal, but those that the others are taken less.
  const auto make = [&] {
    Case out;
    for (int k = 0; k < 3; ++k) out.normal[k] = above_one();
    for (TrianglePoints* corners : out.triangles.all())
      for (Vec3& corner : *corners)
        for (int k = 0; k < 3; ++k) corner[k] = above_one();
    for (Vec3* first : {&out.triangles.q_start[0], &out.triangles.q_end[0]})
      for (int k = 0; k < 3; ++k) (*first)[k] = std::ldexp(random.unit(), -52 - random.below(3));
    return out;
  };
  const auto change = [&](Case& c) {
    const double by = std::ldexp(random.unit(), -24 - random.below(32));
    if (random.below(4) == 0) {
      c.normal[random.below(3)] += by;
    } else {
      TrianglePoints& corners = *c.triangles.all()[static_cast<std::size_t>(random.below(4))];
      corners[static_cast<std::size_t>(random.below(3))][random.below(3)] += by;
    }
  };
  const auto along = [](const Vec3& n, const TrianglePoints& of, const Vec3& origin) {
    std::array<Wide, 3> out = {};
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) out[c] += Wide(n[k]) * (Wide(of[c][k]) - origin[k]);
    std::sort(out.begin(), out.end());
    return out;
  };
  return climb(starts, 4000, make, change, [&](const Case& c) {
    const TrianglesOfStep& s = c.triangles;
    const auto p0 = along(c.normal, s.p_start, s.q_start[0]),
               q0 = along(c.normal, s.q_start, s.q_start[0]);
    const auto p1 = along(c.normal, s.p_end, s.q_end[0]), q1 = along(c.normal, s.q_end, s.q_end[0]);
    const Wide exact =
        std::max(std::min(p0[0] - q0[2], p1[0] - q1[2]), std::min(q0[0] - p0[2], q1[0] - p1[2]));
    const Gap gap = gap_along(c.normal, RelativeCorners(s.p(), s.q()));
    const Wide rounding = 0x1p-53 * magnitude(gap.distance);
    return static_cast<double>((magnitude(gap.distance - exact) - rounding) / gap.error);
  });
}

}  // namespace contactcheck::test
