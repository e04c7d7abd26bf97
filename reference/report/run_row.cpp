#include "reference/report/run_row.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/report/format.h"
#include "reference/results/references.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

// "missed/spurious" of the level body, where it is judged.
std::string body_errors(const Json& run) {
  const Json body = at_or_null(run.at("levels"), "body");
  if (body.is_null()) return "-";
  return format_count(body.at("missed")) + "/" + format_count(body.at("spurious"));
}

// Ours, with a pipe's way in it, and beside it what the detector says of itself.
std::string cold_frame(const Json& run) {
  const Json cold = at_or_null(run.at("time_ms"), "cold");
  if (cold.is_null()) return "-";
  const Json own = at_or_null(cold, "self_reported");
  const std::string text = format_number(cold.at("frame"));
  return own.is_null() ? text : text + " (own " + format_number(own) + ")";
}

std::string speed_cell(const Json& run, const char* reference) {
  const Json s = speedup_of(run, compared_question(run), reference);
  return s.is_null() ? "-" : format_ratio(s.at("cold"), false);
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

std::vector<std::string> result_cells(const Json& run) {
  const auto detector = run.at("detector").get<std::string>();
  if (run.at("status") != "ok") {
    std::vector<std::string> cells(result_columns().size(), "");
    cells[0] = detector;
    cells[1] = run.at("status").get<std::string>();
    cells[2] = run.at("message").get<std::string>();
    return cells;
  }
  const std::string level = finest_level(run);
  const Json counts = at_or_null(run.at("levels"), level.c_str());
  const auto count = [&](const char* key) {
    return counts.is_null() ? std::string("-") : format_count(counts.at(key));
  };
  const Json& geometry = run.at("geometry");
  std::vector<std::string> cells = {detector,
                                    level,
                                    count("truth"),
                                    counts.is_null() ? "-" : format_rate(counts.at("recall")),
                                    count("missed"),
                                    count("spurious"),
                                    body_errors(run),
                                    format_millimetres(geometry.at("hover_gap_max")),
                                    format_count(geometry.at("late_frames")),
                                    cold_frame(run),
                                    compared_question(run)};
  for (const char* reference : kReferences) cells.push_back(speed_cell(run, reference));
  return cells;
}

nlohmann::ordered_json at_or_null(const Json& j, const char* key) {
  const auto it = j.find(key);
  return it == j.end() ? Json(nullptr) : *it;
}

nlohmann::ordered_json find_run(const Json& results, const std::string& scene,
                                const std::string& detector) {
  for (const Json& run : results.at("runs"))
    if (run.at("scene") == scene && run.at("detector") == detector && run.at("status") == "ok")
      return run;
  return nullptr;
}

nlohmann::ordered_json speedup_of(const Json& run, const std::string& question,
                                  const std::string& reference) {
  const Json by_question = at_or_null(at_or_null(run, "speedup"), question.c_str());
  return by_question.is_null() ? Json(nullptr) : at_or_null(by_question, reference.c_str());
}

std::string compared_question(const Json& run) {
  const Json questions = at_or_null(run.at("semantics"), "questions");
  return std::find(questions.begin(), questions.end(), "triangles") != questions.end() ? "triangles"
                                                                                       : "body";
}

std::string options_text(const Json& options) {
  std::string text;
  for (const auto& [name, value] : options.items())
    text += (text.empty() ? "" : ", ") + name + "=" +
            (value.is_string() ? value.get<std::string>() : value.dump());
  return text.empty() ? "-" : text;
}

std::string semantics_text(const Json& s) {
  const auto names = [&](const char* key) {
    std::string text;
    for (const Json& name : s.value(key, Json::array()))
      text += (text.empty() ? "" : ", ") + name.get<std::string>();
    return text;
  };
  std::string text = "levels " + names("levels");
  if (!names("informative").empty()) text += "; informative " + names("informative");
  text += "; questions " + names("questions") + "; " + s.value("body", "surface") + ", " +
          s.value("touching", "closed") + ", " + (s.value("exact", false) ? "exact" : "not exact");
  if (s.value("margin", 0.0) > 0.0)
    text += "; margin " + format_millimetres(s.at("margin")) + " mm";
  text += "; " + s.value("precision", "double") + " precision";
  if (s.value("local_origin", false)) text += " about a local origin";
  if (s.value("scale", 1.0) != 1.0) text += ", scale " + format_number(s.at("scale"));
  if (s.value("depth_kind", "none") != std::string("none"))
    text += "; depth " + s.value("depth_kind", "none");
  if (!s.value("means", "").empty()) text += "; " + s.value("means", "");
  return text;
}

std::string finest_level(const Json& run) { return run.at("per_frame").value("level", ""); }

std::vector<nlohmann::ordered_json> runs_of_scene(const Json& results, const std::string& scene) {
  std::vector<Json> out;
  for (const Json& run : results.at("runs"))
    if (run.at("scene") == scene) out.push_back(run);
  return out;
}

}  // namespace contactcheck
