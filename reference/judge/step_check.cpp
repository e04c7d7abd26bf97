#include "reference/judge/step_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/narrow/impact.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/elementary_impact.h"

namespace contactcheck::judge {
namespace {

[[noreturn]] void disagree(std::size_t step, const std::string& what) {
  throw std::runtime_error("frame " + std::to_string(step) + " to " + std::to_string(step + 1) +
                           ": " + what + "; that is an error of contactcheck");
}

EndState state_of(BodyPair bodies, const FrameContacts& frame) {
  if (bodies.a == bodies.b)
    return holds(frame.self, bodies.a) ? EndState::kContact : EndState::kApart;
  if (holds(frame.touching, bodies)) return EndState::kContact;
  return holds(frame.inside, bodies) ? EndState::kInside : EndState::kApart;
}

// The point of a segment that is nearest to `point`, as a share of its way.
double share_of_nearest(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 way = to - from;
  const double squared = way.squaredNorm();
  return squared > 0.0 ? std::clamp(way.dot(point - from) / squared, 0.0, 1.0) : 0.0;
}

// A point of the first edge where it is nearest to the second: that where their lines are nearest,
// if it is on both, else next to an end. Parallel edges have ends only.
Vec3 common_point(const std::array<Vec3, 4>& ends) {
  // From the first end and in the size of all four: squares stay within the range of doubles.
  double size = 0.0;
  for (const Vec3& end : ends) size = std::max(size, (end - ends[0]).cwiseAbs().maxCoeff());
  if (!(size > 0.0)) return ends[0];
  const Vec3 a = Vec3::Zero();
  const Vec3 b = (ends[1] - ends[0]) / size, c = (ends[2] - ends[0]) / size,
             d = (ends[3] - ends[0]) / size;
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 place = a;
  const auto offer = [&](const Vec3& on_first, const Vec3& on_second) {
    const double distance = (on_first - on_second).squaredNorm();
    if (distance >= nearest) return;
    nearest = distance;
    place = on_first;
  };
  const Vec3 normal = b.cross(d - c);
  if (const double squared = normal.squaredNorm(); squared > 0.0) {
    const Vec3 on_first = std::clamp(c.cross(d - c).dot(normal) / squared, 0.0, 1.0) * b;
    offer(on_first, c + share_of_nearest(c, d, on_first) * (d - c));
  }
  for (const Vec3& end : {a, b}) offer(end, c + share_of_nearest(c, d, end) * (d - c));
  for (const Vec3& end : {c, d}) offer(share_of_nearest(a, b, end) * b, end);
  return ends[0] + size * place;
}

// Right also where squares of lengths would leave the range of doubles. Zero if degenerate.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double scale_u = u.cwiseAbs().maxCoeff(), scale_v = v.cwiseAbs().maxCoeff();
  if (!(scale_u > 0.0 && scale_v > 0.0)) return Vec3::Zero();
  const Vec3 normal = (u / scale_u).cross(v / scale_v);
  return normal.isZero(0.0) ? Vec3::Zero() : normal.stableNormalized();
}

/// What the elements that were named say of each pair of bodies. core's exact test times all of
/// them; the oracle takes 30 us each, and tells which is first among those that can be.
class FoundElements {
 public:
  FoundElements(const Step& step, const scene::Scene& scene, const std::vector<MeshEdges>& edges)
      : step_(step), scene_(scene), edges_(edges) {}

  void add_vertex(const NearPair& pair) {
    const Triangle& t = scene_.bodies[pair.other].shape->mesh.triangles[pair.triangle];
    ElementImpact impact;
    impact.bodies = {pair.body, pair.other};
    impact.vertex = pair.vertex;
    impact.triangle = pair.triangle;
    add(impact, {pair.body, pair.other, pair.other, pair.other}, {pair.vertex, t[0], t[1], t[2]});
  }

