// Holds the answers to a variant, read in the subject's names, against what they must be.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/metamorphic/relations.h"

namespace contactcheck::test {

struct Outcome {
  std::size_t frames = 0;     ///< that were asked about
  std::size_t skipped = 0;    ///< frames of which the variant would lose a bit
  std::size_t elements = 0;   ///< that were expected, over all frames and questions
  std::size_t differing = 0;  ///< answers
  std::string differences;    ///< for a reader, of the first few: which frame, pairs
  std::uint64_t expected_hash = 0, found_hash = 0;  ///< contact hashes, chained over frames

  void add(const Outcome& other);
};

/// A relation applied to a subject, for any number of detectors.
class RelationCase {
 public:
  RelationCase(const Relation& relation, std::shared_ptr<const Subject> subject);

  const Variant& variant() const { return variant_; }
  /// What must come out is the oracle's answer to the plain frames. @throws as the detector does
  Outcome against_truth(const Maker& make);
  /// What must come out is what the detector itself says about the plain frames: for those that are
  /// not exact. @throws as the detector does
  Outcome against_own(const Maker& make) const;

 private:
  Outcome against(const Maker& make, Detector& detector,
                  const std::vector<Answers>& expected) const;

  Calls calls_;
  Variant variant_;
  std::vector<ContactSet> truth_;  // per frame, once asked for
};

}  // namespace contactcheck::test
