#include "reference/defects/sightings.h"

#include <vector>

#include "core/types/check.h"

namespace contactcheck {
namespace {

using results::Run;

void add_answers(const results::Family& family, const Run& run, SightingsOfRun& out) {
  Sighting s{run.detector, run.scene, SightingKind::kMissed, kNoCase};
  const auto add = [&](SightingKind kind, const std::vector<std::uint64_t>& counts) {
    s.kind = kind;
    if (counts.size() > family.values.size())
      throw InputError("results of " + run.detector + " on " + run.scene + ": more frames than " +
                       "the family has cases");
    for (std::size_t frame = 0; frame < counts.size(); ++frame) {
      s.value = family.values[frame];
      out.possible.insert(s);
      if (counts[frame] != 0) out.seen.insert(s);
    }
  };
  add(SightingKind::kMissed, run.per_frame.missed);
  add(SightingKind::kSpurious, run.per_frame.spurious);
}

// It would have failed at an earlier case, were that one bad too; of the later ones nobody knows.
void add_errors(const std::vector<std::string>& values, const Run& run, SightingsOfRun& out) {
  const bool failed = run.status == results::Status::kError;
  // Behind the last case where none is known.
  const std::size_t failed_case = failed ? run.failed_frame.value_or(values.size()) : values.size();
  Sighting s{run.detector, run.scene, SightingKind::kError, kNoCase};
  out.possible.insert(s);  // with no case to blame
  for (std::size_t i = 0; i <= failed_case && i < values.size(); ++i) {
    s.value = values[i];
    out.possible.insert(s);
  }
  if (!failed) return;
  s.value = failed_case < values.size() ? values[failed_case] : kNoCase;
  out.seen.insert(s);
}

}  // namespace

const char* name_of(SightingKind kind) {
  switch (kind) {
    case SightingKind::kMissed:
      return "missed";
    case SightingKind::kSpurious:
      return "spurious";
    case SightingKind::kError:
      return "error";
  }
  return "";
}

SightingsOfRun sightings_of(const results::Results& results) {
  const results::Index index(results);
  SightingsOfRun out;
  for (const Run& run : results.runs) {
    const results::Scene* scene = index.scene(run.scene);
    if (scene == nullptr) throw InputError("results have no scene \"" + run.scene + "\"");
    if (!scene->unjudged.empty()) continue;  // no detector was asked
    if (run.ok() || run.status == results::Status::kError)
      add_errors(scene->family ? scene->family->values : std::vector<std::string>{}, run, out);
    if (run.ok() && scene->family && run.per_frame.level) add_answers(*scene->family, run, out);
  }
  return out;
}

}  // namespace contactcheck
