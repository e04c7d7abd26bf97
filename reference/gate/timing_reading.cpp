#include "reference/gate/timing_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "reference/gate/accuracy_rule.h"
#include "reference/gate/timing_rule.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {

constexpr double kMicrosecondsPerMillisecond = 1e3;

// Null where the row has no such speed-up; `reason` says why then.
const results::Speedup* speedup_in(const Rule& rule, const results::Run& row, std::string& reason) {
  if (row.times.empty()) {
    reason = "the run was not timed";
    return nullptr;
  }
  for (const auto& [question, references] : row.speedup)
    if (name_of(question) == rule.question)
      if (const auto found = references.find(rule.reference); found != references.end())
        return &found->second;
  reason = "no speed-up over " + rule.reference + " in the question " + rule.question;
  return nullptr;
}

std::optional<Ratio> ratio_in(const Rule& rule, const results::Run& row, std::string& reason) {
  const results::Speedup* const speedup = speedup_in(rule, row, reason);
  if (speedup == nullptr) return std::nullopt;
  if (rule.part == "cold") return speedup->cold;
  if (rule.part == "hot") return speedup->hot;
  const bool unmapped = rule.part == "without_map";
  const std::optional<Ratio>& part = unmapped ? speedup->without_map : speedup->contact_frames;
  if (!part)
    reason = unmapped ? "one of the two maps lazily: no time without mapping"
                      : "no frame with contact was timed";
  return part;
}

// Null where the row has no times of the question.
const results::QuestionTimes* times_of(const Rule& rule, const results::Run& row) {
  for (const results::QuestionTimes& times : row.times)
    if (name_of(times.question) == rule.question) return &times;
  return nullptr;
}

// The detector's own time per frame. The reference's follows: it is the ratio times as long, over
// the very frames that the ratio is about.
std::optional<double> frame_us(const Rule& rule, const results::Run& row) {
  const results::QuestionTimes* const times = times_of(rule, row);
  if (times == nullptr) return std::nullopt;
  const results::PhaseTimes& phases = rule.part == "hot" ? times->hot : times->cold;
  if (rule.part == "without_map")
    return kMicrosecondsPerMillisecond * (phases.update + phases.query);
  if (rule.part != "contact_frames") return kMicrosecondsPerMillisecond * phases.frame;
  if (!phases.contact_frame) return std::nullopt;
  return kMicrosecondsPerMillisecond * *phases.contact_frame;
}

std::string interval_text(const Ratio& r) {
  return fmt::format("{:.4g}x [{:.4g}, {:.4g}]", r.value, r.low, r.high);
}

std::string where_text(const Rule& rule) {
  return fmt::format("over {}, {}, {}", rule.reference, rule.question, rule.part);
}

Check judged(const Rule& rule, const Ratio& slowness, const std::string& measured,
             const results::Run& row) {
  const std::optional<double> us = frame_us(rule, row);
  if (!us) return cannot_judge(rule, "no times per frame of the question " + rule.question);
  const TimingVerdict verdict = judge_slowness({slowness, *us}, {rule.floor_us, rule.noise_width});
  Check out;
  out.verdict = verdict.verdict;
  out.measured = measured;
  out.allowed = allowed_text(rule);
  out.reason = verdict.reason;
  return out;
}

Check judge_speedup(const Rule& rule, const results::Run& row) {
  std::string reason;
  const auto ratio = ratio_in(rule, row, reason);
  if (!ratio) return cannot_judge(rule, reason);
  return judged(rule, slowness_of(*ratio, rule.limit),
                "speedup " + interval_text(*ratio) + " " + where_text(rule), row);
}

// Of the reference, in the question; nothing where the results have no times of it.
std::optional<std::size_t> timed_frames_of_reference(const Rule& rule,
                                                     const results::Index& results,
                                                     const results::Run& row) {
  const results::Run* const reference = results.run(row.scene, rule.reference);
  const results::QuestionTimes* const times =
      reference == nullptr ? nullptr : times_of(rule, *reference);
  return times == nullptr ? std::nullopt : std::optional(times->timed_frames);
}

