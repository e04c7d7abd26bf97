// Detectors of one family share one colour and one name in legends.
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
/// The last group is for detectors of no other group. Colours are those of the HTML report
/// (web/src/groups.ts, web/src/style/colours.css).
const DetectorGroup& detector_group(std::size_t index);
std::size_t group_of(const std::string& detector);

}  // namespace contactcheck::report
