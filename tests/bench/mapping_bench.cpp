// The canonical mapping against a plain gather, per compiled instruction set:
//   contactcheck_bench --benchmark_filter=mapping
// Both run in turn within every iteration, so that a busy machine slows both; `speedup_over_gather`
// is the median of the ratios of neighbours.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <string>

#include "core/deform/mapping.h"
#include "reference/results/statistics.h"
#include "tests/bench/bench_bodies.h"
#include "tests/bench/plain_gather.h"
#include "tests/bench/register.h"
#include "tests/bench/stopwatch.h"

namespace contactcheck::bench {
namespace {

// 0 chooses the best one again.
void choose_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void compare_with_gather(benchmark::State& state, const BenchBody& body, std::int64_t target) {
  choose_target(target);
  const BodyShape& shape = *body.shape;
  const PlainGather gather = make_plain_gather(shape);
  const std::vector<Vec3> nodes = shaken_nodes(shape, 0.02, Vec3::Zero());
  std::vector<Vec3> ours(shape.mesh.vertices.size()), plain(ours.size());
  std::vector<double> ratios;
  for (auto _ : state) {
    const double gather_time = seconds_of([&] { map_by_gather(gather, nodes, plain); });
    const double our_time =
        seconds_of([&] { map_vertices(*shape.lattice, shape.embedding, nodes, ours); });
    state.SetIterationTime(our_time);
    ratios.push_back(gather_time / our_time);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ours.size()));
  state.counters["speedup_over_gather"] = results::median(ratios);
  state.SetLabel(simd_target());
  choose_target(0);
}

void gather_alone(benchmark::State& state, const BenchBody& body) {
  const PlainGather gather = make_plain_gather(*body.shape);
  const std::vector<Vec3> nodes = shaken_nodes(*body.shape, 0.02, Vec3::Zero());
  std::vector<Vec3> plain(body.shape->mesh.vertices.size());
  for (auto _ : state) {
    map_by_gather(gather, nodes, plain);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(plain.size()));
}

}  // namespace

void register_mapping_benchmarks() {
  const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
  for (const auto body : {&small_body, &large_body}) {
    const std::string size = body == &small_body ? "small" : "large";
    benchmark::RegisterBenchmark(("plain_gather/" + size).c_str(), [body](benchmark::State& state) {
      gather_alone(state, body());
    })->Unit(benchmark::kMicrosecond);
    for (int bit = 0; bit < 63; ++bit) {
      const std::int64_t target = targets & (std::int64_t{1} << bit);
      if (target == 0) continue;
      const std::string name = "mapping/" + size + "/" + hwy::TargetName(target);
      benchmark::RegisterBenchmark(
          name.c_str(),
          [body, target](benchmark::State& state) { compare_with_gather(state, body(), target); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
    }
  }
}

}  // namespace contactcheck::bench
