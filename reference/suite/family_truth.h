// The exact answer to every case of a family, and the file that keeps the answers
// (fixtures/hard/expected.json): written by an explicit command alone, so that a change of the
// oracle or of a family shows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "reference/scene/scene.h"

namespace contactcheck::suite {

/// The ground truth of one case.
struct CaseTruth {
  std::string value;                   ///< of the parameter, as the family writes it
  std::size_t bodies = 0;              ///< pairs of bodies whose surfaces share a point
  std::size_t containment = 0;         ///< pairs of bodies of which one holds the other
  std::vector<ElementPair> triangles;  ///< canonical
  std::vector<SelfPair> self;          ///< canonical, of the levels that the family judges
  std::string hash;  ///< chain_hash of bodies, triangles and pairs of one body, from 0
};

/// As the file keeps it: counts and hash stand for the pairs.
struct ExpectedCase {
  std::string value;
  std::size_t bodies = 0, containment = 0, triangles = 0, self = 0;
  std::string hash;

  bool operator==(const ExpectedCase&) const = default;
};

ExpectedCase summary_of(const CaseTruth& truth);

/// By the oracle, in the order of the values. @pre the scene is a family
std::vector<CaseTruth> family_truth(const scene::Scene& scene);

using ExpectedFamilies = std::map<std::string, std::vector<ExpectedCase>>;  ///< by family's id

/// @throws InputError with the path and what is wrong
ExpectedFamilies read_expected(const std::filesystem::path& file);

/// Under a temporary name, then renamed. @throws InputError with the path when it cannot be
void write_expected(const std::filesystem::path& file, const ExpectedFamilies& families);

}  // namespace contactcheck::suite
