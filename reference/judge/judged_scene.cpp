#include "reference/judge/judged_scene.h"

#include <algorithm>
#include <thread>

#include "reference/oracle/rational_clipping.h"

namespace contactcheck::judge {

std::uint64_t PairTally::checked() const {
  std::uint64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.pairs;
  return sum;
}

std::uint64_t PairTally::touching() const {
  std::uint64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.touching;
  return sum;
}

void check_pairs(const scene::RandomPairs& pairs, std::size_t frame,
                 const std::vector<std::vector<Vec3>>& vertices, const oracle::Truth& truth,
                 PairTally& tally, unsigned threads) {
  const std::size_t count = pairs.pairs_of_frame(frame);
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());

  // Each thread takes every N-th pair: kinds differ in cost, and neighbours differ in kind.
  const std::vector<Triangle>& triangles = pairs.shape()->mesh.triangles;
  std::vector<char> touching(count, 0);
  const auto judge_from = [&](std::size_t first) {
    const auto corners = [&](std::size_t slot,
                             std::size_t body) -> oracle::rational::TriangleCorners {
      const Triangle& t = triangles[slot];
      return {vertices[body][t[0]], vertices[body][t[1]], vertices[body][t[2]]};
    };
    for (std::size_t slot = first; slot < count; slot += threads)
      touching[slot] =
          oracle::rational::triangles_intersect_by_clipping(corners(slot, 0), corners(slot, 1));
  };
  {
    std::vector<std::jthread> team;
    for (unsigned t = 1; t < threads; ++t) team.emplace_back(judge_from, t);
    judge_from(0);
  }

  const std::vector<ElementPair>& reported = truth.surface.triangles;
  const auto pair_of_slot = [](std::size_t slot) {
    const auto triangle = static_cast<std::uint32_t>(slot);
    return ElementPair{0, 1, triangle, triangle};
  };
  const auto note = [&](const char* kind, const ElementPair& pair) {
    ++tally.oracle_wrong;
    for (const Disagreement& d : tally.disagreements)
      if (d.kind == kind) return;
    Disagreement& d = tally.disagreements.emplace_back();
    d.level = name_of(Level::kTriangle);
    d.kind = kind;
    d.frame = frame;
    d.pair = pair;
  };
  for (std::size_t slot = 0; slot < count; ++slot) {
    PairTally::Kind& kind =
        tally.kinds[static_cast<std::size_t>(scene::RandomPairs::kind_of(frame, slot))];
    ++kind.pairs;
    kind.touching += touching[slot] != 0;
    const ElementPair pair = pair_of_slot(slot);
    if (touching[slot] && !std::binary_search(reported.begin(), reported.end(), pair))
      note("missed", pair);
  }
  for (const ElementPair& pair : reported)
    if (pair != pair_of_slot(pair.a) || pair.a >= count || !touching[pair.a])
      note("spurious", pair);
}

double mean_edge(const BodyShape& shape) {
  double sum = 0.0;
  for (const Triangle& t : shape.mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      sum += (shape.mesh.vertices[t[i]] - shape.mesh.vertices[t[(i + 1) % 3]]).stableNorm();
  return sum / static_cast<double>(3 * shape.mesh.triangles.size());
}

Frame make_frame(std::size_t index, double time, const std::vector<std::vector<Vec3>>& nodes,
                 const std::vector<std::vector<Vec3>>& vertices) {
  Frame frame;
  frame.index = index;
  frame.time = time;
  for (std::size_t b = 0; b < nodes.size(); ++b) frame.bodies.push_back({nodes[b], vertices[b]});
  return frame;
}

oracle::WantedTruth wanted_truth(const scene::Scene& scene) {
  oracle::WantedTruth wanted;
  wanted.containment = scene.judges(Level::kContainment) || scene.judges(Level::kBody);
  wanted.vertices = scene.judges(Level::kVertex);
  wanted.boxes = scene.judges(Level::kBox);
  wanted.self = any_self(scene.levels);
  return wanted;
}

oracle::WantedSteps wanted_steps(const scene::Scene& scene) {
  const auto any_of_levels = [&](auto&& is_wanted) {
    return std::any_of(scene.levels.begin(), scene.levels.end(), is_wanted);
  };
  return {any_of_levels([](Level level) { return is_impact(level) && !is_self_impact(level); }),
          any_of_levels(is_self_impact)};
}

Frame JudgedScene::frame(std::size_t index) const {
  const scene::FramePosition& position = positions[index];
  return make_frame(index, scene->time_of(index), position.nodes, position.vertices);
}

Step JudgedScene::step(std::size_t index) const {
  Step step;
  step.start = frame(index);
  step.end = frame(index + 1);
  return step;
}

std::vector<bool> JudgedScene::contact_steps() const {
  std::vector<bool> out;
  for (const oracle::StepTruth& step : steps) {
    const ContactSet& c = step.contacts;
    out.push_back(!c.impacts.empty() || !c.self_impact_vertices.empty() ||
                  !c.self_impact_edges.empty());
  }
  return out;
}

std::vector<double> separations(const JudgedScene& judged, process::ProgressWriter& progress) {
  const scene::Scene& scene = *judged.scene;
  std::vector<double> out;
  // Not for drawn scenes: it adds little to their parameters, and costs more than all else: exact
  // distances of up to 190 pairs of bodies in each frame.
  if (scene.family() || scene.pairs() || scene.drawn || scene.bodies.size() < 2) return out;
  oracle::Oracle oracle(scene.bodies);
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(process::SharedProgress::kNoDetector, f, process::Phase::kTruth);
    out.push_back(judged.contact_frames[f] ? 0.0 : oracle.separation(judged.frame(f)).upper);
  }
  return out;
}

}  // namespace contactcheck::judge
