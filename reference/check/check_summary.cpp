#include "reference/check/check_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "reference/text/counted.h"

namespace contactcheck::check {

using text::counted;

namespace {

bool apart_at_both(const Json& contact) {
  return contact.at("start") == "apart" && contact.at("end") == "apart";
}

bool starts_in_contact(const Json& contact) { return contact.at("start") == "in contact"; }

}  // namespace

void CheckSummary::add(CheckedFrame frame) {
  open_ = frame.open;
  totals_ = frame.totals;
  if (!frame.here.empty()) add_contacts(frame);
  if (!frame.step.empty()) add_step(frame);
  if (!frame.here.empty() || !frame.step.empty()) listed_.push_back(std::move(frame));
}

void CheckSummary::add_contacts(const CheckedFrame& frame) {
  ++bad_frames_;
  if (!first_frame_) first_frame_ = frame.frame;
  const Json& contacts = frame.here.event.at("contacts");
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Json& depth = contacts[i].at("depth");
    if (depth.is_null()) {
      unknown_depth_ = true;
    } else if (const double upper = depth.at("upper").get<double>();
               depth.at("lower").get<double>() > 0.0 && upper > depth_) {
      depth_ = upper;
      deepest_ = frame.frame;
      deepest_words_ = frame.here.words[i];
    }
  }
}

void CheckSummary::add_step(const CheckedFrame& frame) {
  const Json& contacts = frame.step.event.at("contacts");
  starting_ += std::ranges::any_of(contacts, starts_in_contact);
  for (const Json& c : contacts)
    if (starts_in_contact(c)) passing_ += c.at("passing_pairs").get<std::size_t>();
  unseen_ += std::ranges::any_of(contacts, apart_at_both);
  if (!frame.found_in_step()) return;
  ++found_steps_;
  if (!first_step_) first_step_ = frame.frame - 1;
}

const CheckedFrame* CheckSummary::first_bad() const {
  const std::optional<std::size_t> frame = first_frame_  ? first_frame_
                                           : bad_steps() ? std::optional(*first_step_ + 1)
                                                         : std::nullopt;
  const auto found = std::ranges::find_if(
      listed_, [&](const CheckedFrame& listed) { return listed.frame == frame; });
  return frame && found != listed_.end() ? &*found : nullptr;
}

std::string CheckSummary::frames_text() const {
  return std::to_string(bad_frames_) + " of " + counted(scene_.frames, "frame") +
         (bad_frames_ == 1 ? " has" : " have") + " a contact that is not allowed";
}

std::string CheckSummary::steps_text() const {
  return std::to_string(found_steps_) + " of " + counted(scene_.frames - 1, "step") +
         (found_steps_ == 1 ? " has" : " have") + " a contact" +
         (allowed_.impact ? ", which is allowed" : " that is not allowed");
}

std::string CheckSummary::deepest_text() const {
  return words_.place(*deepest_) + ", " + deepest_words_;
}

std::string CheckSummary::motion_text() const {
  const judge::LargestMotion& motion = *totals_.motion;
  return fmt::format("{:.3g}", motion.edges) + " edge lengths (" + words_.name(motion.body) + ", " +
         words_.places(motion.step) + ")";
}

std::string CheckSummary::title() const {
  if (!between_)
    return bad_frames_ > 0 ? frames_text() : "No frame has a contact that is not allowed";
  if (!bad_steps() && bad_frames_ == 0)
    return "No frame and no step has a contact that is not allowed";
  if (!bad_steps()) return frames_text() + ", no step";
  return (bad_frames_ > 0 ? frames_text() + ", and " : "") + steps_text() + ", " + kPaths;
}

std::vector<report::HeadlineFinding> CheckSummary::findings() const {
  std::vector<report::HeadlineFinding> out;
  if (const CheckedFrame* first = first_bad()) {
    if (first_frame_)
      out.push_back({"First", words_.place(*first_frame_) + ", " + first->here.words.front()});
    else
      out.push_back(
          {"First",
           words_.places(*first_step_) + ", " +
               first->step.words[static_cast<std::size_t>(
                   std::ranges::find(first->step.found, true) - first->step.found.begin())]});
  }
  if (deepest_)
    out.push_back({unknown_depth_ ? "Deepest of known depth" : "Deepest", deepest_text()});
  for (const auto& [body, why] : open_)
    out.push_back({"Not judged", words_.name(body) + ": containment and depth in it, " + why});
  if (between_ && totals_.motion) out.push_back({"Largest motion in a step", motion_text()});
  return out;
}

