// Which scenes or detectors a rule is about.
#pragma once

#include <string>
#include <vector>

namespace contactcheck {

/// Shell patterns (fnmatch: `*`, `?`, `[...]`) for whole names; one that begins with '!' takes
/// names out again. `*` also stands for ':', '=' and ','.
struct Patterns {
  std::vector<std::string> wanted;    ///< at least one
  std::vector<std::string> unwanted;  ///< without their '!'

  bool hold(const std::string& name) const;
};

bool matches(const std::string& pattern, const std::string& name);

}  // namespace contactcheck
