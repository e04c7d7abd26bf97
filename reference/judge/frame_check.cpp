#include "reference/judge/frame_check.h"

#include <sched.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/types/check.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/closed_chain.h"
#include "reference/text/file_text.h"

namespace contactcheck::judge {
namespace {

// Those that this process may use; the detector has at most 256 threads.
unsigned usable_processors() {
  cpu_set_t processors;
  if (sched_getaffinity(0, sizeof processors, &processors) != 0) return 1;
  return static_cast<unsigned>(std::clamp(CPU_COUNT(&processors), 1, 256));
}

}  // namespace

FrameChecker::FrameChecker(const scene::Scene& scene, const AllowedContact& allowed,
                           const DetectorCatalog& catalog)
    : scene_(scene),
      allowed_(allowed),
      positions_(scene),
      detector_(catalog.make(catalog.parse(std::string(kFrameDetector) +
                                           ":threads=" + std::to_string(usable_processors())))),
      oracle_(scene.bodies),
      geometry_(scene.bodies) {
  std::vector<Question> questions;
  if (!allowed.contact) questions.push_back(Question::kTriangles);
  if (!allowed.self) questions.push_back(Question::kSelf);
  detector_->expect(questions);
  detector_->prepare(scene.bodies);
}

std::optional<BadFrame> FrameChecker::check(std::size_t f) {
  const scene::FramePosition& position = positions_[f];
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    if (const auto torn = torn_weld(*scene_.bodies[b].shape, position.vertices[b]))
      throw InputError("frame " + std::to_string(f) + ": vertices " + std::to_string((*torn)[0]) +
                       " and " + std::to_string((*torn)[1]) + " of body " +
                       text::in_quotes(scene_.bodies[b].name) +
                       " are welded and come apart; without --weld they may");
  const Frame frame =
      make_frame(f, static_cast<double>(f) * scene_.time_step, position.nodes, position.vertices);
  ContactSet found;
  detector_->update(frame);
  if (!allowed_.contact) detector_->query(Question::kTriangles, found);
  if (!allowed_.self) detector_->query(Question::kSelf, found);
  found.canonicalize();
  // Surfaces that do not meet, one of them inside a solid: no pair of triangles tells.
  oracle::Containment inside;
  if (!allowed_.contact && scene_.bodies.size() > 1)
    inside = oracle_.containment(frame, found.bodies);
  for (const oracle::OpenBody& open : inside.open)
    open_.try_emplace(open.body,
                      oracle::open_reason(open.edge, scene_.bodies[open.body].shape->given,
                                          "frame " + std::to_string(f)));
  contacts_ = {found.bodies, inside.pairs, found.self_bodies};
  if (found.triangles.empty() && found.self.empty() && inside.pairs.empty()) return std::nullopt;
  return confirmed(f, frame, found);
}

oracle::Truth FrameChecker::judged(std::size_t f, const Frame& frame,
                                   const oracle::WantedTruth& wanted) {
  try {
    return oracle_.judge(frame, wanted);
  } catch (const RefusedInput& e) {
    throw InputError("frame " + std::to_string(f) + ": " + e.what());
  }
}

std::optional<BadFrame> FrameChecker::confirmed(std::size_t f, const Frame& frame,
                                                const ContactSet& found) {
  oracle::WantedTruth wanted;
  wanted.containment = wanted.triangles = !allowed_.contact;
  wanted.self = !allowed_.self;
  const oracle::Truth truth = judged(f, frame, wanted);
  if (truth.surface.triangles != found.triangles || truth.surface.self != found.self)
    throw std::runtime_error("frame " + std::to_string(f) + ": " + kFrameDetector +
                             " and the oracle disagree; that is an error of contactcheck");
  BadFrame out;
  out.frame = f;
  add_pairs(frame, truth, out);
  for (const std::uint32_t body : truth.surface.self_bodies) {
    BadFrame::Self& self = out.selfs.emplace_back();
    self.body = body;
    for (const Level level : kSelfClasses)
      for (const SelfPair& pair : self_pairs(level, scene_.bodies, truth.surface.self)) {
        if (pair.body != body) continue;
        if (self.listed.size() < kListedPairs) self.listed.push_back({pair.a, pair.b});
        ++self.pairs[level];
      }
  }
  if (out.pairs.empty() && out.selfs.empty()) return std::nullopt;
  return out;
}

void FrameChecker::add_pairs(const Frame& frame, const oracle::Truth& truth, BadFrame& out) {
  geometry_.set_frame(frame);
  std::map<BodyPair, BadFrame::Pair> pairs;
  for (const BodyPair& bodies : truth.surface.bodies) pairs[bodies].bodies = bodies;
  for (const BodyPair& bodies : truth.containment) pairs[bodies].bodies = bodies;
  for (const ElementPair& p : truth.surface.triangles) {
    BadFrame::Pair& pair = pairs.at({p.body_a, p.body_b});
    if (pair.listed.size() < kListedPairs) pair.listed.push_back({p.a, p.b});
    ++pair.triangles;
  }
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  for (auto& [bodies, pair] : pairs) {
    pair.depth = geometry_.surface_depth(bodies, allowed_.depth.value_or(kNone));
    if (!allowed_.depth || pair.depth.unknown || pair.depth.upper > *allowed_.depth)
      out.pairs.push_back(pair);
  }
}

}  // namespace contactcheck::judge
