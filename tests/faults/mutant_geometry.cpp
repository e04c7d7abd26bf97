// Predicates and tests of triangles against rational arithmetic.

#include "core/deform/embedding.h"
#include "core/lazy/kernels.h"
#include "core/narrow/predicates.h"
#include "core/narrow/segments.h"
#include "core/narrow/triangle_box.h"
#include "core/narrow/triangle_triangle.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/random_triangles.h"
#include "tests/support/range_ends.h"

namespace contactcheck::test {
namespace {

struct NamedPairs {
  std::string name;
  std::vector<TrianglePair> pairs;
};

NamedPairs grid_pairs(const std::string& name, std::uint64_t seed, int limit, int count,
                      double scale) {
  TriangleSource random(seed);
  NamedPairs out{name, {}};
  for (int i = 0; i < count; ++i) {
    TrianglePair pair{random.grid_triangle(limit), random.grid_triangle(limit)};
    for (TrianglePoints* t : {&pair.first, &pair.second})
      for (Vec3& p : *t) p *= scale;
    out.pairs.push_back(pair);
  }
  return out;
}

NamedPairs near_pairs(const std::string& name, std::uint64_t seed, int count, double scale,
                      double offset) {
  TriangleSource random(seed);
  NamedPairs out{name, {}};
  for (int i = 0; i < count; ++i) {
    const TrianglePoints first = random.triangle(Vec3::Constant(offset), scale);
    out.pairs.emplace_back(first, random.near_degenerate_partner(first, scale));
  }
  return out;
}

// A triangle of each pair is a point or a segment with ends or middle on the other one.
NamedPairs degenerate_pairs(const std::string& name, std::uint64_t seed, int count) {
  TriangleSource random(seed);
  NamedPairs out{name, {}};
  for (int i = 0; i < count; ++i) {
    const TrianglePoints first = random.grid_triangle(2);
    const Vec3 from = random.grid_point(2), to = i % 3 == 0 ? from : random.grid_point(2);
    out.pairs.emplace_back(first, TrianglePoints{from, to, i % 2 == 0 ? from : to});
  }
  return out;
}

NamedPairs range_end_pairs(const std::string& name, std::uint64_t seed, RangeEnd end, int count) {
  RangeEndSource random(seed, end);
  NamedPairs out{name, {}};
  for (int i = 0; i < count; ++i) {
    out.pairs.push_back(random.sharing_pair());
    out.pairs.push_back(random.flat_pair());
    out.pairs.push_back(random.lattice_pair());
  }
  return out;
}

std::vector<NamedPairs> triangle_pairs() {
  return {grid_pairs("grid-pairs", 31, 1, 250, 1.0),
          grid_pairs("grid-pairs-1e9", 32, 2, 150, 1e9),
          grid_pairs("grid-pairs-1e-9", 33, 2, 150, 1e-9),
          near_pairs("near-degenerate-pairs", 34, 250, 1.0, 0.0),
          near_pairs("near-degenerate-pairs-1e9", 35, 100, 1e9, 0.0),
          near_pairs("near-degenerate-pairs-1e-9", 36, 100, 1e-9, 0.0),
          near_pairs("near-degenerate-pairs-far", 37, 150, 1.0, 1e6),
          degenerate_pairs("points-and-segments", 38, 200),
          range_end_pairs("largest-doubles", 39, RangeEnd::kLargest, 20),
          range_end_pairs("denormals", 40, RangeEnd::kDenormal, 20),
          range_end_pairs("both-range-ends", 41, RangeEnd::kBoth, 20)};
}

// The test in both orders, then the filter of the kernels, which may leave a pair open.
void check_pair(const TrianglePair& pair, MutantFindings& out) {
  const auto& [p, q] = pair;
  const bool truth = oracle::rational::triangles_intersect(p, q);
  out.expect(triangles_intersect(p, q) == truth,
             truth ? "missed=1 spurious=0" : "missed=0 spurious=1");
  out.expect(triangles_intersect(q, p) == truth,
             "the answer depends on the order of the triangles");
  TriangleBatch batch{};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) {
      batch.corner[0][c][k][0] = p[static_cast<std::size_t>(c)][k];
      batch.corner[1][c][k][0] = q[static_cast<std::size_t>(c)][k];
    }
  batch.count = 1;
  const BatchVerdict verdict = lazy_kernels().test_batch(batch);
  out.expect(truth || (verdict.meet & 1) == 0, "the batch filter: missed=0 spurious=1");
  out.expect(!truth || ((verdict.meet | verdict.unknown) & 1) != 0,
             "the batch filter: missed=1 spurious=0");
}

// Short segments on a small grid: many lie on one line, and many of these touch in an end.
void check_segments(MutantFindings& out) {
  TriangleSource random(43);
  for (std::size_t i = 0; i < 1500; ++i) {
    const Vec3 a = random.grid_point(1), b = random.grid_point(1), c = random.grid_point(1);
    // Half of the time all four on one line.
    const Vec3 d = i % 2 == 0 ? random.grid_point(1) : Vec3(2 * b - a);
    const Vec3 from = i % 2 == 0 ? c : b;
    if (a == b || from == d) continue;  // a segment has two ends
    out.enter({"grid-segments", i, "segments_meet", "segment"});
    const bool meet = oracle::rational::triangles_intersect({a, b, b}, {from, d, d});
    out.expect(segments_meet(ordered_segment(a, b), ordered_segment(from, d)) == meet,
               meet ? "missed=1 spurious=0" : "missed=0 spurious=1");
    out.enter({"grid-segments", i, "point_on_segment", "segment"});
    const bool on = oracle::rational::triangles_intersect({a, b, b}, {c, c, c});
    out.expect(point_on_segment(c, ordered_segment(a, b)) == on,
               on ? "missed=1 spurious=0" : "missed=0 spurious=1");
  }
}

// A point beside an edge of which one end is off the diagonal by a few units in the last place: the
// differences round more than that.
// Source: Kettner, Mehlhorn, Pion, Schirra, Yap: Classroom Examples of Robustness Problems in
// Geometric Computations, ESA 2004.
void check_points_at_edges(MutantFindings& out) {
  TriangleSource random(44);
  for (std::size_t i = 0; i < 1000; ++i) {
    out.enter({"points-at-edges", i, "point_on_triangle", "point"});
    const auto beside_half = [&] { return 0.5 + 0x1p-53 * random.below(256); };
    const double x = beside_half();
    const TrianglePoints t = {Vec3(x, beside_half(), 0.5), Vec3(24, 24, 0.5), Vec3(0, 30, 0.5)};
    const Vec3 e(12, 12, 0.5);
    const bool on = oracle::rational::triangles_intersect(t, {e, e, e});
    out.expect(point_on_triangle(e, {t, 2}) == on,
               on ? "missed=1 spurious=0" : "missed=0 spurious=1");
  }
}

// Three points and a fourth one that rounding alone keeps off their plane or line: the worst cases
// of a filter.
void check_signs(MutantFindings& out) {
  TriangleSource random(42);
  for (std::size_t i = 0; i < 6000; ++i) {
    out.enter({"nearly-coplanar", i, "orient3d", "sign"});
    const TrianglePoints t = random.triangle(Vec3::Zero(), 1.0);
    const Vec3 &a = t[0], &b = t[1], &c = t[2];
    const Vec3 d = a + random.unit() * (b - a) + random.unit() * (c - a);
    out.expect(orient3d(a, b, c, d) == oracle::rational::orient3d(a, b, c, d), "wrong sign");
    if (i % 2 != 0) continue;
    out.enter({"nearly-collinear", i, "orient2d", "sign"});
    const Vec3 e = a + random.unit() * (b - a);
    for (int axis = 0; axis < 3; ++axis)
      out.expect(orient2d(a, b, e, axis) == oracle::rational::orient2d(a, b, e, axis),
                 "wrong sign");
  }
}

}  // namespace

