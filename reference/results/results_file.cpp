#include "reference/results/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "reference/text/file_text.h"
#include "reference/text/json_value.h"

namespace contactcheck::results {
namespace {
using Json = nlohmann::ordered_json;

// "[json.exception.type_error.302] sentence"
std::string sentence_of(const Json::exception& e) {
  const std::string what = e.what();
  const std::size_t bracket = what.find("] ");
  return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

Json read_results(const std::filesystem::path& file) {
  const std::string bytes = text::read_file_bytes(file, "results file");
  Json results;
  try {
    results = Json::parse(bytes);
  } catch (const Json::parse_error& e) {
    throw InputError(file.string() + ": not JSON at byte " + std::to_string(e.byte));
  } catch (const Json::out_of_range& e) {  // a number that no double holds
    throw InputError(file.string() + ": " + sentence_of(e));
  }
  const Json schema = results.is_object() ? results.value("schema", Json()) : Json();
  if (schema == "contactcheck-results/1")
    throw InputError(file.string() +
                     ": field schema is \"contactcheck-results/1\": results of an earlier version, "
                     "to be recorded anew with `contactcheck run`");
  if (schema != results::kSchema)
    throw InputError(file.string() + ": field schema is not \"" + results::kSchema + "\"");
  check_json_depth(bytes, file);
  return results;
}

// What a schema cannot state. The first impossible time of a row, or "".
std::string time_defect(const results::Run& run) {
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    const results::QuestionTimes& times = run.times[i];
    const std::string place =
        i == 0 ? "time_ms" : text::item_path("time_ms_other_questions", i - 1);
    if (times.timed_frames > run.frames)
      return fmt::format("{}.timed_frames is {}; it must be at most {}, the row's frames", place,
                         times.timed_frames, run.frames);
    if (times.timed_contact_frames > times.timed_frames)
      return fmt::format("{}.timed_contact_frames is {}; it must be at most {}, the timed frames",
                         place, times.timed_contact_frames, times.timed_frames);
    if (!times.pass_ms.empty() && times.pass_ms.size() != times.passes)
      return fmt::format("{}.pass_ms has {} entries; it must have {}, the row's passes", place,
                         times.pass_ms.size(), times.passes);
    if (const auto found = run.speedup.find(times.question); found != run.speedup.end())
      for (const auto& [reference, speedup] : found->second)
        if (speedup.passes > times.passes)
          return fmt::format("speedup.{}.{}.passes is {}; it must be at most {}, the row's passes",
                             name_of(times.question), reference, speedup.passes, times.passes);
  }
  const auto& frame_ms = run.per_frame.frame_ms;  // a baseline has left out its entries
  if (frame_ms && !frame_ms->empty() && frame_ms->size() != run.frames)
    return fmt::format("per_frame.frame_ms has {} entries; it must have {}, the row's frames",
                       frame_ms->size(), run.frames);
  return "";
}

}  // namespace

void check_json_depth(std::string_view json, const std::filesystem::path& file) {
  constexpr std::size_t kDeepest = 64;
  std::size_t depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;  // the escaped character does not end the text
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
  if (deepest > kDeepest)
    throw InputError(file.string() + ": nested " + std::to_string(deepest) + " deep; at most " +
                     std::to_string(kDeepest) + " is allowed");
}

results::Results results_in(const std::filesystem::path& file) {
  const Json json = read_results(file);
  // Without a schema, what is missing would pass for the default: nothing missed.
  const std::filesystem::path schema = scene::fixtures_directory() / "results.schema.json";
  if (!std::filesystem::is_regular_file(schema))
    throw InputError(file.string() + ": cannot be checked: there is no " + schema.string());
  const std::string found =
      schema_defect(Json::parse(text::read_file_bytes(schema, "schema file")), json);
  if (!found.empty()) throw InputError(file.string() + ": not complete: " + found);
  results::Results out;
  try {
    out = results::from_json(json);
  } catch (const Json::exception& e) {
    throw InputError(file.string() + ": not complete: " + sentence_of(e));
  }
  for (std::size_t i = 0; i < out.runs.size(); ++i)
    if (const std::string impossible = time_defect(out.runs[i]); !impossible.empty())
      throw InputError(file.string() + ": " + text::item_path("runs", i) + "." + impossible);
  return out;
}

}  // namespace contactcheck::results
