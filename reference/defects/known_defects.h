// The wrong answers that other libraries are known to give to hard cases, as a file that people
// explain and a command fills: fixtures/hard/known-defects.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/defects/sightings.h"

namespace contactcheck {

/// One cause of wrong answers, in one version of one library.
struct KnownDefect {
  std::string library;   ///< as in results.json: "fcl"
  std::string version;   ///< the same: "0.7.0"
  std::string issue;     ///< who describes it: an issue's number or the place in the source
  SightingKind kind{};   ///< what it looks like
  std::string sentence;  ///< why
  /// Every case that shows it; sorted, all of this kind.
  std::vector<Sighting> seen;
};

struct KnownDefects {
  std::vector<KnownDefect> defects;
};

/// Does the defect already have sightings of that detector in that scene, of that kind? Then it is
/// the cause of all of them.
bool has_place_for(const KnownDefect& defect, const Sighting& sighting);

/// Issue and sentence of a defect that no person has looked at yet.
inline constexpr const char* kUnexplained = "not looked into yet";

/// A file that is missing is an empty list.
/// @throws InputError with file, place and value; also when two defects of one version
/// have the same detector, scene and kind
KnownDefects read_known_defects(const std::filesystem::path& file);

/// Under a temporary name, then renamed. @throws InputError with the path when it cannot be
void write_known_defects(const std::filesystem::path& file, const KnownDefects& known);

}  // namespace contactcheck
