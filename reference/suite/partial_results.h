// Scenes that a run has finished, kept in OUT/partial/ until its results.json is complete: what
// `run --resume` takes over after an interruption.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::suite {

/// All that results.json will hold of one scene. The `case` of a disagreement is still the absolute
/// path of a file in the run's scratch folder.
struct FinishedScene {
  results::Scene scene;
  std::vector<results::Run> runs;
  std::vector<results::Disagreement> disagreements;
  std::string contacts;  ///< text of contacts/SCENE.json; empty: there is no such file
};

/// One file per scene, OUT/partial/SCENE.partial.json, complete or not there, with the case files'
/// texts and the contacts in it: no other file that could be missing, but for the recording, which
/// is looked for.
class PartialResults {
 public:
  /// `scratch`: where the case files of scenes that are taken over are written again.
  PartialResults(const std::filesystem::path& out, const std::filesystem::path& scratch);

  /// The scene as an earlier run has finished it, if that run was of the same `identity` (see
  /// RunIdentity). A file that is damaged counts as none.
  std::optional<FinishedScene> take(const std::string& id, const std::string& identity) const;
  /// @throws InputError when it cannot be written
  void keep(const std::string& id, const std::string& identity, const FinishedScene& scene) const;
  void drop(const std::string& id) const;
  /// Removes all of it, and the folder unless other files are in it.
  void clear() const;

 private:
  std::filesystem::path file_of(const std::string& id) const;

  std::filesystem::path out_, folder_, scratch_;
};

}  // namespace contactcheck::suite
