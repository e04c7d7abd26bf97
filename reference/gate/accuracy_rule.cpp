#include "reference/gate/accuracy_rule.h"

#include <nlohmann/json.hpp>

#include "reference/gate/reading.h"
#include "reference/scene/json_value.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

Check checked(const Rule& rule, bool holds, const std::string& measured) {
  Check out;
  out.verdict = holds ? Verdict::kPass : Verdict::kFail;
  out.measured = measured;
  out.allowed = allowed_text(rule);
  return out;
}

Check judge_status(const Rule& rule, const Json& row) {
  const auto status = row.at("status").get<std::string>();
  Check out = checked(rule, status == "ok", "status " + status);
  out.reason = row.at("message").get<std::string>();
  return out;
}

// Whose change it is: the scene's, the machine's mathematical library's, or the detector's.
std::string why_hash_changed(const Json& row, const Json& old, const Json* scene,
                             const Json* old_scene) {
  if (row.at("frames") != old.at("frames"))
    return "the run has " + row.at("frames").dump() + " frames, the baseline " +
           old.at("frames").dump();
  if (scene == nullptr || old_scene == nullptr) return "";
  if (scene->at("truth_hash") != old_scene->at("truth_hash"))
    return "the truth changed as well: another scene, another motion or another oracle";
  return "the truth is as it was: the detector's answer changed";
}

Check hash_against_baseline(const Rule& rule, const RowIndex& now, const RowIndex* before,
                            const Json& row) {
  std::string reason;
  const Json* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  const std::string hash = text_at(row, "contact_hash"), known = text_at(*old, "contact_hash");
  Check out = checked(rule, hash == known, "contact_hash " + hash);
  out.allowed = known + ", that of the baseline";
  const std::string scene = text_at(row, "scene");
  if (hash != known)
    out.reason = why_hash_changed(row, *old, now.scene(scene), before->scene(scene));
  return out;
}

Check hash_against_truth(const Rule& rule, const RowIndex& now, const Json& row) {
  const Json* const scene = now.scene(text_at(row, "scene"));
  if (scene == nullptr) return cannot_judge(rule, "the results do not describe the scene");
  const std::string hash = text_at(row, "contact_hash"), truth = text_at(*scene, "truth_hash");
  Check out = checked(rule, hash == truth, "contact_hash " + hash);
  out.allowed = truth + ", that of the truth";
  return out;
}

bool within(const Rule& rule, double value) {
  return rule.bound == Bound::kAtMost ? value <= rule.limit : value >= rule.limit;
}

Check number_against_baseline(const Rule& rule, const RowIndex* before, const Json& row,
                              const Reading& reading) {
  std::string reason;
  const Json* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  Rule same_level = rule;
  same_level.level = reading.level;
  const Reading known = read_measure(same_level, *before, *old);
  if (!known.value) return cannot_judge(rule, "in the baseline: " + known.why_not);
  Check out = checked(rule, *reading.value == *known.value, measured_text(rule, reading));
  out.allowed = shown(*known.value) + ", that of the baseline";
  return out;
}

}  // namespace

Check cannot_judge(const Rule& rule, const std::string& reason) {
  Check out;
  out.verdict = Verdict::kCannotJudge;
  out.allowed = allowed_text(rule);
  out.reason = reason;
  return out;
}

const Json* row_before(const RowIndex* before, const Json& row, std::string& reason) {
  if (before == nullptr) {
    reason = "no baseline is given";
    return nullptr;
  }
  const Json* const old = before->row(text_at(row, "scene"), text_at(row, "detector"));
  if (old == nullptr) {
    reason = "the baseline has no such row";
  } else if (old->at("status") != "ok") {
    reason = "in the baseline its status is " + text_at(*old, "status");
  }
  return reason.empty() ? old : nullptr;
}

Check judge_accuracy(const Rule& rule, const RowIndex& now, const RowIndex* before,
                     const Json& row) {
  if (rule.measure->kind == MeasureKind::kStatus) return judge_status(rule, row);
  if (rule.measure->kind == MeasureKind::kHash)
    return rule.bound == Bound::kEquals ? hash_against_truth(rule, now, row)
                                        : hash_against_baseline(rule, now, before, row);
  const Reading reading = read_measure(rule, now, row);
  if (!reading.value) return cannot_judge(rule, reading.why_not);
  if (rule.bound == Bound::kUnchanged) return number_against_baseline(rule, before, row, reading);
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

Check judge_oracle(const Rule& rule, const Json& scene) {
  const Reading reading = read_oracle_wrong(scene);
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

}  // namespace contactcheck
