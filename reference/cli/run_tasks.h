// What `run` is asked to do, as scenes with their detectors.
#pragma once

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"
#include "reference/run/suite_run.h"

namespace contactcheck {

struct RunTasks {
  std::vector<SceneTask> scenes;
  std::vector<results::Goal> goals;  ///< of all suites, canonical
};

/// Names of detectors become canonical, with --threads and --isa as options of those that have
/// them. @throws InputError for unknown names
RunTasks make_tasks(const RunArguments& arguments, const DetectorCatalog& catalog);

}  // namespace contactcheck