std::string CheckSummary::text() const {
  std::string out;
  if (bad_frames_ > kMostShown)
    out += "\n... and " + counted(bad_frames_ - kMostShown, "more frame") + "\n";
  if (bad_frames_ == 0)
    out +=
        std::string(found_steps_ > 0 ? "\n" : "") + "no frame has a contact that is not allowed\n";
  for (const auto& [body, why] : open_)
    out += words_.name(body) + ": containment and depth in it not judged: " + why + "\n";
  if (bad_frames_ > 0)
    out += "\n" + frames_text() + ", the first is " + words_.place(*first_frame_) + "\n";
  if (deepest_)
    out += (unknown_depth_ ? "deepest of known depth: " : "deepest: ") + deepest_text() + "\n";
  return between_ ? out + steps_lines() : out;
}

std::string CheckSummary::steps_lines() const {
  const std::string end = std::string(", ") + kPaths + "\n";
  std::string out;
  if (found_steps_ > kMostShown)
    out += "\n... and " + counted(found_steps_ - kMostShown, "more step") + "\n";
  if (found_steps_ == 0)
    out += "no step has a contact that is not allowed" + end;
  else
    out += steps_text() + ", " + kPaths + ", the first is " + words_.places(*first_step_) + "\n";
  if (unseen_ > 0)
    out += counted(unseen_, "step") + (unseen_ == 1 ? " has" : " have") +
           " a contact that neither of its frames shows" + end;
  if (starting_ > 0)
    out += counted(starting_, "step") + (starting_ == 1 ? " starts" : " start") + " in contact, " +
           kPaths + "; in them " + counted(passing_, "pair") + " of elements " +
           (passing_ == 1 ? "meets" : "meet") + " apart at both frames\n";
  // Below, it is rounding that turns a triangle.
  constexpr double kLeastTurn = 1e-3;
  if (!totals_.motion) {
    out += "nothing moves from frame to frame\n";
  } else {
    const std::string turn = std::string("largest turn of a triangle in a step, ") + kPaths + ": ";
    out += std::string("largest motion in a step, ") + kPaths + ": " + motion_text() + "\n" + turn;
    out += totals_.turn && totals_.turn->degrees >= kLeastTurn
               ? fmt::format("{:.3g} degrees (triangle {} of {}, {})\n", totals_.turn->degrees,
                             totals_.turn->triangle, words_.name(totals_.turn->body),
                             words_.places(totals_.turn->step))
               : "less than 0.001 degrees\n";
  }
  return out + counted(totals_.element_tests, "pair of elements", "pairs of elements") +
         ", whose boxes meet in a step, tested exactly" + end;
}

Json CheckSummary::event() const {
  Json not_judged = Json::array();
  for (const auto& [body, why] : open_)
    not_judged.push_back({{"body", words_.name(body)}, {"level", "containment"}, {"reason", why}});
  Json out = {{"bad_frames", bad_frames_},
              {"first", first_frame_ ? Json(*first_frame_) : Json(nullptr)},
              {"not_judged", std::move(not_judged)}};
  if (between_) out["between"] = between_json();
  return out;
}

Json CheckSummary::between_json() const {
  Json motion = nullptr, turn = nullptr;
  if (const auto& largest = totals_.motion)
    motion = {
        {"edges", largest->edges}, {"step", largest->step}, {"body", words_.name(largest->body)}};
  if (const auto& largest = totals_.turn)
    turn = {{"degrees", largest->degrees},
            {"step", largest->step},
            {"body", words_.name(largest->body)},
            {"triangle", largest->triangle}};
  return {{"paths", kPaths},
          {"steps", scene_.frames - 1},
          {"with_impacts", found_steps_},
          {"allowed", allowed_.impact},
          {"first", first_step_ ? Json(*first_step_) : Json(nullptr)},
          {"unseen", unseen_},
          {"starting", starting_},
          {"element_tests", totals_.element_tests},
          {"largest_motion", std::move(motion)},
          {"largest_turn", std::move(turn)}};
}

}  // namespace contactcheck::check
