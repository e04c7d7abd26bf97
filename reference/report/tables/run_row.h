// Runs of results.json for all reports, and the cells of their table lines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/report/tables/format.h"
#include "reference/report/tables/table.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// The column of speed-ups over a reference.
Column reference_column(const std::string& reference, const std::string& meaning);

/// Columns of the result table, in order.
const std::vector<Column>& result_columns();
/// Those that are shown: without times none of these.
std::vector<Column> result_columns(const results::Results& results);

/// The cells of one run, one per column. Runs that are not `ok` show their status and message.
std::vector<std::string> result_cells(const results::Run& run);

/// The counts of a level; null if it was not judged, or `level` is none.
const results::LevelCounts* counts_of(const results::Run& run, std::optional<Level> level);
/// The same; null also if the detector does not claim the level.
const results::LevelCounts* claimed_counts(const results::Run& run, std::optional<Level> level);
/// The speed-up over a reference in a question, or null.
const results::Speedup* speedup_of(const results::Run& run, Question question,
                                   const std::string& reference);
/// The times in a question; null if it was not timed in it.
const results::QuestionTimes* times_in(const results::Run& run, Question question);
/// The question of a row's time and speed-ups: triangles if the detector answers it, else body; the
/// row's own question if it was timed, but not in that one.
Question compared_question(const results::Run& run);
/// The times in that question; null if nothing was timed.
const results::QuestionTimes* compared_times(const results::Run& run);
/// Null if it was not timed cold.
const results::PhaseTimes* phases_of(const results::QuestionTimes& times, bool cold);

/// How much was timed, for one row or several.
struct TimedPart {
  Range passes;
  std::size_t timed_frames = 0, frames = 0;
  void add(const results::Run& run, const results::QuestionTimes& times);
  /// "60", or "4 of 60 frames" if some were not timed.
  std::string frames_text() const;
  /// A suffix for a time: " (4 of 60 frames)", empty if all frames were timed.
  std::string cut_text() const;
};

/// Milliseconds per frame, in playback or cold: the mean over all frames of these runs, in
/// `question`, or each in its own. Nothing if one of them was not timed that way.
std::optional<double> mean_frame_ms(const std::vector<const results::Run*>& runs, bool cold,
                                    std::optional<Question> question = {});

/// "margin=0.001, scale=0"; "-" without options.
std::string options_text(const results::Texts& options);
/// A detector's claims in words: levels, questions, surface or solid, exactness, margin, precision,
/// depth.
std::string semantics_text(const Semantics& semantics);

/// The finest level at which a run that is `ok` was judged; "" without one.
std::string finest_level(const results::Run& run);
}  // namespace contactcheck::report
