#include "reference/report/phase_times.h"

#include <algorithm>

#include "reference/report/format.h"

namespace contactcheck::report {
namespace {

// None where no run was timed.
std::optional<PhaseMeans> means_of(const std::string& detector,
                                   const std::vector<const results::Run*>& runs, bool cold) {
  PhaseMeans out;
  out.detector = detector;
  for (const results::Run* run : runs) {
    if (run->times.empty()) continue;
    const results::QuestionTimes& times = run->times.front();
    const results::PhaseTimes* phases = phases_of(times, cold);
    if (phases == nullptr) continue;
    if (out.scenes++ == 0) out.question = times.question;
    if (phases->map) out.map = out.map.value_or(0.0) + *phases->map;
    out.update += phases->update;
    out.query += phases->query;
    out.timed.add(*run, times);
  }
  if (out.scenes == 0) return {};
  const auto scenes = static_cast<double>(out.scenes);
  if (out.map) *out.map /= scenes;
  out.update /= scenes;
  out.query /= scenes;
  return out;
}

}  // namespace

std::vector<PhaseMeans> phase_times(const results::Index& index, const SceneChoice& scenes,
                                    bool cold) {
  std::vector<PhaseMeans> all;
  for (const std::string& detector : index.detectors())
    if (auto means = means_of(detector, ok_runs(index, detector, scenes), cold))
      all.push_back(std::move(*means));
  std::stable_sort(all.begin(), all.end(),
                   [](const PhaseMeans& a, const PhaseMeans& b) { return a.total() < b.total(); });
  return all;
}

TitledTable phase_times_table(const std::vector<PhaseMeans>& all) {
  TitledTable out{"Milliseconds per frame and phase",
                  "",
                  {{"detector", true, ""},
                   {"question", true, ""},
                   {"scenes", false, ""},
                   {"map", false, ""},
                   {"update", false, ""},
                   {"query", false, ""},
                   {"sum", false, ""},
                   {"passes", false, ""}},
                  {}};
  for (const PhaseMeans& own : all)
    out.rows.push_back({own.detector, name_of(own.question), std::to_string(own.scenes),
                        format_number(own.map), format_number(own.update), format_number(own.query),
                        format_number(own.total()) + own.timed.cut_text(),
                        format_counts(own.timed.passes)});
  return out;
}

}  // namespace contactcheck::report
