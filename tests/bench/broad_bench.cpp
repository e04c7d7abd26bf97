// The spatial hash and the pairs of boxes found through it.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/broad/box_pairs.h"
#include "core/broad/spatial_hash.h"
#include "tests/bench/register.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::bench {
namespace {

constexpr double kCell = 1.0;
constexpr std::uint32_t kBodies = 8;

// Boxes of about one cell each, so dense that a box meets a few others at every count.
double world_radius(std::int64_t boxes) { return 0.5 * std::cbrt(static_cast<double>(boxes)); }

std::vector<OwnedBox> random_boxes(std::int64_t count) {
  test::TriangleSource random(13);
  std::vector<OwnedBox> boxes;
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3 center = random.point(Vec3::Zero(), world_radius(count));
    boxes.push_back({random.box(center, 0.5 * kCell), static_cast<std::uint32_t>(i) % kBodies,
                     static_cast<std::uint32_t>(i)});
  }
  return boxes;
}

void box_pairs(benchmark::State& state) {
  const std::vector<OwnedBox> boxes = random_boxes(state.range(0));
  BoxPairSettings settings;
  settings.cell_size = kCell;
  BoxPairFinder finder;
  std::vector<BoxPairFinder::Pair> pairs;
  for (auto _ : state) {
    pairs.clear();
    finder.find(boxes, settings, pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["pairs_per_box"] =
      static_cast<double>(pairs.size()) / static_cast<double>(boxes.size());
}

std::vector<GridKey> random_keys(std::int64_t count) {
  test::TriangleSource random(14);
  std::vector<GridKey> keys;
  for (std::int64_t i = 0; i < count; ++i)
    keys.push_back(grid_key(random.point(Vec3::Zero(), world_radius(count)), kCell));
  return keys;
}

void fill(const std::vector<GridKey>& keys, SpatialHash& hash) {
  hash.clear();
  for (std::uint32_t i = 0; i < keys.size(); ++i) hash.insert(keys[i], i);
  hash.build();
}

void hash_build(benchmark::State& state) {
  const std::vector<GridKey> keys = random_keys(state.range(0));
  SpatialHash hash;
  for (auto _ : state) {
    fill(keys, hash);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void hash_lookup(benchmark::State& state) {
  const std::vector<GridKey> keys = random_keys(state.range(0));
  SpatialHash hash;
  fill(keys, hash);
  std::size_t found = 0;
  for (auto _ : state)
    for (const GridKey& key : keys) hash.for_each(key, [&](std::uint32_t) { ++found; });
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["found_per_key"] = static_cast<double>(found) /
                                    static_cast<double>(state.iterations()) /
                                    static_cast<double>(keys.size());
}

}  // namespace

void register_broad_benchmarks() {
  benchmark::RegisterBenchmark("box_pairs", &box_pairs)->Arg(1000)->Arg(10000);
  benchmark::RegisterBenchmark("hash_build", &hash_build)->Arg(1000)->Arg(10000);
  benchmark::RegisterBenchmark("hash_lookup", &hash_lookup)->Arg(1000)->Arg(10000);
}

}  // namespace contactcheck::bench
