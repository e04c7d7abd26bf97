// Fuzz target: the triangle tests of core against rational arithmetic, in several arrangements of a
// pair, with the filter of core/lazy on every instruction set that runs here.

#include <string>
#include <vector>

#include "core/lazy/kernels.h"
#include "core/narrow/predicates.h"
#include "core/narrow/triangle_box.h"
#include "core/narrow/triangle_triangle.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/hard_pair.h"

namespace contactcheck::test {
namespace {

using Pair = std::pair<TrianglePoints, TrianglePoints>;

// What broke, and the six corners as C++ takes them.
void require_for(const Pair& pair, bool kept, const char* promise) {
  if (kept) return;
  for (const TrianglePoints* t : {&pair.first, &pair.second})
    for (const Vec3& c : *t) std::fprintf(stderr, "Vec3(%a, %a, %a),\n", c.x(), c.y(), c.z());
  require(kept, promise);
}

TrianglePoints turned(const TrianglePoints& t, std::size_t by) {
  return {t[by % 3], t[(by + 1) % 3], t[(by + 2) % 3]};
}

TrianglePoints mirrored(const TrianglePoints& t) { return {t[0], t[2], t[1]}; }

// As many as a batch has lanes: either triangle first, other corners first, the other way round.
std::vector<Pair> arrangements(const Pair& pair) {
  const auto& [p, q] = pair;
  return {{p, q},
          {q, p},
          {turned(p, 1), q},
          {p, turned(q, 2)},
          {turned(q, 1), turned(p, 2)},
          {mirrored(p), q},
          {mirrored(q), turned(p, 1)},
          {p, mirrored(turned(q, 1))}};
}

TriangleBatch batch_of(const std::vector<Pair>& pairs) {
  TriangleBatch batch{};
  batch.count = pairs.size();
  for (std::size_t lane = 0; lane < pairs.size(); ++lane)
    for (std::size_t c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        batch.corner[0][c][axis][lane] = pairs[lane].first[c][axis];
        batch.corner[1][c][axis][lane] = pairs[lane].second[c][axis];
      }
  return batch;
}

void check_predicates(const Pair& pair) {
  const auto& [a, b, c] = pair.first;
  const Vec3& d = pair.second[0];
  const int side = oracle::rational::orient3d(a, b, c, d);
  require_for(pair, orient3d(a, b, c, d) == side, "orient3d is exact");
  require_for(pair, orient3d_exact(a, b, c, d) == side, "orient3d_exact is exact");
  for (int axis = 0; axis < 3; ++axis) {
    const int area = oracle::rational::orient2d(a, b, d, axis);
    require_for(pair, orient2d(a, b, d, axis) == area, "orient2d is exact");
    require_for(pair, orient2d_exact(a, b, d, axis) == area, "orient2d_exact is exact");
  }
}

void check_box(const Pair& pair) {
  Aabb box;
  box.extend(pair.second[0]);
  box.extend(pair.second[1]);
  require_for(
      pair,
      triangle_meets_box(pair.first, box) == oracle::rational::triangle_meets_box(pair.first, box),
      "triangle_meets_box is exact");
}

void check_filter(const Pair& pair, const TriangleBatch& batch, bool truth) {
  static const std::vector<std::string> isas = lazy_isas();
  for (const std::string& isa : isas) {
    const BatchVerdict verdict = lazy_kernels(isa).test_batch(batch);
    const std::uint32_t all = (1u << batch.count) - 1;
    const std::uint32_t wrong = truth ? all & ~(verdict.meet | verdict.unknown) : verdict.meet;
    if (wrong != 0) std::fprintf(stderr, "%s, lanes %x\n", isa.c_str(), wrong);
    require_for(pair, wrong == 0, "the filter of a batch is never wrong");
  }
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(triangles) {
  using namespace contactcheck;
  const auto pair = test::hard_pair({data, size});
  if (!pair) return test::kNotForTheCorpus;
  const bool truth = oracle::rational::triangles_intersect(pair->first, pair->second);
  const std::vector<test::Pair> all = test::arrangements(*pair);
  // As it is, swapped, and swapped and turned: more arrangements cost more than they find.
  for (const std::size_t i : {0, 1, 4})
    test::require_for(*pair, triangles_intersect(all[i].first, all[i].second) == truth,
                      "triangles_intersect is exact");
  test::check_filter(*pair, test::batch_of(all), truth);
  test::check_predicates(*pair);
  test::check_box(*pair);
  return 0;
}
