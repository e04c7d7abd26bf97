#include "reference/cli/step_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "reference/cli/event_lines.h"
#include "reference/text/counted.h"

namespace contactcheck::cli {

using Json = nlohmann::ordered_json;
using judge::StepContact;
using text::counted;

void print_event(const Json& event) { EventLines(true).print(event.dump()); }

std::string FrameNames::place(std::size_t frame) const {
  return "frame " + std::to_string(frame) +
         (frame < labels.size() ? " (" + labels[frame] + ")" : "");
}

Json FrameNames::file(std::size_t frame) const {
  return frame < labels.size() ? Json(labels[frame]) : Json(nullptr);
}

namespace {

// What every line about a step says: the frames may be joined by other paths.
constexpr const char* kPaths = "on straight paths between these frames";

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

}  // namespace

void StepReport::step(std::size_t step, const std::vector<StepContact>& contacts) {
  if (contacts.empty()) return;
  const auto is_found = [&](const StepContact& c) { return !allowed_.in_step(c); };
  if (std::ranges::any_of(contacts, &StepContact::starts_in_contact)) ++starting_;
  for (const StepContact& c : contacts)
    if (c.starts_in_contact()) passing_ += c.passing;
  if (const auto found = std::ranges::find_if(contacts, is_found); found != contacts.end()) {
    found_.push_back(step);
    if (found_.size() == 1) {
      first_words_ = frames_.step(step) + ", " + sentence(step, *found);
      first_has_own_ = std::ranges::any_of(
          contacts, [&](const StepContact& c) { return is_found(c) && c.own(); });
    }
    if (std::ranges::any_of(contacts,
                            [&](const StepContact& c) { return is_found(c) && c.apart_at_both(); }))
      ++unseen_;
  }
  if (json_) return print_event(json_of(step, contacts));
  if (std::ranges::none_of(contacts, is_found) || found_.size() > kMostShown) return;
  std::printf("\n%s\n", frames_.step(step).c_str());
  for (const StepContact& c : contacts) std::printf("  %s\n", sentence(step, c).c_str());
  std::fflush(stdout);
}

results::Finding StepReport::finding() const {
  std::string more;
  for (std::size_t i = 1; i < found_.size() && i < kMostShown; ++i)
    more += (i == 1 ? "; then frames " : ", ") + std::to_string(found_[i]) + " to " +
            std::to_string(found_[i] + 1);
  if (found_.size() > kMostShown)
    more += " and " + counted(found_.size() - kMostShown, "more step");
  return {count_text() + ", " + kPaths, first_words_ + more};
}

void StepReport::print_end(const judge::StepChecker& checker) const {
  if (found_.size() > kMostShown)
    std::printf("\n... and %s\n", counted(found_.size() - kMostShown, "more step").c_str());
  if (found_.empty())
    std::printf("no step has a contact that is not allowed, %s\n", kPaths);
  else
    std::printf("%s, %s, the first is %s\n", count_text().c_str(), kPaths,
                frames_.step(found_.front()).c_str());
  if (unseen_ > 0)
    std::printf(
        "%s that neither of its frames shows, %s\n",
        (counted(unseen_, "step") + (unseen_ == 1 ? " has" : " have") + " a contact").c_str(),
        kPaths);
  if (starting_ > 0)
    std::printf(
        "%s in contact, %s; in them %s apart at both frames\n",
        (counted(starting_, "step") + (starting_ == 1 ? " starts" : " start")).c_str(), kPaths,
        (counted(passing_, "pair") + " of elements " + (passing_ == 1 ? "meets" : "meet")).c_str());
  if (const auto& motion = checker.largest_motion())
    std::printf("largest motion in a step, %s: %s edge lengths (%s, %s)\n", kPaths,
                fmt::format("{:.3g}", motion->edges).c_str(), name(motion->body).c_str(),
                frames_.step(motion->step).c_str());
  // Below, it is rounding that turns a triangle.
  constexpr double kLeastTurn = 1e-3;
  if (const auto& turn = checker.largest_turn(); turn && turn->degrees >= kLeastTurn)
    std::printf("largest turn of a triangle in a step, %s: %s degrees (triangle %u of %s, %s)\n",
                kPaths, fmt::format("{:.3g}", turn->degrees).c_str(), turn->triangle,
                name(turn->body).c_str(), frames_.step(turn->step).c_str());
  else if (checker.largest_motion())
    std::printf("largest turn of a triangle in a step, %s: less than 0.001 degrees\n", kPaths);
  if (!checker.largest_motion()) std::printf("nothing moves from frame to frame\n");
  std::printf("%s, whose boxes meet in a step, tested exactly, %s\n",
              counted(checker.element_tests(), "pair of elements", "pairs of elements").c_str(),
              kPaths);
}

Json StepReport::end_json(const judge::StepChecker& checker) const {
  Json motion = nullptr, turn = nullptr;
  if (const auto& largest = checker.largest_motion())
    motion = {{"edges", largest->edges}, {"step", largest->step}, {"body", name(largest->body)}};
  if (const auto& largest = checker.largest_turn())
    turn = {{"degrees", largest->degrees},
            {"step", largest->step},
            {"body", name(largest->body)},
            {"triangle", largest->triangle}};
  return {{"paths", kPaths},
          {"steps", scene_.frames - 1},
          {"with_impacts", found_.size()},
          {"allowed", allowed_.impact},
          {"first", found_.empty() ? Json(nullptr) : Json(found_.front())},
          {"unseen", unseen_},
          {"starting", starting_},
          {"element_tests", checker.element_tests()},
          {"largest_motion", std::move(motion)},
          {"largest_turn", std::move(turn)}};
}

std::string StepReport::count_text() const {
  return std::to_string(found_.size()) + " of " + counted(scene_.frames - 1, "step") +
         (found_.size() == 1 ? " has" : " have") + " a contact" +
         (allowed_.impact ? ", which is allowed" : " that is not allowed");
}

std::string StepReport::elements_text(const judge::ElementImpact& impact, bool own) const {
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

std::string StepReport::first_text(const StepContact& c) const {
  const judge::ElementImpact& first = *c.first;
  return "at " + fmt::format("{:.6g}", first.earliest) + " of the step, " +
         elements_text(first, c.own()) + " at " + place_text(first);
}

std::string StepReport::sentence(std::size_t step, const StepContact& c) const {
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

Json StepReport::elements_json(const judge::ElementImpact& impact) const {
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

Json StepReport::json_of(std::size_t step, const std::vector<StepContact>& contacts) const {
  Json list = Json::array();
  for (const StepContact& c : contacts) {
    Json first = nullptr;
    if (c.first)
      first = {{"time", {{"lower", c.first->earliest}, {"upper", c.first->latest}}},
               {"elements", elements_json(*c.first)},
               {"place", {c.first->place.x(), c.first->place.y(), c.first->place.z()}},
               {"place_error", c.first->place_error}};
    Json one = {{"bodies", {name(c.bodies.a), name(c.bodies.b)}},
                {"start", words_of(c.start)},
                {"end", words_of(c.end)},
                {"allowed", allowed_.in_step(c) || allowed_.impact}};
    one["first"] = std::move(first);
    one["later_pairs"] = c.later;
    one["passing_pairs"] = c.passing;
    list.push_back(std::move(one));
  }
  return {{"event", "step"},
          {"step", step},
          {"files", {frames_.file(step), frames_.file(step + 1)}},
          {"paths", kPaths},
          {"contacts", std::move(list)}};
}

}  // namespace contactcheck::cli
