#include "reference/gate/timing_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "reference/gate/accuracy_rule.h"
#include "reference/gate/timing_rule.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

constexpr double kMicrosecondsPerMillisecond = 1e3;

// Null where the row has no such speed-up; `reason` says why then.
const Json* speedup_in(const Rule& rule, const Json& row, std::string& reason) {
  const Json& times = row.at("time_ms");
  if (!times.contains("question") || !row.contains("speedup")) {
    reason = "the run was not timed";
    return nullptr;
  }
  const Json& all = row.at("speedup");
  if (!all.contains(rule.question) || !all.at(rule.question).contains(rule.reference)) {
    reason = "no speed-up over " + rule.reference + " in the question " + rule.question;
    return nullptr;
  }
  return &all.at(rule.question).at(rule.reference);
}

std::optional<Ratio> ratio_in(const Rule& rule, const Json& row, std::string& reason) {
  const Json* const speedup = speedup_in(rule, row, reason);
  if (speedup == nullptr) return std::nullopt;
  const Json& part = speedup->at(rule.part);
  if (part.is_null()) {
    reason = rule.part == "without_map" ? "one of the two maps lazily: no time without mapping"
                                        : "no frame with contact was timed";
    return std::nullopt;
  }
  return Ratio{part.at("ratio").get<double>(), part.at("low").get<double>(),
               part.at("high").get<double>()};
}

// The question's times: the row's own, or among those of its other questions.
const Json* times_of(const Rule& rule, const Json& row) {
  if (row.at("time_ms").at("question") == rule.question) return &row.at("time_ms");
  if (row.contains("time_ms_other_questions"))
    for (const Json& times : row.at("time_ms_other_questions"))
      if (times.at("question") == rule.question) return &times;
  return nullptr;
}

// The detector's own time per frame. The reference's follows: it is the ratio times as long, over
// the very frames that the ratio is about.
std::optional<double> frame_us(const Rule& rule, const Json& row) {
  const Json* const times = times_of(rule, row);
  if (times == nullptr) return std::nullopt;
  const Json& phases = times->at(rule.part == "hot" ? "hot" : "cold");
  if (rule.part == "without_map")
    return kMicrosecondsPerMillisecond *
           (phases.at("update").get<double>() + phases.at("query").get<double>());
  const Json& ms = phases.at(rule.part == "contact_frames" ? "contact_frame" : "frame");
  if (ms.is_null()) return std::nullopt;
  return kMicrosecondsPerMillisecond * ms.get<double>();
}

std::string interval_text(const Ratio& r) {
  return fmt::format("{:.4g}x [{:.4g}, {:.4g}]", r.value, r.low, r.high);
}

std::string where_text(const Rule& rule) {
  return fmt::format("over {}, {}, {}", rule.reference, rule.question, rule.part);
}

Check judged(const Rule& rule, const Ratio& slowness, const std::string& measured,
             const Json& row) {
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

Check judge_speedup(const Rule& rule, const Json& row) {
  std::string reason;
  const auto ratio = ratio_in(rule, row, reason);
  if (!ratio) return cannot_judge(rule, reason);
  return judged(rule, slowness_of(*ratio, rule.limit),
                "speedup " + interval_text(*ratio) + " " + where_text(rule), row);
}

// Of the reference, in the question; nothing where the results have no times of it.
std::optional<std::size_t> timed_frames_of_reference(const Rule& rule, const RowIndex& results,
                                                     const Json& row) {
  const Json* const reference = results.row(row.at("scene").get<std::string>(), rule.reference);
  if (reference == nullptr || !reference->contains("time_ms")) return std::nullopt;
  if (!reference->at("time_ms").contains("question")) return std::nullopt;
  const Json* const times = times_of(rule, *reference);
  if (times == nullptr) return std::nullopt;
  return times->at("timed_frames").get<std::size_t>();
}

// A ratio is over the frames that both sides were timed on: where the reference had time for fewer,
// it is another ratio.
std::string other_timed_frames(const Rule& rule, const RowIndex& now, const RowIndex& before,
                               const Json& row, const Json& old) {
  const Json *times = times_of(rule, row), *old_times = times_of(rule, old);
  if (times == nullptr || old_times == nullptr) return "";
  const auto timed = times->at("timed_frames").get<std::size_t>(),
             timed_then = old_times->at("timed_frames").get<std::size_t>();
  if (timed != timed_then)
    return fmt::format("{} frames are timed here and {} in the baseline", timed, timed_then);
  const auto here = timed_frames_of_reference(rule, now, row),
             there = timed_frames_of_reference(rule, before, old);
  if (!here || !there || std::min(*here, timed) == std::min(*there, timed)) return "";
  return fmt::format("{} frames of {} are timed here and {} in the baseline", *here, rule.reference,
                     *there);
}

// Not the same frames or not the same reference: another ratio.
std::string other_measurement(const Rule& rule, const RowIndex& now, const RowIndex& before,
                              const Json& row, const Json& old) {
  for (const char* key : {"frames", "contact_frames"})
    if (row.at(key) != old.at(key))
      return fmt::format("{} is {} here and {} in the baseline", key, row.at(key).dump(),
                         old.at(key).dump());
  const std::string found = other_timed_frames(rule, now, before, row, old);
  if (!found.empty()) return found;
  std::string ignored;
  const Json* const speedup = speedup_in(rule, row, ignored);
  const Json* const speedup_then = speedup_in(rule, old, ignored);
  return speedup->at("reference_options") == speedup_then->at("reference_options")
             ? ""
             : "the reference has other options in the baseline";
}

bool is_above_zero(const Ratio& r) { return r.low > 0.0; }

Check judge_slowdown(const Rule& rule, const RowIndex& now, const RowIndex* before,
                     const Json& row) {
  std::string reason;
  const Json* const old = row_before(before, row, reason);
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

// "cpu is A here and B in the baseline" for the first member that differs.
std::string difference(const Json& now, const Json& before, const std::string& kind,
                       const std::string& key) {
  const Json here = now.value(key, Json()), there = before.value(key, Json());
  if (here == there) return "";
  return "another machine or build: " + kind + key + " is " + here.dump() + " here and " +
         there.dump() + " in the baseline";
}

}  // namespace

std::string other_machine(const Json& now, const Json& before) {
  for (const char* key : {"cpu", "cores", "isa", "compiler", "build"}) {
    const std::string found = difference(now.at("machine"), before.at("machine"), "", key);
    if (!found.empty()) return found;
  }
  for (const auto* results : {&now, &before})
    for (const auto& [library, version] : results->at("libraries").items()) {
      const std::string found =
          difference(now.at("libraries"), before.at("libraries"), "library ", library);
      if (!found.empty()) return found;
    }
  return "";
}

Check judge_timing(const Rule& rule, const RowIndex& now, const RowIndex* before, const Json& row) {
  return rule.measure->kind == MeasureKind::kSpeedup ? judge_speedup(rule, row)
                                                     : judge_slowdown(rule, now, before, row);
}

}  // namespace contactcheck
