// Candidate pairs of triangles, tested exactly and eight at a time by the kernels that ffd-lazy
// uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/broad/adjacent_pairs.h"
#include "core/deform/body.h"
#include "core/detect/detector.h"
#include "core/lazy/kernels.h"
#include "core/types/vec3.h"

namespace contactcheck {

/// Tests candidates of two bodies, or of one.
class ExactPairs {
 public:
  /// The bodies of the candidates that follow; their vertices outlive them.
  void begin(const BodyShape& a, std::span<const Vec3> vertices_a, const BodyShape& b,
             std::span<const Vec3> vertices_b) {
    triangles_a_ = a.mesh.triangles.data();
    triangles_b_ = b.mesh.triangles.data();
    vertices_a_ = vertices_a;
    vertices_b_ = vertices_b;
    for (TriangleBatch& batch : waiting_.of) batch.count = 0;
  }

  /// Calls `meets(i, j)` for each pair known to meet, in more than what it shares, now or at a
  /// later call.
  template <typename Meets>
  void add(const AdjacentPair& pair, Meets&& meets) {
    const Triangle &s = triangles_a_[pair.a], &t = triangles_b_[pair.b];
    const Vec3* const p[3] = {&vertices_a_[s[0]], &vertices_a_[s[1]], &vertices_a_[s[2]]};
    const Vec3* const q[3] = {&vertices_b_[t[0]], &vertices_b_[t[1]], &vertices_b_[t[2]]};
    const Aabb box_p = {p[0]->cwiseMin(*p[1]).cwiseMin(*p[2]),
                        p[0]->cwiseMax(*p[1]).cwiseMax(*p[2])};
    const Aabb box_q = {q[0]->cwiseMin(*q[1]).cwiseMin(*q[2]),
                        q[0]->cwiseMax(*q[1]).cwiseMax(*q[2])};
    if (!box_p.overlaps(box_q)) return;  // candidates may be of wider boxes
    TriangleBatch& batch = waiting_.of[pair.shared.count];
    const std::size_t lane = batch.count++;
    batch.a[lane] = pair.a;
    batch.b[lane] = pair.b;
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        batch.corner[0][c][k][lane] = (*p[pair.shared.p[c]])[k];
        batch.corner[1][c][k][lane] = (*q[pair.shared.q[c]])[k];
      }
    if (batch.count == kBatchWidth) flush(batch, meets);
  }

  template <typename Meets>
  void flush(Meets&& meets) {
    for (TriangleBatch& batch : waiting_.of) flush(batch, meets);
  }

  std::vector<Count> counts() const {
    return {{"triangle_tests", tests_}, {"batches_of_eight", batches_}};
  }
  void clear_counts() { tests_ = batches_ = 0; }

 private:
  template <typename Meets>
  void flush(TriangleBatch& batch, Meets&& meets) {
    if (batch.count == 0) return;
    const BatchVerdict verdict = kernels_.test_batch(batch);
    for (std::size_t lane = 0; lane < batch.count; ++lane)
      if ((verdict.meet >> lane & 1u) != 0 ||
          ((verdict.unknown >> lane & 1u) != 0 && batch.meets(lane)))
        meets(batch.a[lane], batch.b[lane]);
    tests_ += batch.count;
    ++batches_;
    batch.count = 0;
  }

  const LazyKernels& kernels_ = lazy_kernels();
  const Triangle *triangles_a_ = nullptr, *triangles_b_ = nullptr;
  std::span<const Vec3> vertices_a_, vertices_b_;
  TriangleBatchSet<double> waiting_;
  std::uint64_t tests_ = 0, batches_ = 0;
};

}  // namespace contactcheck
