#include "reference/gate/timing_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "reference/gate/accuracy_rule.h"
#include "reference/text/file_text.h"

namespace contactcheck::gate {
namespace {

TimingVerdict beyond(const Slowness& slowness, const TimingTolerance& tolerance) {
  TimingVerdict out;
  out.excess_us = slowness.frame_us * (1.0 - 1.0 / slowness.ratio.value);
  const bool matters = out.excess_us >= tolerance.floor_us;
  out.verdict = matters ? Verdict::kFail : Verdict::kPass;
  out.reason = matters ? fmt::format("{:.4g} us too long per frame of {:.4g} us", out.excess_us,
                                     slowness.frame_us)
                       : fmt::format("beyond the limit by {:.4g} us per frame, less than {:.3g} us",
                                     out.excess_us, tolerance.floor_us);
  return out;
}

TimingVerdict of_range(const Slowness& slowness, const TimingTolerance& tolerance) {
  if (slowness.ratio.low > results::kRangeFactor) return beyond(slowness, tolerance);
  TimingVerdict out;
  // No excess can reach the floor in a frame that is shorter than it.
  if (slowness.frame_us < tolerance.floor_us) return out;
  if (slowness.ratio.high >= 1.0 / results::kRangeFactor) out.verdict = Verdict::kCannotJudge;
  return out;
}

}  // namespace

TimingVerdict judge_slowness(const Slowness& slowness, const TimingTolerance& tolerance) {
  const results::Ratio& r = slowness.ratio;
  if (slowness.passes < results::kFewestForInterval) return of_range(slowness, tolerance);
  if (r.low > 1.0) return beyond(slowness, tolerance);
  const bool wide = r.high > r.low * (1.0 + tolerance.noise_width);
  if (r.high <= 1.0 || !wide) return {};
  TimingVerdict out;
  out.verdict = Verdict::kTooNoisy;
  out.reason = fmt::format("the limit lies inside the 95 % interval, whose ends are {:.3g}x apart",
                           r.high / r.low);
  return out;
}

results::Ratio slowness_of(const results::Ratio& speedup, double limit) {
  return {limit / speedup.value, limit / speedup.high, limit / speedup.low};
}

results::Ratio over_limit(const results::Ratio& ratio, double limit) {
  return {ratio.value / limit, ratio.low / limit, ratio.high / limit};
}

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

std::optional<results::Ratio> ratio_in(const Rule& rule, const results::Run& row,
                                       std::string& reason) {
  const results::Speedup* const speedup = speedup_in(rule, row, reason);
  if (speedup == nullptr) return std::nullopt;
  const auto present = [&](const std::optional<results::Ratio>& part, const std::string& why_not) {
    if (!part) reason = why_not;
    return part;
  };
  if (rule.part == "cold")
    return present(speedup->cold, "no cold times: " + rule.question +
                                      " is not the own question of both detectors");
  if (rule.part == "without_map")
    return present(speedup->without_map, "one of the two maps lazily: no time without mapping");
  if (rule.part == "contact_frames")
    return present(speedup->contact_frames, "no frame with contact was timed");
  return speedup->playback;
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
  const results::PhaseTimes& playback = times->playback;
  std::optional<double> ms = playback.frame;
  if (rule.part == "without_map") ms = playback.update + playback.query;
  if (rule.part == "contact_frames") ms = playback.contact_frame;
  if (rule.part == "cold") ms = times->cold ? std::optional(times->cold->frame) : std::nullopt;
  return ms ? std::optional(kMicrosecondsPerMillisecond * *ms) : std::nullopt;
}

std::vector<std::size_t> cold_frames(const results::Index& results, const results::Run& row) {
  const results::Scene* const scene = results.scene(row.scene);
  return scene == nullptr ? std::vector<std::size_t>{} : scene->cold_frames;
}

// What the ratio is a mean over.
std::size_t frames_of(const Rule& rule, const results::Index& results, const results::Run& row) {
  if (rule.part == "cold") return cold_frames(results, row).size();
  const results::QuestionTimes* const times = times_of(rule, row);
  if (times == nullptr) return 0;
  return rule.part == "contact_frames" ? times->timed_contact_frames : times->timed_frames;
}

// Why a range does not decide, and what would. `passes`: "3 passes".
std::string too_few_passes(const std::string& passes, std::size_t frames,
                           const results::Ratio& range, const std::string& remedy) {
  const std::string ends = range.low == range.high
                               ? fmt::format("{:.3g}x", range.value)
                               : fmt::format("the range {:.3g}x to {:.3g}x", range.low, range.high);
  return fmt::format("{} {}, {}: the limit lies within a factor {} of {}; {}", frames,
                     frames == 1 ? "frame" : "frames", passes, results::kRangeFactor, ends, remedy);
}

std::string passes_text(std::size_t passes) {
  return passes == 1 ? "1 pass" : fmt::format("{} passes", passes);
}

std::string where_text(const Rule& rule) {
  return fmt::format("over {}, {}, {}", rule.reference, rule.question, rule.part);
}

// `too_few`: the reason where the passes are too few to decide.
Check judged(const Rule& rule, const Slowness& slowness, const std::string& measured,
             const std::string& too_few) {
  const TimingVerdict verdict = judge_slowness(slowness, {rule.floor_us, rule.noise_width});
  Check out;
  out.verdict = verdict.verdict;
  out.measured = measured;
  out.allowed = allowed_text(rule);
  out.reason = verdict.verdict == Verdict::kCannotJudge ? too_few : verdict.reason;
  return out;
}

Check no_frame_times(const Rule& rule) {
  return cannot_judge(rule, "no times per frame of the question " + rule.question);
}

// What fails on one side fails; what one side cannot tell is open, whatever the other says.
int weight(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFail:
      return 3;
    case Verdict::kTooNoisy:
      return 2;
    case Verdict::kCannotJudge:
      return 1;
    case Verdict::kPass:
      return 0;
  }
  return 0;
}