// A ratio is over the frames that both sides were timed on: where the reference had time for fewer,
// it is another ratio.
std::string other_timed_frames(const Rule& rule, const results::Index& now,
                               const results::Index& before, const results::Run& row,
                               const results::Run& old) {
  const results::QuestionTimes *times = times_of(rule, row), *old_times = times_of(rule, old);
  if (times == nullptr || old_times == nullptr) return "";
  const std::size_t timed = times->timed_frames, timed_then = old_times->timed_frames;
  if (timed != timed_then)
    return fmt::format("{} frames are timed here and {} in the baseline", timed, timed_then);
  const auto here = timed_frames_of_reference(rule, now, row),
             there = timed_frames_of_reference(rule, before, old);
  if (!here || !there || std::min(*here, timed) == std::min(*there, timed)) return "";
  return fmt::format("{} frames of {} are timed here and {} in the baseline", *here, rule.reference,
                     *there);
}

// Not the same frames or not the same reference: another ratio.
std::string other_measurement(const Rule& rule, const results::Index& now,
                              const results::Index& before, const results::Run& row,
                              const results::Run& old) {
  if (row.frames != old.frames)
    return fmt::format("frames is {} here and {} in the baseline", row.frames, old.frames);
  if (row.contact_frames != old.contact_frames)
    return fmt::format("contact_frames is {} here and {} in the baseline", row.contact_frames,
                       old.contact_frames);
  std::string found = other_timed_frames(rule, now, before, row, old);
  if (!found.empty()) return found;
  std::string ignored;
  return speedup_in(rule, row, ignored)->reference_options ==
                 speedup_in(rule, old, ignored)->reference_options
             ? ""
             : "the reference has other options in the baseline";
}

bool is_above_zero(const Ratio& r) { return r.low > 0.0; }

Check judge_slowdown(const Rule& rule, const results::Index& now, const results::Index* before,
                     const results::Run& row) {
  std::string reason;
  const results::Run* const old = row_before(*before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  reason = other_machine(now.results(), before->results());
  if (!reason.empty()) return cannot_judge(rule, reason);
  const auto ratio = ratio_in(rule, row, reason);
  if (!ratio) return cannot_judge(rule, reason);
  const auto known = ratio_in(rule, *old, reason);
  if (!known) return cannot_judge(rule, "in the baseline: " + reason);
  reason = other_measurement(rule, now, *before, row, *old);
  if (!reason.empty()) return cannot_judge(rule, reason);
  if (!is_above_zero(*ratio) || !is_above_zero(*known))
    return cannot_judge(rule, "a speed-up of 0 has no logarithm");
  const Ratio slow = quotient(*known, *ratio);
  return judged(rule, over_limit(slow, rule.limit),
                fmt::format("slowdown {} (speed-up {:.4g}x, in the baseline {:.4g}x, {})",
                            interval_text(slow), ratio->value, known->value, where_text(rule)),
                row);
}

// "cpu is A here and B in the baseline", where it differs.
std::string difference(const std::string& what, const std::string& here, const std::string& there) {
  if (here == there) return "";
  return "another machine or build: " + what + " is " + here + " here and " + there +
         " in the baseline";
}

std::string version_of(const results::Results& results, const std::string& library) {
  for (const auto& [name, version] : results.libraries)
    if (name == library) return in_quotes(version);
  return "null";
}

}  // namespace

std::string other_machine(const results::Results& now, const results::Results& before) {
  const results::Machine &here = now.machine, &there = before.machine;
  std::vector<std::string> found = {
      difference("cpu", in_quotes(here.cpu), in_quotes(there.cpu)),
      difference("cores", std::to_string(here.cores), std::to_string(there.cores)),
      difference("isa", in_quotes(here.isa), in_quotes(there.isa)),
      difference("compiler", in_quotes(here.compiler), in_quotes(there.compiler)),
      difference("build", in_quotes(here.build), in_quotes(there.build))};
  for (const auto* results : {&now, &before})
    for (const auto& [library, version] : results->libraries)
      found.push_back(
          difference("library " + library, version_of(now, library), version_of(before, library)));
  const auto first = std::find_if(found.begin(), found.end(),
                                  [](const std::string& text) { return !text.empty(); });
  return first == found.end() ? "" : *first;
}

Check judge_timing(const Rule& rule, const results::Index& now, const results::Index* before,
                   const results::Run& row) {
  return rule.measure->kind == MeasureKind::kSpeedup ? judge_speedup(rule, row)
                                                     : judge_slowdown(rule, now, before, row);
}

}  // namespace contactcheck
