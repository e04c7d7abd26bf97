// Asks a plug-in what it is, in a separate process: whatever its code does, this program goes on.
#pragma once

#include <filesystem>

#include "reference/plugin/plugin.h"
#include "reference/suite/job.h"

namespace contactcheck::plugin {

/// Loads or starts it in a child (`executable`: this program, for its hidden subcommand `examine`)
/// within the limits of `settings`, at most 30 seconds.
/// @throws InputError, one sentence: it cannot be loaded, speaks another version, declares what
/// makes no sense, crashes, hangs; Interrupted
Plugin examine_plugin(const PluginSource& source, const std::filesystem::path& executable,
                      const suite::RunSettings& settings);

/// The child's side: writes what the plug-in says, or what is wrong with it, to the descriptor
/// `answer_fd`. Returns the exit code.
int run_examination(const PluginSource& source, int answer_fd);

}  // namespace contactcheck::plugin