// Below the lower limit the detector is too slow, above the upper one the reference is.
Check judge_speedup(const Rule& rule, const results::Index& now, const results::Run& row) {
  std::string reason;
  const auto ratio = ratio_in(rule, row, reason);
  if (!ratio) return cannot_judge(rule, reason);
  const std::optional<double> us = frame_us(rule, row);
  if (!us) return no_frame_times(rule);
  const std::size_t passes = speedup_in(rule, row, reason)->passes;
  const std::string measured =
                        "speedup " + results::ratio_text(*ratio, passes) + " " + where_text(rule),
                    too_few = too_few_passes(passes_text(passes), frames_of(rule, now, row), *ratio,
                                             fmt::format("--processes {} gives an interval",
                                                         results::kFewestForInterval));
  std::optional<Check> out;
  if (rule.bound != Bound::kAtMost)
    out = judged(rule, {slowness_of(*ratio, rule.limit), *us, passes}, measured, too_few);
  if (rule.bound != Bound::kAtLeast) {
    const double limit = rule.bound == Bound::kAtMost ? rule.limit : rule.upper;
    Check upper =
        judged(rule, {over_limit(*ratio, limit), *us * ratio->value, passes}, measured, too_few);
    if (upper.verdict == Verdict::kFail) upper.reason = rule.reference + ": " + upper.reason;
    if (!out || weight(upper.verdict) > weight(out->verdict)) out = upper;
  }
  return *out;
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
  const results::QuestionTimes *times = times_of(rule, row), *old_times = times_of(rule, old);
  if (times != nullptr && old_times != nullptr) {
    if (times->timed_frames != old_times->timed_frames)
      return fmt::format("{} frames are timed here and {} in the baseline", times->timed_frames,
                         old_times->timed_frames);
    if (rule.part == "cold" && cold_frames(now, row) != cold_frames(before, old))
      return "other frames are timed cold in the baseline";
  }
  std::string ignored;
  return speedup_in(rule, row, ignored)->reference_options ==
                 speedup_in(rule, old, ignored)->reference_options
             ? ""
             : "the reference has other options in the baseline";
}

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
  if (!(ratio->low > 0.0) || !(known->low > 0.0))
    return cannot_judge(rule, "a speed-up of 0 has no logarithm");
  const std::size_t here = speedup_in(rule, row, reason)->passes,
                    there = speedup_in(rule, *old, reason)->passes, passes = std::min(here, there);
  const results::Ratio slow = results::quotient(*known, *ratio, passes);
  const char* const too_few = there >= results::kFewestForInterval  ? ""
                              : here >= results::kFewestForInterval ? " in the baseline"
                                                                    : " here and in the baseline";
  const std::optional<double> us = frame_us(rule, row);
  if (!us) return no_frame_times(rule);
  return judged(
      rule, {over_limit(slow, rule.limit), *us, passes},
      fmt::format("slowdown {} (speed-up {:.4g}x, in the baseline {:.4g}x, {})",
                  results::ratio_text(slow, passes), ratio->value, known->value, where_text(rule)),
      too_few_passes(
          fmt::format("{}, {} in the baseline", passes_text(here), there),
          frames_of(rule, now, row), slow,
          fmt::format("--processes {}{} gives an interval", results::kFewestForInterval, too_few)));
}

// "cpu is A here and B in the baseline", where it differs.
std::string difference(const std::string& what, const std::string& here, const std::string& there) {
  if (here == there) return "";
  return "another machine or build: " + what + " is " + here + " here and " + there +
         " in the baseline";
}

std::string version_of(const results::Results& results, const std::string& library) {
  for (const auto& [name, version] : results.libraries)
    if (name == library) return text::in_quotes(version);
  return "null";
}

}  // namespace

std::string other_machine(const results::Results& now, const results::Results& before) {
  const results::Machine &here = now.machine, &there = before.machine;
  std::vector<std::string> found = {
      difference("cpu", text::in_quotes(here.cpu), text::in_quotes(there.cpu)),
      difference("cores", std::to_string(here.cores), std::to_string(there.cores)),
      difference("isa", text::in_quotes(here.isa), text::in_quotes(there.isa)),
      difference("compiler", text::in_quotes(here.compiler), text::in_quotes(there.compiler)),
      difference("build", text::in_quotes(here.build), text::in_quotes(there.build))};
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
  return rule.measure->kind == MeasureKind::kSpeedup ? judge_speedup(rule, now, row)
                                                     : judge_slowdown(rule, now, before, row);
}

}  // namespace contactcheck::gate
