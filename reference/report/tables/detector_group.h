// Detectors of one family have one colour and one name in legends.
#pragma once

#include <cstddef>
#include <string>

namespace contactcheck::report {

struct DetectorGroup {
  const char* name;
  const char* light;  ///< colour on white, as in CSS
  const char* dark;   ///< on black
};

inline constexpr std::size_t kDetectorGroups = 9;
/// The last one is of detectors that no other is for. Colours are those of the HTML report
/// (web/src/groups.ts, web/src/style/colours.css).
const DetectorGroup& detector_group(std::size_t index);
std::size_t group_of(const std::string& detector);

}  // namespace contactcheck::report
