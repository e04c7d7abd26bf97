// The inner loops of the lazy detector, per compiled instruction set:
//   contactcheck_bench --benchmark_filter=lazy
// The states are set up as core/detect/lazy_detector.cpp does it.

#include <benchmark/benchmark.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/lazy/kernels.h"
#include "tests/bench/bench_bodies.h"
#include "tests/bench/register.h"
#include "tests/bench/stopwatch.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::bench {
namespace {

enum class Bounds { kFromNodes, kFromVertices };

/// Deformed instances of one shape, in one frame after the other. Their states point into it.
class Instances {
 public:
  Instances(const BodyShape& shape, Bounds bounds, std::size_t count)
      : shape_(shape),
        from_vertices_(bounds == Bounds::kFromVertices),
        tree_(make_lattice_tree(shape, from_vertices_ ? TreeUse::kVertices : TreeUse::kNodes)),
        states_(count),
        nodes_(count),
        vertices_(count) {
    for (LazyState& state : states_) {
      state.shape = &shape_;
      state.tree = &tree_;
      state.from_vertices = from_vertices_;
    }
    for (std::size_t i = 0; i < count; ++i) move(i, Vec3::Zero());
  }
  Instances(const Instances&) = delete;
  Instances& operator=(const Instances&) = delete;

  void move(std::size_t i, const Vec3& offset) {
    nodes_[i] = shaken_nodes(shape_, 0.02, offset);
    vertices_[i].resize(shape_.mesh.vertices.size());
    map_body(shape_, nodes_[i], vertices_[i]);
  }
  /// Forgets all bounds and mapped leaves.
  void begin_frame() {
    scratch_.arena.clear();
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (from_vertices_)
        begin_frame_by_vertices(states_[i], vertices_[i]);
      else
        begin_frame_by_nodes(states_[i], nodes_[i]);
    }
    place(states_);
    for (LazyState& state : states_) find_cells(state);
  }
  void bound_all(const LazyKernels& kernels) {
    for (LazyState& state : states_) kernels.bound_all(state, scratch_.arena);
  }
  void map_leaves(const LazyKernels& kernels) {
    for (LazyState& state : states_)
      for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf)
        benchmark::DoNotOptimize(kernels.map_leaf(state, leaf, scratch_.arena).x);
  }
  /// Contacts of the first two.
  std::size_t collide(const LazyKernels& kernels) {
    found_.clear();
    kernels.collide({{0, 1}, states_[0], states_[1]}, false, scratch_, found_);
    return found_.size();
  }
  const LatticeTree& tree() const { return tree_; }

 private:
  const BodyShape& shape_;
  bool from_vertices_;
  LatticeTree tree_;
  std::vector<LazyState> states_;
  std::vector<std::vector<Vec3>> nodes_, vertices_;
  LazyScratch scratch_;
  std::vector<ElementPair> found_;
};

std::int64_t children(const LatticeTree& tree) {
  std::int64_t count = 0;
  for (const TreeBlock& block : tree.blocks) count += block.children;
  return count;
}

/// A vertex of several leaves counts in each.
std::int64_t vertices_of_leaves(const LatticeTree& tree) {
  std::int64_t count = 0;
  for (const TreeLeaf& leaf : tree.leaves) count += leaf.vertices;
  return count;
}

/// What every iteration does to a body of which nothing is known yet.
void time_body(benchmark::State& state, const BenchBody& body, Bounds bounds,
               const std::function<void(Instances&)>& work,
               const std::function<std::int64_t(const LatticeTree&)>& items) {
  Instances one(*body.shape, bounds, 1);
  for (auto _ : state) {
    one.begin_frame();
    state.SetIterationTime(seconds_of([&] { work(one); }));
  }
  state.SetItemsProcessed(state.iterations() * items(one.tree()));
  state.SetLabel(body.name);
}

void bound_blocks(benchmark::State& state, const BenchBody& body, const LazyKernels& kernels) {
  time_body(
      state, body, Bounds::kFromNodes, [&](Instances& one) { one.bound_all(kernels); }, &children);
}

void map_leaves(benchmark::State& state, const BenchBody& body, const LazyKernels& kernels) {
  time_body(
      state, body, Bounds::kFromNodes, [&](Instances& one) { one.map_leaves(kernels); },
      &vertices_of_leaves);
}

void refit(benchmark::State& state, const BenchBody& body, const LazyKernels& kernels) {
  const auto triangles = static_cast<std::int64_t>(body.shape->mesh.triangles.size());
  time_body(
      state, body, Bounds::kFromVertices, [&](Instances& one) { one.bound_all(kernels); },
      [=](const LatticeTree&) { return triangles; });
}

using Pair = std::pair<TrianglePoints, TrianglePoints>;
using MakePair = Pair (*)(test::TriangleSource&);

Pair far_pair(test::TriangleSource& random) {
  return {random.triangle(Vec3::Zero(), 1.0), random.triangle(Vec3(10, 0, 0), 1.0)};
}

