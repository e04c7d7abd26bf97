// The options of `run` that make a scene out of mesh files.
#pragma once

#include "reference/cli/commands.h"

namespace CLI {
class App;
}

namespace contactcheck {

/// --mesh, --motion, --size, --save-scene. Both must outlive the parsing.
void add_mesh_options(CLI::App& run, RunArguments& arguments);

}  // namespace contactcheck
