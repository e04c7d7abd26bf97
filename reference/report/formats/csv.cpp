#include "reference/report/formats/csv.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/report/tables/run_row.h"

namespace contactcheck::report {
namespace {

using results::ErrorSpread;
using results::Geometry;
using results::LevelCounts;
using results::NearReports;
using results::PhaseTimes;
using results::QuestionTimes;
using results::Run;
using results::Speedup;

struct CsvColumn {
  std::string title;
  std::function<std::string(const Run& run)> text;
};

std::string csv_text(const std::string& text) { return text; }
// As in results.json.
template <typename Number>
std::string csv_text(Number number) {
  return nlohmann::json(number).dump();
}
template <typename T>
std::string csv_text(const std::optional<T>& value) {
  return value ? csv_text(*value) : "";
}

const Run* any_run(const Run& run) { return &run; }
const Run* ok_run(const Run& run) { return run.ok() ? &run : nullptr; }
// Other programs leave the frames of runs that are not `ok` out.
const Run* run_of_frames(const Run& run) { return run.frames > 0 ? &run : ok_run(run); }

// In the order of their first speed-up.
std::vector<std::string> references_of(const results::Results& results) {
  std::vector<std::string> names;
  for (const Run& run : results.runs)
    for (const auto& [question, by_reference] : run.speedup)
      for (const auto& [name, speedup] : by_reference)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<CsvColumn> columns_of(const results::Results& results) {
  std::vector<CsvColumn> columns;
  // Pairs of a title and a member of what `part` finds in a run; cells are empty where that is
  // null.
  const auto add_members = [&](const std::string& before, const std::string& after, auto part,
                               auto... members) {
    (columns.push_back({before + members.first + after,
                        [=](const Run& run) {
                          const auto* found = part(run);
                          return found == nullptr ? "" : csv_text(found->*members.second);
                        }}),
     ...);
  };

  add_members("", "", any_run, std::pair("scene", &Run::scene),
              std::pair("detector", &Run::detector));
  columns.push_back({"status", [](const Run& run) { return name_of(run.status); }});
  add_members("", "", any_run, std::pair("message", &Run::message));
  columns.push_back({"options", [](const Run& run) {
                       return run.options.empty() ? "" : options_text(run.options);
                     }});
  add_members("", "", run_of_frames, std::pair("frames", &Run::frames),
              std::pair("contact_frames", &Run::contact_frames));
  columns.push_back({"finest_level", finest_level});

  for (const Level level : kLevels) {
    add_members(
        name_of(level), "", [=](const Run& run) { return counts_of(run, level); },
        std::pair("_truth", &LevelCounts::truth), std::pair("_reported", &LevelCounts::reported),
        std::pair("_hit", &LevelCounts::hit), std::pair("_missed", &LevelCounts::missed),
        std::pair("_spurious", &LevelCounts::spurious), std::pair("_recall", &LevelCounts::recall),
        std::pair("_spurious_rate", &LevelCounts::spurious_rate));
    if (!is_impact(level)) continue;
    add_members(
        name_of(level), "",
        [=](const Run& run) {
          const LevelCounts* counts = counts_of(run, level);
          return counts == nullptr || !counts->within ? nullptr : &*counts->within;
        },
        std::pair("_near", &NearReports::near), std::pair("_near_max_m", &NearReports::near_max),
        std::pair("_near_of_start_max", &NearReports::near_of_start_max),
        std::pair("_undecided", &NearReports::undecided));
  }

  const auto geometry = [](const Run& run) { return &run.geometry; };
  const auto add_spread = [&](const char* name, const char* unit, auto spread) {
    add_members(
        name, unit, [=](const Run& run) { return &(run.geometry.*spread); },
        std::pair("_max", &ErrorSpread::max), std::pair("_p95", &ErrorSpread::p95),
        std::pair("_mean", &ErrorSpread::mean));
  };
  add_members("", "", geometry, std::pair("missed_length_m", &Geometry::missed_length),
              std::pair("covered_length_fraction", &Geometry::covered_length_fraction),
              std::pair("spurious_distance_max_m", &Geometry::spurious_distance_max));
  add_spread("depth_error", "_m", &Geometry::depth);
  add_spread("normal_error", "_deg", &Geometry::normal_deg);
  add_members("", "", geometry, std::pair("hover_gap_max_m", &Geometry::hover_gap_max),
              std::pair("late_frames", &Geometry::late_frames));

  columns.push_back({"question", [](const Run& run) {
                       return run.times.empty() ? "" : name_of(compared_question(run));
                     }});
  add_members("", "", compared_times, std::pair("timed_frames", &QuestionTimes::timed_frames),
              std::pair("passes", &QuestionTimes::passes));
  add_members("", "", ok_run, std::pair("prepare_ms", &Run::prepare_ms));
  for (const bool cold : {false, true}) {
    const auto part = [=](const Run& run) {
      const QuestionTimes* times = compared_times(run);
      return times == nullptr ? nullptr : phases_of(*times, cold);
    };
    const char* name = cold ? "cold" : "playback";
    add_members(name, "_ms", part, std::pair("_map", &PhaseTimes::map),
                std::pair("_update", &PhaseTimes::update), std::pair("_query", &PhaseTimes::query),
                std::pair("_frame", &PhaseTimes::frame),
                std::pair("_contact_frame", &PhaseTimes::contact_frame));
    if (!cold) add_members(name, "_ms", part, std::pair("_first_frame", &PhaseTimes::first_frame));
    add_members(name, "_ms", part, std::pair("_self_reported", &PhaseTimes::self_reported),
                std::pair("_cpu", &PhaseTimes::cpu));
  }

  for (const std::string& reference : references_of(results)) {
    const std::string name = "vs_" + reference;
    const auto speedup = [=](const Run& run) {
      return speedup_of(run, compared_question(run), reference);
    };
    const auto add_ratio = [&](const char* regime, auto part) {
      add_members(name + regime, "", part, std::pair("_ratio", &results::Ratio::value),
                  std::pair("_low", &results::Ratio::low),
                  std::pair("_high", &results::Ratio::high));
    };
    add_ratio("_playback", [=](const Run& run) {
      const Speedup* found = speedup(run);
      return found == nullptr ? nullptr : &found->playback;
    });
    add_ratio("_cold", [=](const Run& run) {
      const Speedup* found = speedup(run);
      return found == nullptr || !found->cold ? nullptr : &*found->cold;
    });
    add_members(name, "", speedup, std::pair("_passes", &Speedup::passes));
  }

  add_members("", "", ok_run, std::pair("prepared_bytes", &Run::prepared_bytes),
              std::pair("memory_bytes", &Run::memory_bytes),
              std::pair("contact_hash", &Run::contact_hash));
  add_members("", "", any_run, std::pair("recording", &Run::recording));
  return columns;
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_report(const results::Results& results) {
  const std::vector<CsvColumn> columns = columns_of(results);
  std::string text;
  const auto end_line = [&] { text.replace(text.size() - 1, 1, "\r\n"); };
  for (const CsvColumn& column : columns) text += csv_cell(column.title) + ",";
  end_line();
  for (const Run& run : results.runs) {
    for (const CsvColumn& column : columns) text += csv_cell(column.text(run)) + ",";
    end_line();
  }
  return text;
}

}  // namespace contactcheck::report