// Boxes overlap.
Pair near_pair(test::TriangleSource& random) {
  for (;;) {
    const Pair pair = {random.triangle(Vec3::Zero(), 1.0), random.triangle(Vec3::Zero(), 1.0)};
    Aabb boxes[2];
    for (const Vec3& c : pair.first) boxes[0].extend(c);
    for (const Vec3& c : pair.second) boxes[1].extend(c);
    if (boxes[0].overlaps(boxes[1]) && !triangles_intersect(pair.first, pair.second)) return pair;
  }
}

Pair intersecting_pair(test::TriangleSource& random) {
  for (;;) {
    const Pair pair = {random.triangle(Vec3::Zero(), 1.0), random.triangle(Vec3::Zero(), 1.0)};
    if (triangles_intersect(pair.first, pair.second)) return pair;
  }
}

TriangleBatch full_batch(test::TriangleSource& random, MakePair make_pair) {
  TriangleBatch batch{};
  for (std::uint32_t lane = 0; lane < kBatchWidth; ++lane) {
    const auto [p, q] = make_pair(random);
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        batch.corner[0][c][k][lane] = p[c][k];
        batch.corner[1][c][k][lane] = q[c][k];
      }
  }
  batch.count = kBatchWidth;
  return batch;
}

void test_batches(benchmark::State& state, MakePair make_pair, const LazyKernels& kernels) {
  constexpr std::size_t kBatches = 128;
  test::TriangleSource random(15);
  std::vector<TriangleBatch> batches;
  for (std::size_t i = 0; i < kBatches; ++i) batches.push_back(full_batch(random, make_pair));
  std::size_t next = 0;
  std::int64_t met = 0, unknown = 0;
  for (auto _ : state) {
    const BatchVerdict verdict = kernels.test_batch(batches[next++ % kBatches]);
    met += std::popcount(verdict.meet);
    unknown += std::popcount(verdict.unknown);
  }
  const std::int64_t pairs = state.iterations() * static_cast<std::int64_t>(kBatchWidth);
  state.SetItemsProcessed(pairs);
  state.counters["meet_share"] = static_cast<double>(met) / static_cast<double>(pairs);
  state.counters["unknown_share"] = static_cast<double>(unknown) / static_cast<double>(pairs);
}

/// Moves the second along x to where the two part, to 2^-12 of `extent`; then further by `gap`.
void move_to_parting(Instances& two, double extent, double gap) {
  double meet = 0.0, apart = 1.5 * extent;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (meet + apart);
    two.move(1, Vec3(middle, 0, 0));
    two.begin_frame();
    (two.collide(lazy_kernels()) > 0 ? meet : apart) = middle;
  }
  two.move(1, Vec3(apart + gap, 0, 0));
}

/// Whole frames. `gap`: in parts of the body's extent; negative: they meet.
void collide_pair(benchmark::State& state, const BenchBody& body, double gap,
                  const LazyKernels& kernels) {
  const double extent = bounding_box(body.shape->mesh.vertices).extent().x();
  Instances two(*body.shape, Bounds::kFromNodes, 2);
  move_to_parting(two, extent, gap * extent);
  std::size_t contacts = 0;
  for (auto _ : state) {
    two.begin_frame();
    benchmark::DoNotOptimize(contacts = two.collide(kernels));
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["contacts"] = static_cast<double>(contacts);
  state.SetLabel(body.name);
}

using BodyBench = void (*)(benchmark::State&, const BenchBody&, const LazyKernels&);

void register_body_benchmarks(const std::string& isa) {
  const std::pair<const char*, BodyBench> kinds[] = {
      {"bound", &bound_blocks}, {"map", &map_leaves}, {"refit", &refit}};
  for (const auto& [kind, run] : kinds)
    for (const auto body : {&small_body, &large_body}) {
      const std::string size = body == &small_body ? "small" : "large";
      benchmark::RegisterBenchmark(
          ("lazy_" + std::string(kind) + "/" + size + "/" + isa).c_str(),
          [=](benchmark::State& state) { run(state, body(), lazy_kernels(isa)); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
    }
}

void register_batch_benchmarks(const std::string& isa) {
  const std::pair<const char*, MakePair> kinds[] = {
      {"far", &far_pair}, {"near", &near_pair}, {"intersecting", &intersecting_pair}};
  for (const auto& [kind, make_pair] : kinds)
    benchmark::RegisterBenchmark(
        ("lazy_batch/" + std::string(kind) + "/" + isa).c_str(),
        [=](benchmark::State& state) { test_batches(state, make_pair, lazy_kernels(isa)); });
}

void register_pair_benchmarks(const std::string& isa) {
  const std::pair<const char*, double> kinds[] = {{"contact", -0.02}, {"near_miss", 0.001}};
  for (const auto& [kind, gap] : kinds)
    for (const auto body : {&small_body, &large_body}) {
      const std::string size = body == &small_body ? "small" : "large";
      benchmark::RegisterBenchmark(
          ("lazy_collide/" + std::string(kind) + "/" + size + "/" + isa).c_str(),
          [=](benchmark::State& state) { collide_pair(state, body(), gap, lazy_kernels(isa)); })
          ->Unit(benchmark::kMicrosecond);
    }
}

}  // namespace

void register_lazy_benchmarks() {
  for (const std::string& isa : lazy_isas()) {
    register_body_benchmarks(isa);
    register_batch_benchmarks(isa);
    register_pair_benchmarks(isa);
  }
}

}  // namespace contactcheck::bench
