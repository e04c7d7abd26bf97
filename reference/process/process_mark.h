// Finding what a process has started, wherever it has gone since: into a session of its own, to
// another parent, out of its group.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace contactcheck::process {

/// A word in the environment of a process. All that it starts inherits the word, unless it wipes
/// its environment on purpose.
class ProcessMark {
 public:
  /// A new one, beside those that this process bears itself.
  ProcessMark();
  ProcessMark(const ProcessMark&) = delete;
  ProcessMark& operator=(const ProcessMark&) = delete;

  /// This process's environment with the mark, as exec takes it; lives as long as this.
  char** environment() { return pointers_.data(); }

  /// Ends every process that bears it, and those that they start meanwhile.
  void kill_bearers() const;

 private:
  std::string word_;
  std::uint64_t made_;  ///< clock ticks since the machine was started
  std::vector<std::string> variables_;
  std::vector<char*> pointers_;  ///< of variables_, ended by a null pointer
};

}  // namespace contactcheck::process
