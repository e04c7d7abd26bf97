// What finished scenes become: results.json and the files that it names.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/results/results.h"
#include "reference/suite/finished_scene.h"
#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

class SuiteOutput {
 public:
  /// `out`: with the folders of make_out_folders; `scratch`: with a folder `contacts`.
  SuiteOutput(std::filesystem::path out, std::filesystem::path scratch);

  /// Writes a scene's contacts to the scratch folder, and drops their text.
  /// @throws InputError when they cannot be written
  void write_contacts(FinishedScene& scene) const;
  /// In the order of the run. Its recording is in `out`, its case files where its disagreements
  /// say. @throws InputError when its contacts cannot be written
  void add(FinishedScene scene);

  /// Completes `results`, which say what has no scene, and writes results.json, cases/ and
  /// contacts/; those of an earlier run go at the last moment. A shard gets the hashes of all files
  /// that it names, the whole of a run what `goals` come to. Returns the results.
  /// @throws InputError when something cannot be written
  results::Results write(results::Results results, const std::vector<results::Goal>& goals,
                         const results::KnownDefects& known_defects, SuiteOutcome* outcome);

 private:
  std::filesystem::path out_, scratch_;
  results::Texts identities_;
  std::vector<results::Scene> scenes_;
  std::vector<results::Run> runs_;
  std::vector<results::Disagreement> disagreements_;
};

}  // namespace contactcheck::suite
