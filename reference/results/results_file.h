// A results.json of an earlier run, or of another program.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "reference/results/results.h"

namespace contactcheck {

/// Whoever copies or writes JSON recurses into it, and the stack is no place to find out how deep
/// it is. `json`: bytes that were parsed. @throws InputError when they are nested deeper than
/// results can be
void check_json_depth(std::string_view json, const std::filesystem::path& file);

/// All of a file that is as fixtures/results.schema.json says.
/// @throws InputError with the first place that is not
results::Results results_in(const std::filesystem::path& file);

class ResultsFile {
 public:
  /// @throws InputError when it cannot be read, is no JSON or of another schema
  explicit ResultsFile(const std::filesystem::path& file);

  /// @throws InputError that names the first place where it breaks fixtures/results.schema.json
  void require_schema() const;

  /// What `use(results)` returns. @throws InputError that names the place when a field that it
  /// needs is missing or is not what the schema says
  template <typename Use>
  auto read(Use&& use) const {
    try {
      return use(results_);
    } catch (const nlohmann::ordered_json::exception& e) {
      refuse(e);
    }
  }

 private:
  [[noreturn]] void refuse(const nlohmann::ordered_json::exception& e) const;

  std::filesystem::path file_;
  nlohmann::ordered_json results_;
};

}  // namespace contactcheck
