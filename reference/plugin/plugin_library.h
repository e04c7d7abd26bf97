// A detector in a shared library that speaks the C interface of contactcheck_plugin.h.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/detect/registry.h"
#include "reference/plugin/contactcheck_plugin.h"
#include "reference/plugin/declaration.h"

namespace contactcheck::plugin {

/// A library that is loaded, of the right version and layout. It stays loaded: what it has started
/// may still run. @pre this process may die of it
class PluginLibrary {
 public:
  /// @throws InputError: the file, and why it cannot be used
  explicit PluginLibrary(const std::filesystem::path& file);

  /// As of the newest version: what the library's own does not have is null.
  const contactcheck_plugin& table() const { return table_; }
  const std::string& name() const { return name_; }
  /// Makes a detector with its default options to ask what it claims.
  /// @throws InputError when it fails, or what it says cannot be said
  Declaration declare() const;

 private:
  std::string name_;  ///< library "PATH"
  contactcheck_plugin table_ = {};
};

/// Makes the library's detector. `options` has a value for each that it declares.
/// @throws InputError, std::runtime_error when it fails
std::unique_ptr<Detector> make_library_detector(const PluginLibrary& library,
                                                const Options& options);

/// The same for queries of moving elements. With these options only its tolerance may be another
/// than `declared`.
std::unique_ptr<ImpactDetector> make_library_impact_detector(const PluginLibrary& library,
                                                             const Options& options,
                                                             const ImpactClaims& declared);

/// What it claims about them; none if it does not answer them.
std::optional<ImpactClaims> impact_claims_of(const PluginLibrary& library, const Options& options);

}  // namespace contactcheck::plugin
