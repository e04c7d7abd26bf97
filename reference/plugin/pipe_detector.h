// A detector in a separate process, which reads frames and writes contacts over pipes.
#pragma once

#include <memory>
#include <string>

#include "core/detect/detector.h"
#include "core/detect/impact_detector.h"
#include "reference/plugin/declaration.h"

namespace contactcheck::plugin {

/// Starts the command and reads its handshake.
/// @throws InputError, std::runtime_error when it does not speak the protocol
Declaration declare_command(const std::string& command);

/// Starts the command; it ends with the detector. It must call itself `id`: a command that has
/// changed since it was asked is another detector. `options` has a value for each that it declares.
/// @throws InputError, std::runtime_error when it does not speak the protocol
std::unique_ptr<Detector> make_pipe_detector(const std::string& command, const std::string& id,
                                             const Options& options);

/// The same for queries of moving elements.
std::unique_ptr<ImpactDetector> make_pipe_impact_detector(const std::string& command,
                                                          const std::string& id,
                                                          const Options& options);

}  // namespace contactcheck::plugin
