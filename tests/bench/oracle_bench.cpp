// What one frame of truth costs: two bunnies side by side that pass through each other.

#include <benchmark/benchmark.h>

#include <string>

#include "reference/oracle/oracle.h"
#include "tests/bench/bench_bodies.h"
#include "tests/bench/register.h"
#include "tests/support/shapes.h"

namespace contactcheck::bench {
namespace {

void judge_frame(benchmark::State& state, const oracle::WantedTruth& wanted) {
  const auto& shape = small_body().shape;
  const std::vector<Body> bodies = {{"a", shape}, {"b", shape}};
  const double width = bounding_box(shape->mesh.vertices).extent().x();
  const test::FrameData data = test::make_frame(
      bodies,
      {shaken_nodes(*shape, 0.01, Vec3::Zero()), shaken_nodes(*shape, 0.01, {0.5 * width, 0, 0})});
  const Frame frame = data.frame();
  oracle::Oracle oracle(bodies);
  std::size_t pairs = 0;
  for (auto _ : state) pairs = oracle.judge(frame, wanted).surface.triangles.size();
  state.counters["triangle_pairs"] = static_cast<double>(pairs);
  state.SetLabel(small_body().name);
}

}  // namespace

void register_oracle_benchmarks() {
  oracle::WantedTruth surface, all;
  all.containment = all.vertices = all.boxes = true;
  benchmark::RegisterBenchmark("oracle/surface", &judge_frame, surface)
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("oracle/all", &judge_frame, all)->Unit(benchmark::kMillisecond);
}

}  // namespace contactcheck::bench
