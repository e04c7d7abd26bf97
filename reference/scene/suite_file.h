// Suites: named lists of scenes and detectors (fixtures/README.md, "Suites").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck::scene {

/// Detector names are as on the command line, all different. Whether they exist is checked by the
/// catalogue.
struct SuiteScene {
  std::string id;                      ///< a scene or family of contactcheck; or empty, and:
  std::filesystem::path file;          ///< a scene file or recording, absolute
  std::vector<std::string> detectors;  ///< empty: the suite's
};

/// A performance goal of a suite. Missing it is a result, not a failure.
struct SuiteGoal {
  enum class Kind {
    kOver,       ///< time(other) / time(detector)
    kOverScene,  ///< time(detector) / its time in the other scene
    kPerPair     ///< microseconds per true pair of triangles
  };
  std::string name;  ///< one line
  std::string scene, detector;
  Kind kind = Kind::kOver;
  std::string other;                        ///< detector or scene, by kind
  std::string part;                         ///< "playback", "cold", "contact_frames" (in playback)
  std::optional<double> at_least, at_most;  ///< one of them
};

struct Suite {
  std::string id;
  std::string title;                   ///< one line
  std::vector<SuiteScene> scenes;      ///< ids all different; at least one
  std::vector<std::string> detectors;  ///< at least one
  std::vector<SuiteGoal> goals;
};

/// A scene is "ID", {"scene": ID, "detectors": [...]} or {"file": PATH}, optionally with detectors;
/// PATH (.json, .ccr) is relative to the suite's file. Goals cannot refer to a scene given by PATH.
/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Suite load_suite(const std::filesystem::path& file);

/// The file of a suite's scene. @throws InputError for an id that `fixtures` does not contain
std::filesystem::path file_of(const SuiteScene& scene, const std::filesystem::path& fixtures);

}  // namespace contactcheck::scene
