#include "reference/report/tables/run_row.h"

#include <algorithm>
#include <cmath>

#include "reference/results/references.h"
#include "reference/text/lists.h"

namespace contactcheck::report {
namespace {
using results::Run;

// "missed/spurious" of the level body, where it is judged.
std::string body_errors(const Run& run) {
  const results::LevelCounts* body = counts_of(run, Level::kBody);
  if (body == nullptr) return "-";
  return format_count(body->missed) + "/" + format_count(body->spurious);
}

// Our time, which includes a pipe's, and the time that the detector reports itself.
std::string frame_cell(const Run& run, const results::QuestionTimes& times) {
  TimedPart part;
  part.add(run, times);
  const std::optional<double> own = times.playback.self_reported;
  return format_number(times.playback.frame) + (own ? " (own " + format_number(own) + ")" : "") +
         part.cut_text();
}

// A reference may have fewer passes than the row: then the ratio is not over all of the row's.
std::string speed_cell(const Run& run, const char* reference, const results::QuestionTimes* times) {
  const results::Speedup* s = speedup_of(run, compared_question(run), reference);
  if (s == nullptr) return "-";
  const bool fewer = times != nullptr && s->passes != times->passes;
  return format_ratio(s->playback) + (fewer ? " (" + counted_passes(s->passes) + ")" : "");
}

template <typename Value>
std::string names_of(const std::vector<Value>& values) {
  return text::joined(values, [](Value value) { return name_of(value); });
}

}  // namespace

Column reference_column(const std::string& reference, const std::string& meaning) {
  // One of FCL's two hierarchies says nearly as much as both.
  return {.title = "vs " + reference,
          .left = false,
          .meaning = meaning,
          .role = Role::kTime,
          .spare = reference == "fcl-obbrss" ? 4 : 0};
}

const std::vector<Column>& result_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {
        {"detector", true, "as given to --detector"},
        {"level", true, "finest level judged"},
        {.title = "truth",
         .left = false,
         .meaning = "true contacts at that level, over all frames",
         .spare = 1},
        {.title = "recall", .left = false, .meaning = "hit / truth, cut, not rounded", .spare = 3},
        {.title = "missed",
         .left = false,
         .meaning = "true contacts not reported",
         .role = Role::kErrors},
        {.title = "spurious",
         .left = false,
         .meaning = "reported, not true",
         .role = Role::kErrors},
        {.title = "body m/s",
         .left = false,
         .meaning = "pairs of bodies missed / spurious, over all frames",
         .spare = 5},
        {.title = "hover mm",
         .left = false,
         .meaning = "largest true distance at the moment contact is first reported",
         .spare = 2},
        {.title = "late",
         .left = false,
         .meaning = "frames reported after (+) or before (-) the truth, worst episode",
         .spare = 6},
        {.title = "question",
         .left = true,
         .meaning = "question of the next columns",
         .role = Role::kOfTimes,
         .spare = 7},
        {.title = "ms/frame",
         .left = false,
         .meaning = "map + update + query in playback, without the first frame; (own ...): update "
                    "+ query by its own clock",
         .role = Role::kTime},
        {.title = "passes",
         .left = false,
         .meaning = "timed passes through the frames, each in a fresh process",
         .role = Role::kOfTimes,
         .spare = 8}};
    for (const std::string reference : results::kReferences)
      all.push_back(reference_column(
          reference, "time of " + reference + " / time of this detector, same question, playback"));
    return all;
  }();
  return columns;
}

std::vector<Column> result_columns(const results::Results& results) {
  std::vector<Column> out = result_columns();
  if (!results.timing)
    std::erase_if(out, [](const Column& column) {
      return column.role == Role::kTime || column.role == Role::kOfTimes;
    });
  return out;
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
  const results::QuestionTimes* times = compared_times(run);
  std::vector<std::string> cells = {run.detector,
                                    finest_level(run),
                                    count(&results::LevelCounts::truth),
                                    counts == nullptr ? "-" : format_rate(counts->recall),
                                    count(&results::LevelCounts::missed),
                                    count(&results::LevelCounts::spurious),
                                    body_errors(run),
                                    format_millimetres(run.geometry.hover_gap_max),
                                    format_count(run.geometry.late_frames),
                                    name_of(compared_question(run)),
                                    times == nullptr ? "-" : frame_cell(run, *times),
                                    times == nullptr ? "-" : std::to_string(times->passes)};
  for (const char* reference : results::kReferences)
    cells.push_back(speed_cell(run, reference, times));
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

const results::QuestionTimes* times_in(const Run& run, Question question) {
  const auto times =
      std::find_if(run.times.begin(), run.times.end(),
                   [&](const results::QuestionTimes& one) { return one.question == question; });
  return times == run.times.end() ? nullptr : &*times;
}

Question compared_question(const Run& run) {
  const Question question =
      run.semantics.answers(Question::kTriangles) ? Question::kTriangles : Question::kBody;
  return run.times.empty() || times_in(run, question) != nullptr ? question
                                                                 : run.times.front().question;
}

const results::QuestionTimes* compared_times(const Run& run) {
  return times_in(run, compared_question(run));
}

const results::PhaseTimes* phases_of(const results::QuestionTimes& times, bool cold) {
  if (!cold) return &times.playback;
  return times.cold ? &*times.cold : nullptr;
}

void TimedPart::add(const Run& run, const results::QuestionTimes& times) {
  passes.add(static_cast<double>(times.passes));
  timed_frames += times.timed_frames;
  frames += run.frames - (is_of_steps(times.question) ? 1 : 0);
}

std::string TimedPart::frames_text() const {
  const std::string timed = std::to_string(timed_frames);
  return timed_frames < frames ? timed + " of " + std::to_string(frames) + " frames" : timed;
}

std::string TimedPart::cut_text() const {
  return timed_frames < frames ? " (" + frames_text() + ")" : "";
}

std::optional<double> mean_frame_ms(const std::vector<const Run*>& runs, bool cold,
                                    std::optional<Question> question) {
  double ms = 0.0, frames = 0.0;
  for (const Run* run : runs) {
    const results::QuestionTimes* const asked = question             ? times_in(*run, *question)
                                                : run->times.empty() ? nullptr
                                                                     : &run->times.front();
    const results::PhaseTimes* times = asked == nullptr ? nullptr : phases_of(*asked, cold);
    if (times == nullptr) return {};
    const auto n = static_cast<double>(run->frames);
    ms += n * times->frame;
    frames += n;
  }
  const double mean = ms / frames;
  return std::isfinite(mean) && mean > 0.0 ? std::optional(mean) : std::nullopt;
}

std::string options_text(const results::Texts& options) {
  if (options.empty()) return "-";
  return text::joined(options, [](const auto& one) { return one.first + "=" + one.second; });
}

std::string semantics_text(const Semantics& s) {
  std::string text = "levels " + names_of(s.levels);
  if (!s.informative.empty()) text += "; informative " + names_of(s.informative);
  text += "; questions " + names_of(s.questions) + (s.solid ? "; solid, " : "; surface, ") +
          (s.closed ? "closed, " : "open, ") + (s.exact ? "exact" : "not exact");
  if (s.margin > 0.0) text += "; margin " + format_millimetres(s.margin) + " mm";
  if (s.tolerance.absolute > 0.0)
    text += "; tolerance within steps " + format_millimetres(s.tolerance.absolute) + " mm";
  if (s.tolerance.of_start > 0.0)
    text += "; tolerance within steps " + format_number(s.tolerance.of_start) +
            " of the distance at the start";
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

}  // namespace contactcheck::report
