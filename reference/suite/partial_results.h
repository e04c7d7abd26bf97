// Scenes that a run has finished, kept in OUT/partial/ until its results.json is complete: what
// `run --resume` takes over after an interruption, and out of results.json after that.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/results/results.h"
#include "reference/suite/finished_scene.h"

namespace contactcheck::suite {

/// A scene that an interrupted run has left finished.
struct KeptScene {
  std::string id, identity, command;
};

/// Hash of a finished scene's identity (RunIdentity) and of its recording in `out`, as in field
/// `identities` of results.json. @throws InputError when the recording cannot be read
std::string identity_hash(const std::string& identity, const FinishedScene& scene,
                          const std::filesystem::path& out);

/// One file per scene, OUT/partial/SCENE.partial.json, complete or not there, with the case files'
/// texts and the contacts in it: no other file that could be missing, but for the recording, which
/// is looked for.
class PartialResults {
 public:
  /// `scratch`: where the case files of scenes that are taken over are written again.
  PartialResults(const std::filesystem::path& out, const std::filesystem::path& scratch);

  /// By id. A file that is damaged, or whose recording is gone, counts as none.
  std::vector<KeptScene> kept() const;
  /// The scene as an earlier run has finished it, if that run was of the same `identity` (see
  /// RunIdentity): an interrupted one, else the one whose results.json is there, which may be
  /// replaced before this run is complete: such a scene is kept here, too.
  std::optional<FinishedScene> take(const KeptScene& wanted);
  /// @pre the scene has its hash. @throws InputError when it cannot be written
  void keep(const KeptScene& name, const FinishedScene& scene) const;
  /// Removes all of it, and the folder unless other files are in it.
  void clear() const;

 private:
  struct File {
    KeptScene name;
    FinishedScene scene;  ///< with the texts of its cases in place of their files
  };
  std::filesystem::path file_of(const std::string& id) const;
  std::optional<File> read(const std::filesystem::path& file) const;
  std::optional<FinishedScene> take_complete(const KeptScene& wanted);

  std::filesystem::path out_, folder_, scratch_;
  /// Of the run that has ended in `out_`, empty without one; none: not looked for yet.
  std::optional<results::Results> complete_;
};

}  // namespace contactcheck::suite
