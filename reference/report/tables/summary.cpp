#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "reference/report/tables/format.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/section.h"
#include "reference/results/references.h"
#include "reference/text/lists.h"

namespace contactcheck::report {
namespace {
using results::LevelCounts;
using results::Run;

struct Sums {
  std::string detector;
  std::optional<Level> level;
  std::optional<Question> question;  ///< of the speed-ups; those of another one do not compare
  std::size_t scenes = 0;
  std::map<results::Status, std::size_t> not_ok;  ///< none is counted as `ok`
  std::optional<LevelCounts> counts, body;  ///< none: nothing judged, which is no perfect score
  std::optional<double> hover;
  std::array<Range, results::kReferences.size()> speedups;
  Range passes;  ///< of these
};

void add_counts(const LevelCounts* counts, std::optional<LevelCounts>& sum) {
  if (counts == nullptr) return;
  if (!sum) sum.emplace();
  *sum += *counts;
}

void add_run(const Run& run, Sums& sums) {
  if (!run.ok()) {
    ++sums.not_ok[run.status];
    return;
  }
  ++sums.scenes;
  if (!sums.question) sums.question = compared_question(run);
  add_counts(counts_of(run, sums.level), sums.counts);
  add_counts(counts_of(run, Level::kBody), sums.body);
  if (const auto hover = run.geometry.hover_gap_max)
    sums.hover = std::max(sums.hover.value_or(0.0), *hover);
  for (std::size_t i = 0; i < results::kReferences.size(); ++i)
    if (const auto* speedup = speedup_of(run, *sums.question, results::kReferences[i])) {
      sums.speedups[i].add(speedup->playback.value);
      sums.passes.add(static_cast<double>(speedup->passes));
    }
}

std::vector<std::string> cells_of(Sums s) {
  if (s.counts) s.counts->set_rates();
  const auto count = [&](std::uint64_t LevelCounts::*member) {
    return s.counts ? format_count(*s.counts.*member) : "-";
  };
  const std::string not_ok = text::joined(s.not_ok, [](const auto& one) {  // "1 error, 2 refused"
    return std::to_string(one.second) + " " + name_of(one.first);
  });
  const std::string scenes = std::to_string(s.scenes) + (not_ok.empty() ? "" : " (" + not_ok + ")");
  std::vector<std::string> cells = {
      s.detector,
      scenes,
      s.level ? name_of(*s.level) : "",
      count(&LevelCounts::truth),
      s.counts ? format_rate(s.counts->recall) : "-",
      count(&LevelCounts::missed),
      count(&LevelCounts::spurious),
      s.body ? format_count(s.body->missed) + "/" + format_count(s.body->spurious) : "-",
      format_millimetres(s.hover),
      s.question ? name_of(*s.question) : "",
      format_counts(s.passes)};
  for (const Range& range : s.speedups)
    cells.push_back(range.low ? format_range(range) + "x" : "-");
  return cells;
}

// Counts of different levels do not add up: a detector has a line per level. A run that is not `ok`
// has no level and counts in the detector's first line.
Sums& line_of(const Run& run, std::vector<Sums>& all) {
  for (Sums& s : all) {
    if (s.detector != run.detector || (run.ok() && s.scenes > 0 && s.level != run.per_frame.level))
      continue;
    if (run.ok()) s.level = run.per_frame.level;
    return s;
  }
  Sums& added = all.emplace_back();
  added.detector = run.detector;
  added.level = run.per_frame.level;
  return added;
}

TitledTable summary_table(const results::Results& results) {
  TitledTable out{
      "",
      results.timing ? "Sums over scenes; speed-ups are the smallest and the largest of any scene, "
                       "in playback."
                     : "Sums over scenes.",
      {{"detector", true, ""},
       {.title = "scenes", .left = false, .id = "scenes"},
       {"level", true, ""},
       {.title = "truth", .left = false, .spare = 1},
       {.title = "recall", .left = false, .id = "recall", .spare = 3},
       {.title = "missed", .left = false, .role = Role::kErrors},
       {.title = "spurious", .left = false, .role = Role::kErrors},
       {.title = "body m/s", .left = false, .spare = 5},
       {.title = "hover mm", .left = false, .spare = 2},
       {.title = "question", .left = true, .id = "question", .role = Role::kOfTimes, .spare = 7},
       {.title = "passes", .left = false, .id = "passes", .role = Role::kOfTimes, .spare = 8}},
      {}};
  for (const char* reference : results::kReferences)
    out.columns.push_back(reference_column(reference, ""));
  std::vector<Sums> all;
  for (const Run& run : results.runs) add_run(run, line_of(run, all));
  for (const Sums& s : all) {
    // Scenes about levels that a detector does not claim say nothing about it beside others.
    const bool about_nothing = !s.level && s.not_ok.empty();
    const bool has_more = std::any_of(all.begin(), all.end(), [&](const Sums& other) {
      return other.detector == s.detector && other.level;
    });
    if (!about_nothing || !has_more) out.rows.push_back(cells_of(s));
  }
  return out;
}

Blocks summary_blocks(const results::Index& index) { return {summary_table(index.results())}; }

// A single scene has its own table, which says the same.
std::vector<TerminalPart> summary_in_terminal(const results::Index& index) {
  if (index.results().scenes.size() < 2) return {};
  return {{"all scenes", "sums over scenes; speed-ups: smallest and largest of any scene", "",
           summary_table(index.results())}};
}

}  // namespace

/// A row per detector and finest level judged, in the order of first runs: counts summed over its
/// scenes with status `ok`, the worst hover gap, and the range of its speed-ups over scenes.
extern const Section kSummary = {"summary", "Summary", "Summary", summary_blocks,
                                 summary_in_terminal};

}  // namespace contactcheck::report