void check_triangle_pairs(MutantFindings& out) {
  for (const NamedPairs& family : triangle_pairs())
    for (std::size_t i = 0; i < family.pairs.size(); ++i) {
      out.enter({family.name, i, "triangles_intersect", "triangle"});
      check_pair(family.pairs[i], out);
    }
  check_segments(out);
  check_points_at_edges(out);
  check_signs(out);
}

void check_labels(MutantFindings& out) {
  // Vertices on the planes between cells, and triangles that touch cells in corners and edges.
  const TriangleMesh meshes[] = {box_mesh(Vec3::Constant(-1), Vec3::Ones(), 2),
                                 sphere_mesh(Vec3::Zero(), 1.0, 1)};
  for (std::size_t m = 0; m < 2; ++m) {
    const auto shape = make_shape(meshes[m], {2, 3, 4}, 0.25);
    for (std::uint32_t t = 0; t < meshes[m].triangles.size(); ++t) {
      out.enter({m == 0 ? "labels-of-a-box" : "labels-of-a-sphere", t, "embedding", "label"});
      const auto& [a, b, c] = meshes[m].triangles[t];
      const auto& v = meshes[m].vertices;
      std::vector<std::uint32_t> truth;
      for (std::uint32_t cell = 0; cell < shape->lattice->cells.size(); ++cell)
        if (oracle::rational::triangle_meets_box({v[a], v[b], v[c]},
                                                 shape->lattice->cell_box(cell)))
          truth.push_back(cell);
      const auto label = shape->embedding.cells_of_triangle(t);
      out.expect_same(truth, std::vector(label.begin(), label.end()));
    }
  }
}

}  // namespace contactcheck::test