  void add_edges(const ElementPair& pair) {
    const Edge &e = edges_[pair.body_a].edges[pair.a], &f = edges_[pair.body_b].edges[pair.b];
    ElementImpact impact;
    impact.kind = ImpactKind::edge_edge;
    impact.bodies = {pair.body_a, pair.body_b};
    impact.edges = {e, f};
    add(impact, {pair.body_a, pair.body_a, pair.body_b, pair.body_b}, {e[0], e[1], f[0], f[1]});
  }

  struct Found : StepContact {
    bool elements_touch = false;  ///< at the start
    /// Those that may be first, by core.
    std::vector<std::pair<ElementImpact, ImpactQuery>> candidates;
    double until = 2.0;  ///< nothing later than this is
  };
  /// After the last element.
  std::map<BodyPair, Found>& settled() {
    for (auto& [bodies, of] : found_)
      for (const auto& [impact, query] : of.candidates)
        if (impact.earliest <= of.until) confirm(impact, query, of);
    return found_;
  }

 private:
  void add(ElementImpact impact, const std::array<std::uint32_t, 4>& bodies,
           const std::array<std::uint32_t, 4>& vertices) {
    ImpactQuery query{impact.kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      query.start[i] = step_.start.bodies[bodies[i]].vertices[vertices[i]];
      query.end[i] = step_.end.bodies[bodies[i]].vertices[vertices[i]];
    }
    const Impact met = find_impact(query);
    const auto [low, high] = std::minmax(impact.bodies[0], impact.bodies[1]);
    Found& of = found_[{low, high}];
    of.bodies = {low, high};
    of.elements_touch = of.elements_touch || met.starts_in_contact;
    if (met.starts_in_contact) return;
    ++of.later;
    // What does not move is in contact at once or never.
    if (!find_impact({query.kind, query.end, query.end}).contact) ++of.passing;
    if (met.earliest > of.until) return;
    of.until = std::min(of.until, met.latest);
    impact.earliest = met.earliest;
    impact.latest = met.latest;
    of.candidates.emplace_back(impact, query);
  }

  void confirm(ElementImpact impact, const ImpactQuery& query, Found& of) const {
    const Impact truth = oracle::elementary_impact(query);
    if (!truth.contact || truth.starts_in_contact || truth.earliest > impact.latest ||
        truth.latest < impact.earliest)
      disagree(step_.index(), std::string(kStepDetector) + " and the oracle disagree on a " +
                                  name_of(impact.kind) + " pair");
    if (of.first && truth.earliest >= of.first->earliest) return;
    impact.earliest = truth.earliest;
    impact.latest = truth.latest;
    const double t = 0.5 * (truth.earliest + truth.latest);
    std::array<Vec3, 4> at;
    double motion = 0.0, reach = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      at[i] = (1.0 - t) * query.start[i] + t * query.end[i];
      motion = std::max(motion, (query.end[i] - query.start[i]).stableNorm());
      reach = std::max(
          {reach, query.start[i].cwiseAbs().maxCoeff(), query.end[i].cwiseAbs().maxCoeff()});
    }
    constexpr double kRounding = 0x1p-50;  // of a coordinate, for the few operations above
    impact.place_error = (truth.latest - truth.earliest) * motion + kRounding * reach;
    impact.place = impact.kind == ImpactKind::vertex_triangle ? at[0] : common_point(at);
    of.first = impact;
  }

  const Step& step_;
  const scene::Scene& scene_;
  const std::vector<MeshEdges>& edges_;
  std::map<BodyPair, Found> found_;
};

}  // namespace

StepChecker::StepChecker(const scene::Scene& scene, const AllowedContact& allowed,
                         const DetectorCatalog& catalog)
    : scene_(scene),
      allowed_(allowed),
      positions_(scene),
      detector_(catalog.make(catalog.parse(kStepDetector))) {
  std::vector<Question> questions;
  if (!allowed.contact) questions.push_back(Question::kImpacts);
  if (!allowed.self) questions.push_back(Question::kSelfImpacts);
  detector_->expect(questions);
  detector_->prepare(scene.bodies);
  for (const Body& body : scene.bodies) {
    edges_.push_back(mesh_edges(body.shape->mesh.triangles));
    mean_edges_.push_back(mean_edge(*body.shape));
  }
}

