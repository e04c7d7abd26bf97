#include "reference/report/run_row.h"

#include <algorithm>
#include <cmath>

#include "reference/report/format.h"
#include "reference/results/references.h"

namespace contactcheck {
namespace {
using results::Run;

// "missed/spurious" of the level body, where it is judged.
std::string body_errors(const Run& run) {
  const results::LevelCounts* body = counts_of(run, Level::kBody);
  if (body == nullptr) return "-";
  return format_count(body->missed) + "/" + format_count(body->spurious);
}

// Ours, with a pipe's way in it, and beside it what the detector says of itself.
std::string cold_frame(const Run& run) {
  if (run.times.empty()) return "-";
  const results::PhaseTimes& cold = run.times.front().cold;
  const std::string text = format_number(cold.frame);
  return cold.self_reported ? text + " (own " + format_number(cold.self_reported) + ")" : text;
}

std::string speed_cell(const Run& run, const char* reference) {
  const results::Speedup* s = speedup_of(run, compared_question(run), reference);
  return s == nullptr ? "-" : format_ratio(s->cold, false);
}

template <typename Value>
std::string names_of(const std::vector<Value>& values) {
  std::string text;
  for (const Value value : values) text += (text.empty() ? "" : ", ") + std::string(name_of(value));
  return text;
}

}  // namespace

const std::vector<Column>& result_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {
        {"detector", true, "as given to --detector"},
        {"level", true, "finest level judged"},
        {"truth", false, "true contacts at that level, over all frames"},
        {"recall", false, "hit / truth, cut, not rounded"},
        {"missed", false, "true contacts not reported"},
        {"spurious", false, "reported, not true"},
        {"body m/s", false, "pairs of bodies missed / spurious, over all frames"},
        {"hover mm", false, "largest true distance at the moment contact is first reported"},
        {"late", false, "frames reported after (+) or before (-) the truth, worst episode"},
        {"ms/frame", false,
         "map + update + query, cold median, own question; (own ...): update + query by its own "
         "clock"},
        {"question", true, "question in which the next columns compare"}};
    for (const std::string reference : kReferences)
      all.push_back(
          {"vs " + reference, false, "time of " + reference + " / time of this detector, cold"});
    return all;
  }();
  return columns;
}

std::vector<std::string> result_cells(const Run& run) {
  if (!run.ok()) {
    std::vector<std::string> cells(result_columns().size(), "");
    cells[0] = run.detector;
    cells[1] = name_of(run.status);
    cells[2] = run.message;
    return cells;
  }
  const results::LevelCounts* counts = counts_of(run, run.per_frame.level);
  const auto count = [&](std::uint64_t results::LevelCounts::*member) {
    return counts == nullptr ? "-" : format_count(counts->*member);
  };
  std::vector<std::string> cells = {run.detector,
                                    finest_level(run),
                                    count(&results::LevelCounts::truth),
                                    counts == nullptr ? "-" : format_rate(counts->recall),
                                    count(&results::LevelCounts::missed),
                                    count(&results::LevelCounts::spurious),
                                    body_errors(run),
                                    format_millimetres(run.geometry.hover_gap_max),
                                    format_count(run.geometry.late_frames),
                                    cold_frame(run),
                                    name_of(compared_question(run))};
  for (const char* reference : kReferences) cells.push_back(speed_cell(run, reference));
  return cells;
}

const results::LevelCounts* counts_of(const Run& run, std::optional<Level> level) {
  const auto counts = level ? run.levels.find(*level) : run.levels.end();
  return counts == run.levels.end() ? nullptr : &counts->second;
}

const results::LevelCounts* claimed_counts(const Run& run, std::optional<Level> level) {
  const results::LevelCounts* counts = counts_of(run, level);
  return counts == nullptr || counts->informative ? nullptr : counts;
}

const results::Speedup* speedup_of(const Run& run, Question question,
                                   const std::string& reference) {
  const auto by_reference = run.speedup.find(question);
  if (by_reference == run.speedup.end()) return nullptr;
  const auto speedup = by_reference->second.find(reference);
  return speedup == by_reference->second.end() ? nullptr : &speedup->second;
}

Question compared_question(const Run& run) {
  const std::vector<Question>& questions = run.semantics.questions;
  return std::find(questions.begin(), questions.end(), Question::kTriangles) != questions.end()
             ? Question::kTriangles
             : Question::kBody;
}

std::optional<double> mean_frame_ms(const std::vector<const Run*>& runs, bool hot) {
  double ms = 0.0, frames = 0.0;
  for (const Run* run : runs) {
    if (run->times.empty()) return {};
    const results::QuestionTimes& times = run->times.front();
    const auto n = static_cast<double>(run->frames);
    ms += n * (hot ? times.hot : times.cold).frame;
    frames += n;
  }
  const double mean = ms / frames;
  return std::isfinite(mean) && mean > 0.0 ? std::optional(mean) : std::nullopt;
}

std::string options_text(const results::Texts& options) {
  std::string text;
  for (const auto& [name, value] : options) text += (text.empty() ? "" : ", ") + name + "=" + value;
  return text.empty() ? "-" : text;
}

std::string semantics_text(const Semantics& s) {
  std::string text = "levels " + names_of(s.levels);
  if (!s.informative.empty()) text += "; informative " + names_of(s.informative);
  text += "; questions " + names_of(s.questions) + (s.solid ? "; solid, " : "; surface, ") +
          (s.closed ? "closed, " : "open, ") + (s.exact ? "exact" : "not exact");
  if (s.margin > 0.0) text += "; margin " + format_millimetres(s.margin) + " mm";
  text += std::string("; ") + name_of(s.precision) + " precision";
  if (s.local_origin) text += " about a local origin";
  if (s.scale != 1.0) text += ", scale " + format_number(s.scale);
  if (s.depth != DepthKind::kNone) text += std::string("; depth ") + name_of(s.depth);
  if (!s.means.empty()) text += "; " + s.means;
  return text;
}

std::string finest_level(const Run& run) {
  return run.per_frame.level ? name_of(*run.per_frame.level) : "";
}

}  // namespace contactcheck
