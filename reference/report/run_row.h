// One run of results.json as the cells of a table line: shared by the terminal and Markdown.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace contactcheck {

struct Column {
  std::string title;
  bool left;            ///< aligned
  std::string meaning;  ///< for the legend
};

/// Columns of the result table, in order.
const std::vector<Column>& result_columns();

/// The cells of one run, one per column. Runs that are not `ok` show their status and message.
std::vector<std::string> result_cells(const nlohmann::ordered_json& run);

/// A member of an object, or null: results of older versions lack what was not measured then.
nlohmann::ordered_json at_or_null(const nlohmann::ordered_json& j, const char* key);
/// The run of a detector on a scene when it is `ok`, else null.
nlohmann::ordered_json find_run(const nlohmann::ordered_json& results, const std::string& scene,
                                const std::string& detector);
/// speedup[question][reference] of a run, or null.
nlohmann::ordered_json speedup_of(const nlohmann::ordered_json& run, const std::string& question,
                                  const std::string& reference);
/// The question a run is compared in: triangles where it answers them, else body.
std::string compared_question(const nlohmann::ordered_json& run);

/// "margin=0.001, scale=0"; "-" without options.
std::string options_text(const nlohmann::ordered_json& options);
/// What a detector claims, in words: levels, questions, surface or solid, exactness, margin,
/// precision, depth.
std::string semantics_text(const nlohmann::ordered_json& semantics);

/// The finest level that a run which is `ok` was judged at; "" without one.
std::string finest_level(const nlohmann::ordered_json& run);
/// The runs of one scene, in file order.
std::vector<nlohmann::ordered_json> runs_of_scene(const nlohmann::ordered_json& results,
                                                  const std::string& scene);

}  // namespace contactcheck
