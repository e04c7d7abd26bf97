#include "reference/judge/closed_loop.h"

#include <algorithm>
#include <map>

#include "reference/judge/accuracy.h"
#include "reference/judge/judged_scene.h"
#include "reference/judge/rounded_scene.h"
#include "reference/scene/simulate_scene.h"

namespace contactcheck::judge {
namespace {

Vec3 center_of(const std::vector<Vec3>& nodes) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& node : nodes) sum += node;
  return sum / static_cast<double>(nodes.size());
}

// How often a pair of bodies leaves a true contact on the other side from where it came.
std::size_t count_tunnelling(const JudgedScene& judged) {
  struct Passage {
    Vec3 before;  // from a to b, in the last frame without contact
    bool in_contact = false;
  };
  std::map<BodyPair, Passage> passages;
  std::size_t events = 0;
  for (std::size_t f = 0; f < judged.scene->frames; ++f) {
    const std::vector<BodyPair>& touching = judged.truth[f].surface.bodies;
    const std::vector<std::vector<Vec3>>& nodes = judged.positions[f].nodes;
    for (std::uint32_t a = 0; a < nodes.size(); ++a)
      for (std::uint32_t b = a + 1; b < nodes.size(); ++b) {
        const Vec3 direction = center_of(nodes[b]) - center_of(nodes[a]);
        Passage& passage =
            passages.try_emplace(BodyPair{a, b}, Passage{direction, false}).first->second;
        if (std::binary_search(touching.begin(), touching.end(), BodyPair{a, b})) {
          passage.in_contact = true;
          continue;
        }
        if (passage.in_contact && direction.dot(passage.before) < 0.0) ++events;
        passage = {direction, false};
      }
  }
  return events;
}

// The distances of the pairs that are reported in contact in the last tenth of the frames.
void measure_hover(JudgingTools& tools, const scene::SimulatedMotion& motion,
                   results::ClosedLoop& out) {
  constexpr std::size_t kTenth = 10;
  const std::size_t frames = motion.frames.size();
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t f = frames - std::max<std::size_t>(frames / kTenth, 1); f < frames; ++f)
    for (const BodyPair& pair : motion.reported[f]) {
      const double gap = tools.oracle.distance(tools.judged.frame(f), pair).upper;
      sum += gap;
      ++pairs;
      out.hover_at_rest_max = std::max(out.hover_at_rest_max.value_or(0.0), gap);
    }
  if (pairs > 0) out.hover_at_rest_mean = sum / static_cast<double>(pairs);
}

void measure_penetration(JudgingTools& tools, results::ClosedLoop& out) {
  const std::vector<Body>& bodies = tools.judged.scene->bodies;
  if (std::none_of(bodies.begin(), bodies.end(),
                   [](const Body& body) { return body.shape->topology.solid; }))
    return;
  out.deepest_penetration = 0.0;
  for (std::size_t f = 0; f < tools.judged.truth.size(); ++f) {
    tools.geometry.set_frame(tools.judged.frame(f));
    for (const VertexInBody& inside : tools.judged.truth[f].surface.vertices)
      out.deepest_penetration =
          std::max(*out.deepest_penetration, tools.geometry.vertex_to_surface(inside).depth);
  }
}

}  // namespace

results::ClosedLoop run_closed_loop(const scene::Scene& scene, std::uint32_t position,
                                    const std::function<std::unique_ptr<Detector>()>& make,
                                    process::ProgressWriter& progress) {
  results::ClosedLoop out;
  scene::SimulatedMotion motion;
  try {
    progress.enter(position, 0, process::Phase::kPrepare);  // a detector may hang while it is made
    motion = scene::simulate(scene, *make(), [&](std::size_t step) {
      progress.enter(position, step / scene.simulation->every, process::Phase::kUpdate);
    });
  } catch (const Diverged& e) {
    out.error = e.what();
    return out;
  }
  scene::Scene own = scene;
  own.recorded = motion.frames;
  const JudgedScene judged = judge_scene(own, progress);
  if (!judged.refused.empty()) {
    out.error = judged.refused;
    return out;
  }
  JudgingTools tools(judged);
  const double highest = *std::max_element(motion.energy.begin(), motion.energy.end());
  if (motion.highest_kinetic > 0.0)
    out.energy_gain = (highest - motion.energy.front()) / motion.highest_kinetic;
  out.last_speed = motion.last_speed;
  out.steps = motion.energy.size() - 1;
  measure_hover(tools, motion, out);
  measure_penetration(tools, out);
  out.tunnelling_events = count_tunnelling(judged);
  results::Run run;
  progress.enter(position, 0, process::Phase::kPrepare);
  const std::unique_ptr<Detector> again = make();
  run_accuracy(tools, position, *again, progress, run);
  out.levels = run.levels;
  return out;
}

}  // namespace contactcheck::judge
