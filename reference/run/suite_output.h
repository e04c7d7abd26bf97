// What finished scenes become: results.json and the files that it names.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/run/partial_results.h"
#include "reference/run/shard_record.h"
#include "reference/run/suite_run.h"

namespace contactcheck {

/// What results say besides what scenes say.
struct SuiteRecord {
  nlohmann::ordered_json head;  ///< schema, version, command, machine, libraries
  nlohmann::ordered_json tail;  ///< an object; what stands last
  std::vector<SuiteGoal> goals;
  const KnownDefects& known_defects;
  bool shard = false;  ///< the tail's `shard` gets the hashes of all files that the results name
};

class SuiteOutput {
 public:
  /// `out`: with the folders of make_out_folders; `scratch`: with a folder `contacts`.
  SuiteOutput(std::filesystem::path out, std::filesystem::path scratch);

  /// In the order of the run. Its recording is in `out`, its case files where its disagreements
  /// say. @throws InputError when its contacts cannot be written
  void add(FinishedScene scene);

  /// Writes results.json, cases/ and contacts/; those of an earlier run go at the last moment.
  /// Returns the results. @throws InputError when something cannot be written
  nlohmann::ordered_json write(const SuiteRecord& record, SuiteOutcome* outcome);

 private:
  nlohmann::ordered_json results_of(const SuiteRecord& record, SuiteOutcome* outcome) const;
  NamedFiles named_files(const std::vector<std::filesystem::path>& cases) const;

  std::filesystem::path out_, scratch_;
  nlohmann::ordered_json scenes_ = nlohmann::ordered_json::array(),
                         runs_ = nlohmann::ordered_json::array(),
                         disagreements_ = nlohmann::ordered_json::array();
};

}  // namespace contactcheck
