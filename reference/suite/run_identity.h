// What the results of a scene depend on, so that a later run can tell whether they are still its
// own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/scene/scene.h"
#include "reference/suite/suite_request.h"

namespace contactcheck::suite {

/// Hash of a scene's text and of the meshes and recordings that it names, as hexadecimal text; of
/// random pairs their number and their seed, since the program makes the rest. `scene` is what
/// `source` was read as. @throws InputError when a file cannot be read again
std::string content_of(const scene::SceneSource& source, const scene::Scene& scene);

/// The hash of a file's bytes, as hexadecimal text. @throws InputError when it cannot be read
std::string hash_of_file(const std::filesystem::path& file);

// Lines "NAME: VALUE" of identities.
/// @throws InputError when the program's file cannot be read
std::string program_lines(const std::filesystem::path& program);
std::string machine_lines();

/// The program (by the bytes of its file: a detector that was rebuilt is another one), the
/// libraries, the machine, the settings, the detectors and the scene's content.
class RunIdentity {
 public:
  /// @throws InputError when the program's file cannot be read
  explicit RunIdentity(const SuiteRequest& request);
  /// The same text for the same results: lines "NAME: VALUE".
  std::string of(const SceneTask& task) const;

 private:
  std::string common_;
};

/// The names of lines that one of two identities has and the other has not, each once.
std::vector<std::string> differences(const std::string& one, const std::string& other);

}  // namespace contactcheck::suite
