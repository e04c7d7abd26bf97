#include "reference/report/tables/detector_group.h"

namespace contactcheck::report {
namespace {

// Okabe and Ito's palette, which all kinds of eyes tell apart, darkened on white and lightened on
// black for a contrast of at least 3 to 1.
constexpr DetectorGroup kGroups[kDetectorGroups] = {
    {"lazy and refitted tree", "#1c2127", "#e6edf3"},
    {"FFD with exact triangle test (+tri)", "#008060", "#22b58c"},
    {"FFD, node against plane (the paper)", "#c77700", "#f0a030"},
    {"FCL", "#0072b2", "#4a9fe0"},
    {"Embree", "#2f8fc4", "#7cc7ee"},
    {"Bullet", "#c64b00", "#f07a45"},
    {"libccd", "#b0568c", "#d98abb"},
    {"historic", "#9a8700", "#d8c840"},
    {"other", "#7a828a", "#9aa0a6"}};

struct Prefix {
  const char* text;
  std::size_t group;
};
constexpr Prefix kPrefixes[] = {
    {"ffd-lazy", 0}, {"full-refit", 0},   {"fcl", 3},       {"embree", 4},      {"bullet", 5},
    {"libccd", 6},   {"spatial-hash", 7}, {"aabb-tree", 7}, {"sphere-tree", 7}, {"bd-tree", 7}};

}  // namespace

const DetectorGroup& detector_group(std::size_t index) { return kGroups[index]; }

std::size_t group_of(const std::string& detector) {
  for (const Prefix& prefix : kPrefixes)
    if (detector.starts_with(prefix.text)) return prefix.group;
  if (!detector.starts_with("ffd-")) return kDetectorGroups - 1;
  const std::string id = detector.substr(0, detector.find(':'));
  return id.find("+tri") != std::string::npos ? 1 : 2;
}

}  // namespace contactcheck::report
