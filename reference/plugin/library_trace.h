// What a plug-in reports of its work by the C interface: the stages and counters of a frame. It may
// report anything; what is passed on names only bodies and elements that exist, and has the same
// shape in every frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "reference/plugin/contactcheck_plugin.h"

namespace contactcheck::plugin {

/// The stages of one detector, frame after frame.
class TraceCollector {
 public:
  /// For one call of the plug-in's trace(): forgets the frame before. Lives as long as this.
  contactcheck_trace sink();
  /// What was said in that call. `bodies`: those of prepare().
  /// @throws std::runtime_error: one sentence with the stage and what cannot be so
  StageTrace checked(std::span<const contactcheck_body> bodies);

 private:
  static void add_stage(void* host, const contactcheck_stage* stage) noexcept;
  static void add_owners(void* host, std::uint32_t body, const std::uint32_t* cells,
                         std::size_t count) noexcept;
  void check_shape();

  StageTrace frame_;
  std::vector<std::uint32_t> covers_;   ///< per stage, as it was said
  std::uint64_t bodies_of_owners_ = 0;  ///< as many as there must be for what owners() named
  bool too_many_ = false;
  std::vector<std::string> shape_;  ///< names and units of the first frame's stages
  bool has_shape_ = false;
};

/// The counters of one detector, frame after frame.
class CountsCollector {
 public:
  contactcheck_counts sink();  ///< as of TraceCollector
  /// @throws std::runtime_error: one sentence with the name and what cannot be so
  std::vector<Count> checked();

 private:
  static void add(void* host, const char* name, std::uint64_t value) noexcept;

  std::vector<Count> frame_;
  std::vector<std::string> names_;  ///< of the first frame
  bool has_names_ = false;
};

/// By a plug-in's own clock, nanoseconds; none below 0.
/// @throws std::runtime_error for what is no time
std::optional<double> reported_ns_of(double milliseconds);

}  // namespace contactcheck::plugin
