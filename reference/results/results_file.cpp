#include "reference/results/results_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/types/check.h"
#include "reference/results/results_json.h"
#include "reference/results/schema_defect.h"
#include "reference/scene/catalogue.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {
using Json = nlohmann::ordered_json;

// "[json.exception.type_error.302] sentence"
std::string sentence_of(const Json::exception& e) {
  const std::string what = e.what();
  const std::size_t bracket = what.find("] ");
  return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

Json read_results(const std::filesystem::path& file) {
  const std::string bytes = read_file_bytes(file, "results file");
  Json results;
  try {
    results = Json::parse(bytes);
  } catch (const Json::parse_error& e) {
    throw InputError(file.string() + ": not JSON at byte " + std::to_string(e.byte));
  } catch (const Json::out_of_range& e) {  // a number that no double holds
    throw InputError(file.string() + ": " + sentence_of(e));
  }
  const auto schema = results.is_object() ? results.find("schema") : results.end();
  if (!results.is_object() || schema == results.end() || *schema != results::kSchema)
    throw InputError(file.string() + ": field schema is not \"" + results::kSchema + "\"");
  check_json_depth(bytes, file);
  return results;
}

std::size_t depth_of(std::string_view json) {
  std::size_t depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;  // what is behind it ends no text
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_text && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return deepest;
}

std::filesystem::path schema_file() { return fixtures_directory() / "results.schema.json"; }

}  // namespace

void check_json_depth(std::string_view json, const std::filesystem::path& file) {
  constexpr std::size_t kDeepest = 64;
  if (const std::size_t depth = depth_of(json); depth > kDeepest)
    throw InputError(file.string() + ": nested " + std::to_string(depth) + " deep; at most " +
                     std::to_string(kDeepest) + " is allowed");
}

results::Results results_in(const std::filesystem::path& file) {
  const Json json = read_results(file);
  // Without a schema, what is missing would pass for the default: nothing missed.
  if (!std::filesystem::is_regular_file(schema_file()))
    throw InputError(file.string() + ": cannot be checked: there is no " + schema_file().string());
  const std::string found =
      schema_defect(Json::parse(read_file_bytes(schema_file(), "schema file")), json);
  if (!found.empty()) throw InputError(file.string() + ": not complete: " + found);
  try {
    return results::from_json(json);
  } catch (const Json::exception& e) {
    throw InputError(file.string() + ": not complete: " + sentence_of(e));
  }
}

}  // namespace contactcheck
