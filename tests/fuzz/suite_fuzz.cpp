// Fuzz target: suite files. Whatever is accepted names scenes, each once, and detectors.

#include <set>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/scene/suite_file.h"
#include "reference/text/id_check.h"
#include "tests/fuzz/fuzzed_file.h"

namespace contactcheck::test {
namespace {

void require_different(const std::vector<std::string>& names, const char* promise) {
  require(std::set<std::string>(names.begin(), names.end()).size() == names.size(), promise);
}

void check_promises(const scene::Suite& suite) {
  require(text::is_id(suite.id), "a suite has an id");
  require(!suite.scenes.empty() && !suite.detectors.empty(), "a suite has scenes and detectors");
  std::vector<std::string> ids;
  for (const scene::SuiteScene& scene : suite.scenes) {
    require(scene.id.empty() == scene.file.is_absolute(), "a scene has an id or an absolute file");
    if (!scene.id.empty()) ids.push_back(scene.id);
    require_different(scene.detectors, "a scene's detectors are all different");
  }
  require_different(ids, "a suite's scenes are all different");
  require_different(suite.detectors, "a suite's detectors are all different");
  for (const scene::SuiteGoal& goal : suite.goals)
    require(goal.at_least.has_value() != goal.at_most.has_value(), "a goal has one bound");
}

}  // namespace
}  // namespace contactcheck::test

CONTACTCHECK_FUZZ_TARGET(suite) {
  using namespace contactcheck;
  static const test::FuzzedFile file("suite.json");
  test::try_file(file, data, size, [](const std::filesystem::path& path) {
    test::check_promises(scene::load_suite(path));
  });
  return 0;
}
