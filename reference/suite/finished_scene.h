// What a run has found out about one of its scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/results/results.h"

namespace contactcheck::suite {

/// All that results.json will hold of one scene. The `case` of a disagreement is still the path of
/// a file in the run's scratch folder.
struct FinishedScene {
  results::Scene scene;
  std::vector<results::Run> runs;
  std::vector<results::Disagreement> disagreements;
  std::string contacts;  ///< text of contacts/SCENE.json; empty: there is no such file
  /// Its entry in field `identities` (identity_hash in partial_results.h); empty: it has none.
  std::string hash;
};

/// A scene of results that are complete, with copies in `scratch` of the case files that `folder`,
/// the one of its results.json, has. Its recording stays where it is. @pre `rows` knows the scene
/// @throws InputError when a file is not there or cannot be copied
FinishedScene finished_scene(const results::Index& rows, const std::string& id,
                             const std::filesystem::path& folder,
                             const std::filesystem::path& scratch);

}  // namespace contactcheck::suite
