#include "reference/gate/pattern.h"

#include <fnmatch.h>

#include <algorithm>

namespace contactcheck {

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool Patterns::hold(const std::string& name) const {
  const auto fits = [&](const std::string& pattern) { return matches(pattern, name); };
  return std::any_of(wanted.begin(), wanted.end(), fits) &&
         std::none_of(unwanted.begin(), unwanted.end(), fits);
}

}  // namespace contactcheck
