#include "reference/gate/accuracy_rule.h"

#include "reference/gate/reading.h"
#include "reference/text/json_value.h"

namespace contactcheck::gate {
namespace {

Check checked(const Rule& rule, bool holds, const std::string& measured) {
  Check out;
  out.verdict = holds ? Verdict::kPass : Verdict::kFail;
  out.measured = measured;
  out.allowed = allowed_text(rule);
  return out;
}

Check judge_status(const Rule& rule, const results::Run& row) {
  Check out = checked(rule, row.ok(), std::string("status ") + name_of(row.status));
  out.reason = row.message;
  return out;
}

// Whose change it is: the scene's, the machine's mathematical library's, or the detector's.
std::string why_hash_changed(const results::Run& row, const results::Run& old,
                             const results::Scene* scene, const results::Scene* old_scene) {
  if (row.frames != old.frames)
    return "the run has " + std::to_string(row.frames) + " frames, the baseline " +
           std::to_string(old.frames);
  if (scene == nullptr || old_scene == nullptr) return "";
  if (scene->truth_hash != old_scene->truth_hash)
    return "the truth changed as well: another scene, another motion or another oracle";
  return "the truth is as it was: the detector's answer changed";
}

Check hash_against_baseline(const Rule& rule, const results::Index& now,
                            const results::Index& before, const results::Run& row) {
  std::string reason;
  const results::Run* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  Check out =
      checked(rule, row.contact_hash == old->contact_hash, "contact_hash " + row.contact_hash);
  out.allowed = old->contact_hash + ", that of the baseline";
  if (row.contact_hash != old->contact_hash)
    out.reason = why_hash_changed(row, *old, now.scene(row.scene), before.scene(row.scene));
  return out;
}

Check hash_against_truth(const Rule& rule, const results::Index& now, const results::Run& row) {
  const results::Scene* const scene = now.scene(row.scene);
  if (scene == nullptr) return cannot_judge(rule, "the results do not describe the scene");
  Check out =
      checked(rule, row.contact_hash == scene->truth_hash, "contact_hash " + row.contact_hash);
  out.allowed = scene->truth_hash + ", that of the truth";
  return out;
}

bool within(const Rule& rule, double value) {
  return rule.bound == Bound::kAtMost ? value <= rule.limit : value >= rule.limit;
}

Check number_against_baseline(const Rule& rule, const results::Index& before,
                              const results::Run& row, const Reading& reading) {
  std::string reason;
  const results::Run* const old = row_before(before, row, reason);
  if (old == nullptr) return cannot_judge(rule, reason);
  Rule same_level = rule;
  same_level.level = reading.level ? name_of(*reading.level) : "";
  const Reading known = read_measure(same_level, before.results(), *old);
  if (!reading.value && !known.value) return cannot_judge(rule, reading.why_not);
  // What is there on one side alone has changed.
  Check out = checked(rule, reading.value == known.value, "");
  if (reading.value) out.measured = measured_text(rule, reading);
  out.allowed = (known.value ? text::shown(*known.value) : "none") + ", that of the baseline";
  if (!reading.value) out.reason = "was " + out.allowed + "; now " + reading.why_not;
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

const results::Run* row_before(const results::Index& before, const results::Run& row,
                               std::string& reason) {
  const results::Run* const old = before.run(row.scene, row.detector);
  if (old == nullptr) {
    reason = "the baseline has no such row";
  } else if (!old->ok()) {
    reason = std::string("in the baseline its status is ") + name_of(old->status);
  }
  return reason.empty() ? old : nullptr;
}

Check judge_accuracy(const Rule& rule, const results::Index& now, const results::Index* before,
                     const results::Run& row) {
  if (rule.measure->kind == MeasureKind::kStatus) return judge_status(rule, row);
  if (rule.measure->kind == MeasureKind::kHash)
    return rule.bound == Bound::kEquals ? hash_against_truth(rule, now, row)
                                        : hash_against_baseline(rule, now, *before, row);
  const Reading reading = read_measure(rule, now.results(), row);
  if (rule.bound == Bound::kUnchanged) return number_against_baseline(rule, *before, row, reading);
  if (!reading.value) return cannot_judge(rule, reading.why_not);
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

Check judge_oracle(const Rule& rule, const results::Scene& scene) {
  const Reading reading = read_oracle_wrong(scene);
  return checked(rule, within(rule, *reading.value), measured_text(rule, reading));
}

}  // namespace contactcheck::gate
