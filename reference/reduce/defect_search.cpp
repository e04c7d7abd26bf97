#include "reference/reduce/defect_search.h"

#include <algorithm>
#include <optional>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// Where it is not known yet what is wrong.
std::vector<Level> levels_of(const ReductionTask& task) {
  if (!task.level.empty()) return levels_for(task.level);
  return {Level::kBody, Level::kCell, Level::kBox, Level::kTriangle, Level::kNear};
}

Snapshot two_of(const Snapshot& all, std::size_t a, std::size_t b) {
  return {{all.bodies[a], all.bodies[b]}, {all.nodes[a], all.nodes[b]}};
}

Defect with_position(Defect defect) {
  if (names_triangles(defect.finding) && defect.task.pair)
    defect.finding.general =
        in_general_position(candidate_of(defect.task.snapshot), *defect.task.pair);
  return defect;
}

}  // namespace

std::string where(const ReductionTask& task) { return task.scene + ", " + task.place; }

std::vector<Level> levels_for(const std::string& level_name) {
  std::vector<Level> levels = {Level::kBody};
  const Level level = level_from_name(level_name).value_or(Level::kTriangle);
  if (level != Level::kBody) levels.push_back(level);
  return levels;
}

// Parts of a solid are no solids, and only these have an inside.
void require_reducible(const std::string& level) {
  for (const Level solid : {Level::kVertex, Level::kContainment})
    if (level == name_of(solid))
      throw InputError("a disagreement at level " + level +
                       " cannot be reduced: inside is defined for closed surfaces, and a part of "
                       "one is open");
}

Defect DefectSearch::find(const std::vector<ReductionTask>& tasks) {
  for (const ReductionTask& task : tasks) {
    if (task.snapshot.bodies.size() < 2) continue;
    const ProbeVerdict verdict = probe_.ask(task.snapshot, levels_of(task));
    const std::optional<Finding> finding = finding_of(verdict, task.level, task.kind);
    if (finding) return defect_of(task, verdict, *finding);
    last_ = verdict;
  }
  refuse_without_finding(tasks);
}

Defect DefectSearch::defect_of(const ReductionTask& task, const ProbeVerdict& verdict,
                               const Finding& finding) {
  require_reducible(finding.level);
  Defect defect{task, finding};
  if (is_case_) return with_position(std::move(defect));
  if (finding.kind == "error") {
    defect.task.snapshot = bodies_of_error(task, finding);
    return defect;
  }
  const Disagreement& shown = disagreement_of(verdict, finding);
  const auto [a, b] = std::minmax(shown.pair.body_a, shown.pair.body_b);
  defect.task.snapshot = two_of(task.snapshot, a, b);
  defect.task.pair = triangles_of(shown, task.snapshot);
  defect.task.cells = cells_of(shown);
  return with_two_bodies(with_position(std::move(defect)));
}

Snapshot DefectSearch::bodies_of_error(const ReductionTask& task, const Finding& finding) {
  const std::size_t count = task.snapshot.bodies.size();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      Snapshot two = two_of(task.snapshot, a, b);
      if (shows(probe_.ask(two, levels_for(finding.level)), finding)) return two;
    }
  refuse_more_bodies(task, finding);
}

// Of more than two bodies the others may have had a part in it.
Defect DefectSearch::with_two_bodies(const Defect& defect) {
  if (!shows(probe_.ask(defect.task.snapshot, levels_for(defect.finding.level)), defect.finding))
    refuse_more_bodies(defect.task, defect.finding);
  return defect;
}

void DefectSearch::refuse_more_bodies(const ReductionTask& task, const Finding& finding) const {
  throw InputError(where(task) + ", " + detector_ + ": " + described(finding) +
                   " needs more than two of its bodies, and a minimal case has two");
}

void DefectSearch::refuse_without_finding(const std::vector<ReductionTask>& tasks) const {
  const ReductionTask& task = tasks.front();
  const std::string place = tasks.size() == 1 ? where(task) : task.scene + ", every frame";
  const std::string wanted = (task.kind.empty() ? "wrong" : task.kind) +
                             (task.level.empty() ? "" : " at level " + task.level);
  if (last_.status != results::Status::kOk)
    throw InputError(place + ": nothing is " + wanted + ": the answer of " + detector_ + " is \"" +
                     name_of(last_.status) + "\": " + last_.message);
  throw InputError(place + ": nothing is " + wanted + (is_case_ ? " any more" : "") +
                   " in the answer of " + detector_ + why_not_judged(task.level));
}

std::string DefectSearch::why_not_judged(const std::string& level) const {
  for (const auto& [judged, why] : last_.not_judged)
    if (level == name_of(judged)) return ": " + why;
  return "";
}

}  // namespace contactcheck
