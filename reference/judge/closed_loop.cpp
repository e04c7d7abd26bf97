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

// How often a pair of bodies leaves a true contact on the other side from where it came. While one
// is inside the other they are in contact, though their surfaces may not be.
std::size_t count_tunnelling(const JudgedScene& judged) {
  struct Passage {
    Vec3 before;  // from a to b, in the last frame without contact
    bool in_contact = false;
  };
  std::map<BodyPair, Passage> passages;
  std::size_t events = 0;
  for (std::size_t f = 0; f < judged.scene->frames; ++f) {
    const std::vector<BodyPair> in_contact = true_body_pairs(true, judged.truth[f]);
    const std::vector<std::vector<Vec3>>& nodes = judged.positions[f].nodes;
    for (std::uint32_t a = 0; a < nodes.size(); ++a)
      for (std::uint32_t b = a + 1; b < nodes.size(); ++b) {
        const Vec3 direction = center_of(nodes[b]) - center_of(nodes[a]);
        Passage& passage =
            passages.try_emplace(BodyPair{a, b}, Passage{direction, false}).first->second;
        if (std::binary_search(in_contact.begin(), in_contact.end(), BodyPair{a, b})) {
          passage.in_contact = true;
          continue;
        }
        if (passage.in_contact && direction.dot(passage.before) < 0.0) ++events;
        passage = {direction, false};
      }
  }
  return events;
}

// The distances of the pairs that are reported in contact in the last tenth of the frames; 0 where
// they are in what the detector takes for contact.
void measure_hover(JudgingTools& tools, const scene::SimulatedMotion& motion, bool solid,
                   results::ClosedLoop& out) {
  constexpr std::size_t kTenth = 10;
  const std::size_t frames = motion.frames.size();
  double sum = 0.0;
  std::size_t pairs = 0;
  for (std::size_t f = frames - std::max<std::size_t>(frames / kTenth, 1); f < frames; ++f) {
    const std::vector<BodyPair> in_contact = true_body_pairs(solid, tools.judged.truth[f]);
    for (const BodyPair& pair : motion.reported[f]) {
      const double gap = std::binary_search(in_contact.begin(), in_contact.end(), pair)
                             ? 0.0
                             : tools.oracle.distance(tools.judged.frame(f), pair).upper;
      sum += gap;
      ++pairs;
      out.hover_at_rest_max = std::max(out.hover_at_rest_max.value_or(0.0), gap);
    }
  }
  if (pairs > 0) out.hover_at_rest_mean = sum / static_cast<double>(pairs);
}

void measure_penetration(JudgingTools& tools, results::ClosedLoop& out) {
  const scene::Scene& scene = *tools.judged.scene;
  const std::vector<std::string>& open = tools.judged.open;
  if (!scene.judges(Level::kVertex) ||
      std::none_of(open.begin(), open.end(), [](const std::string& why) { return why.empty(); }))
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
      progress.enter(position, step / scene.simulation()->every, process::Phase::kUpdate);
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
  measure_penetration(tools, out);
  out.tunnelling_events = count_tunnelling(judged);
  results::Run run;
  progress.enter(position, 0, process::Phase::kPrepare);
  const std::unique_ptr<Detector> again = make();
  run_accuracy(tools, position, *again, progress, run);
  measure_hover(tools, motion, run.semantics.solid, out);
  out.levels = run.levels;
  return out;
}

}  // namespace contactcheck::judge
