// Suites: named lists of scenes and detectors (fixtures/README.md, "Suites").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace contactcheck::scene {

/// Names of detectors are as on the command line, all different. Whether they exist is the
/// registry's business.
struct SuiteScene {
  std::string id;                      ///< of a scene or family that comes along; or empty, and:
  std::filesystem::path file;          ///< a scene file or recording, absolute
  std::vector<std::string> detectors;  ///< empty: those of the suite
};

/// What a suite hopes to measure. Missing it is a result, not a failure.
struct SuiteGoal {
  enum class Kind {
    kOver,       ///< time(other) / time(detector)
    kOverScene,  ///< time(detector) / its time in the other scene
    kPerPair     ///< microseconds per true pair of triangles
  };
  std::string name;  ///< one line
  std::string scene, detector;
  Kind kind = Kind::kOver;
  std::string other;  ///< detector or scene, by kind
  std::string part;   ///< "playback", "cold", "contact_frames" (of a playback)
  std::optional<double> at_least, at_most;  ///< one of them
};

struct Suite {
  std::string id;
  std::string title;                   ///< one line
  std::vector<SuiteScene> scenes;      ///< ids all different; at least one
  std::vector<std::string> detectors;  ///< at least one
  std::vector<SuiteGoal> goals;
};

/// A scene is "ID", {"scene": ID, "detectors": [...]} or {"file": PATH}, with detectors where
/// wanted; PATH (.json, .ccr) is relative to the suite's own file, and goals do not know its scene.
/// @throws InputError, one sentence: file, path of the field, value, what is allowed
Suite load_suite(const std::filesystem::path& file);

/// Where a suite's scene is read. @throws InputError for an id that is none of `fixtures`
std::filesystem::path file_of(const SuiteScene& scene, const std::filesystem::path& fixtures);

}  // namespace contactcheck::scene
