#include "reference/check/frame_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/oracle/simple_solid.h"
#include "reference/text/counted.h"

namespace contactcheck::check {

using judge::BadFrame, judge::StepContact;
using text::counted;

namespace {

const char* words_of(judge::EndState state) {
  return state == judge::EndState::kApart     ? "apart"
         : state == judge::EndState::kContact ? "in contact"
                                              : "one inside the other";
}

// To the digits that are certified, and no more than a reader wants.
std::string place_text(const judge::ElementImpact& impact) {
  const double unit = std::pow(10.0, std::ceil(std::log10(impact.place_error)));
  std::string out;
  for (const double x : impact.place) {
    const double rounded = unit > 0.0 && std::isfinite(x / unit) ? std::round(x / unit) * unit : x;
    out += (out.empty() ? "" : ", ") + fmt::format("{:.9g}", rounded == 0.0 ? 0.0 : rounded);
  }
  return "(" + out + ")";
}

std::string pairs_text(std::size_t pairs, const std::array<std::uint32_t, 2>& first) {
  return counted(pairs, "pair") + " of triangles, first " + std::to_string(first[0]) + " and " +
         std::to_string(first[1]);
}

Json depth_json(const oracle::SurfaceDepth& depth) {
  if (depth.unknown) return nullptr;
  return {{"lower", depth.lower}, {"upper", depth.upper}};
}

// As many as a picture of a frame can show.
void add_listed(std::uint32_t a, std::uint32_t b, const judge::TrianglePairs& pairs,
                FlatPairs& out) {
  for (const auto& [one, other] : pairs)
    if (out.size() < 4 * judge::kListedPairs) out.insert(out.end(), {a, one, b, other});
}

}  // namespace

FrameWords::FrameWords(const scene::Scene& scene, std::vector<std::string> labels,
                       const Allowed& allowed)
    : scene_(scene), labels_(std::move(labels)), allowed_(allowed) {}

std::string FrameWords::place(std::size_t frame) const {
  return "frame " + std::to_string(frame) +
         (frame < labels_.size() ? " (" + labels_[frame] + ")" : "");
}

Json FrameWords::file(std::size_t frame) const {
  return frame < labels_.size() ? Json(labels_[frame]) : Json(nullptr);
}

std::uint32_t FrameWords::number(std::uint32_t body, std::uint32_t vertex) const {
  return scene_.bodies[body].shape->given.number_of(vertex);
}

FoundContacts FrameWords::of_frame(const BadFrame& bad) const {
  FoundContacts out;
  Json contacts = Json::array(), selfs = Json::array();
  for (const BadFrame::Pair& pair : bad.pairs) {
    contacts.push_back({{"bodies", {name(pair.bodies.a), name(pair.bodies.b)}},
                        {"triangle_pairs", pair.triangles},
                        {"first", pair.listed.empty() ? Json(nullptr) : Json(pair.listed.front())},
                        {"depth", depth_json(pair.depth)},
                        {"depth_unknown", unknown_json(pair.depth)}});
    out.words.push_back(sentence(pair));
    add_listed(pair.bodies.a, pair.bodies.b, pair.listed, out.pairs);
  }
  for (const BadFrame::Self& self : bad.selfs) {
    Json one = {{"body", name(self.body)}};
    for (const Level level : kSelfClasses)
      one[name_of(level)] = self.pairs.contains(level) ? self.pairs.at(level) : 0;
    one["first"] = self.listed.front();
    selfs.push_back(std::move(one));
    out.words.push_back(sentence(self));
    add_listed(self.body, self.body, self.listed, out.pairs);
  }
  out.event = {{"event", "frame"},
               {"frame", bad.frame},
               {"file", file(bad.frame)},
               {"contacts", std::move(contacts)},
               {"self", std::move(selfs)}};
  return out;
}

FoundContacts FrameWords::of_step(std::size_t step,
                                  const std::vector<StepContact>& contacts) const {
  FoundContacts out;
  Json list = Json::array();
  for (const StepContact& c : contacts) {
    out.found.push_back(!allowed_.in_step(c));
    Json first = nullptr;
    if (c.first) {
      first = {{"time", {{"lower", c.first->earliest}, {"upper", c.first->latest}}},
               {"elements", elements_json(*c.first)},
               {"place", {c.first->place.x(), c.first->place.y(), c.first->place.z()}},
               {"place_error", c.first->place_error}};
      if (out.found.back())
        out.pairs.insert(out.pairs.end(), {c.first->bodies[0], triangle_of(*c.first, 0),
                                           c.first->bodies[1], triangle_of(*c.first, 1)});
    }
    Json one = {{"bodies", {name(c.bodies.a), name(c.bodies.b)}},
                {"start", words_of(c.start)},
                {"end", words_of(c.end)},
                {"allowed", !out.found.back() || allowed_.impact}};
    one["first"] = std::move(first);
    one["later_pairs"] = c.later;
    one["passing_pairs"] = c.passing;
    list.push_back(std::move(one));
    out.words.push_back(sentence(step, c));
  }
  out.event = {{"event", "step"},
               {"step", step},
               {"files", {file(step), file(step + 1)}},
               {"paths", kPaths},
               {"contacts", std::move(list)}};
  return out;
}

std::string FrameWords::depth_text(const oracle::SurfaceDepth& depth) const {
  if (depth.unknown)
    return "depth unknown: " + name(depth.unknown->body) + ": " +
           oracle::describe(depth.unknown->fault, scene_.bodies[depth.unknown->body].shape->given);
  const auto [factor, unit] =
      depth.upper < 1.0 ? std::pair(1e3, " mm deep") : std::pair(1.0, " m deep");
  const std::string upper = fmt::format("{:.3g}", factor * depth.upper) + unit;
  // Three digits say no more than an interval of a thousandth does.
  if (depth.upper - depth.lower <= 1e-3 * depth.upper) return upper;
  if (depth.lower == 0.0) return "at most " + upper;
  return fmt::format("{:.3g} to ", factor * depth.lower) + upper;
}

std::string FrameWords::sentence(const BadFrame::Pair& pair) const {
  return name(pair.bodies.a) + " and " + name(pair.bodies.b) + ": " +
         (pair.listed.empty() ? "one is inside the other"
                              : pairs_text(pair.triangles, pair.listed.front())) +
         ", " + depth_text(pair.depth);
}

std::string FrameWords::sentence(const BadFrame::Self& self) const {
  std::size_t all = 0;
  std::string classes;
  for (const auto& [level, count] : self.pairs) {
    all += count;
    classes += (classes.empty() ? "" : ", ") + std::to_string(count) +
               (level == Level::kSelf         ? " without a shared vertex"
                : level == Level::kSelfVertex ? " that share a corner"
                                              : " that share an edge");
  }
  return name(self.body) + " with itself: " + pairs_text(all, self.listed.front()) + " (" +
         classes + ")";
}

Json FrameWords::unknown_json(const oracle::SurfaceDepth& depth) const {
  if (!depth.unknown) return nullptr;
  const auto& [body, fault] = *depth.unknown;
  Json out = {{"body", name(body)}, {"reason", oracle::name_of(fault.kind)}};
  if (fault.kind == oracle::NotSimple::kOpen) out["edge"] = {fault.edge.from, fault.edge.to};
  return out;
}

std::string FrameWords::elements_text(const judge::ElementImpact& impact, bool own) const {
  const auto of = [&](std::size_t i) { return own ? "" : " of " + name(impact.bodies[i]); };
  if (impact.kind == ImpactKind::vertex_triangle)
    return "vertex " + std::to_string(number(impact.bodies[0], impact.vertex)) + of(0) +
           " and triangle " + std::to_string(impact.triangle) + of(1);
  const auto edge = [&](std::size_t i) {
    return "the edge of vertices " + std::to_string(number(impact.bodies[i], impact.edges[i][0])) +
           " and " + std::to_string(number(impact.bodies[i], impact.edges[i][1])) + of(i);
  };
  return edge(0) + " and " + edge(1);
}

std::string FrameWords::first_text(const StepContact& c) const {
  const judge::ElementImpact& first = *c.first;
  return "at " + fmt::format("{:.6g}", first.earliest) + " of the step, " +
         elements_text(first, c.own()) + " at " + place_text(first);
}

std::string FrameWords::sentence(std::size_t step, const StepContact& c) const {
  std::string out = name(c.bodies.a) + (c.own() ? " with itself" : " and " + name(c.bodies.b));
  if (c.starts_in_contact()) {
    out += ": in contact from the start";
    if (c.first)
      out += "; " + counted(c.later, "more pair") + " of elements, first " + first_text(c) + ", " +
             std::to_string(c.passing) + " of them apart at both frames";
  } else {
    out += ": first " + first_text(c) + ", ";
    if (c.apart_at_both())
      out += "apart at both frames";
    else
      out += std::string(words_of(c.start)) + " at frame " + std::to_string(step) + ", " +
             words_of(c.end) + " at frame " + std::to_string(step + 1);
  }
  return out + ", " + kPaths;
}

Json FrameWords::elements_json(const judge::ElementImpact& impact) const {
  Json out = Json::array();
  for (std::size_t i = 0; i < 2; ++i) {
    Json one = {{"body", name(impact.bodies[i])}};
    if (impact.kind == ImpactKind::edge_edge)
      one["edge"] = {number(impact.bodies[i], impact.edges[i][0]),
                     number(impact.bodies[i], impact.edges[i][1])};
    else if (i == 0)
      one["vertex"] = number(impact.bodies[i], impact.vertex);
    else
      one["triangle"] = impact.triangle;
    out.push_back(std::move(one));
  }
  return out;
}

// One that has the element, since pictures mark triangles.
std::uint32_t FrameWords::triangle_of(const judge::ElementImpact& impact, std::size_t side) const {
  if (impact.kind == ImpactKind::vertex_triangle && side == 1) return impact.triangle;
  const Edge wanted = impact.kind == ImpactKind::edge_edge ? impact.edges[side]
                                                           : Edge{impact.vertex, impact.vertex};
  const std::vector<Triangle>& triangles = scene_.bodies[impact.bodies[side]].shape->mesh.triangles;
  const auto has = [&](const Triangle& t) {
    return std::ranges::all_of(wanted,
                               [&](std::uint32_t v) { return std::ranges::find(t, v) != t.end(); });
  };
  return static_cast<std::uint32_t>(std::ranges::find_if(triangles, has) - triangles.begin());
}

}  // namespace contactcheck::check