std::vector<StepContact> StepChecker::check(std::size_t k, const FrameContacts& at_start,
                                            const FrameContacts& at_end) {
  const auto frame = [&](std::size_t f) {
    const scene::FramePosition& position = positions_[f];
    return make_frame(f, scene_.time_of(f), position.nodes, position.vertices);
  };
  Step step;
  step.start = frame(k);
  step.end = frame(k + 1);
  measure(step);

  ContactSet answer;
  detector_->update_step(step);
  if (!allowed_.contact) detector_->query(Question::kImpacts, answer);
  if (!allowed_.self) detector_->query(Question::kSelfImpacts, answer);
  for (const Count& count : detector_->counts())
    if (count.name == "element_tests") totals_.element_tests += count.value;
  answer.canonicalize();

  FoundElements elements(step, scene_, edges_);
  for (const NearPair& pair : answer.impact_vertices) elements.add_vertex(pair);
  for (const ElementPair& pair : answer.impact_edges) elements.add_edges(pair);
  for (const NearPair& pair : answer.self_impact_vertices) elements.add_vertex(pair);
  for (const SelfPair& pair : answer.self_impact_edges)
    elements.add_edges({pair.body, pair.body, pair.a, pair.b});

  std::map<BodyPair, FoundElements::Found>& all = elements.settled();
  // Surfaces that cross at the start may do so without elements that meet.
  const auto note = [&](BodyPair bodies) { all[bodies].bodies = bodies; };
  for (const BodyPair& bodies : at_start.touching) note(bodies);
  for (const std::uint32_t body : at_start.self) note({body, body});
  // What meets in the next frame meets in this step.
  for (const BodyPair& bodies : at_end.touching)
    if (!all.contains(bodies))
      disagree(k, std::string(kStepDetector) + " misses bodies that touch at the end");

  std::map<BodyPair, double> times;
  for (const BodyImpact& impact : answer.impacts) times[impact.bodies] = impact.time.value_or(-1.0);
  std::vector<StepContact> out, own;
  for (auto& [bodies, found] : all) {
    found.start = state_of(bodies, at_start);
    found.end = state_of(bodies, at_end);
    if (found.own()) {
      // Neighbours of no area may touch at a vertex that is no self-contact of the frame.
      if (found.elements_touch) found.start = EndState::kContact;
      own.push_back(found);
      continue;
    }
    const bool starts = found.starts_in_contact();
    if (found.elements_touch && !starts)
      disagree(k, "the oracle and frame " + std::to_string(k) + " disagree");
    const double first = starts ? 0.0 : found.first->earliest;
    if (!times.contains(bodies) || std::abs(times[bodies] - first) > kImpactTimeWidth)
      disagree(k, std::string(kStepDetector) + " and the oracle disagree on a time");
    out.push_back(found);
  }
  out.insert(out.end(), own.begin(), own.end());
  return out;
}

void StepChecker::measure(const Step& step) {
  for (std::uint32_t b = 0; b < scene_.bodies.size(); ++b) {
    const std::span<const Vec3> start = step.start.bodies[b].vertices,
                                end = step.end.bodies[b].vertices;
    for (std::size_t v = 0; v < start.size() && mean_edges_[b] > 0.0; ++v)
      if (const double edges = (end[v] - start[v]).stableNorm() / mean_edges_[b];
          edges > (totals_.motion ? totals_.motion->edges : 0.0))
        totals_.motion = {edges, step.index(), b};
    const std::vector<Triangle>& triangles = scene_.bodies[b].shape->mesh.triangles;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [i, j, k] = triangles[t];
      const Vec3 before = unit_normal(start[i], start[j], start[k]),
                 after = unit_normal(end[i], end[j], end[k]);
      if (before.isZero(0.0) || after.isZero(0.0)) continue;
      const double degrees =
          std::atan2(before.cross(after).norm(), before.dot(after)) * 180.0 / std::numbers::pi;
      if (degrees > (totals_.turn ? totals_.turn->degrees : 0.0))
        totals_.turn = {degrees, step.index(), b, t};
    }
  }
}

}  // namespace contactcheck::judge
