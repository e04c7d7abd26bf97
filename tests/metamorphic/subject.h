// What relations are about: bodies in some moments, the same put differently, and how to read the
// answer to the one as an answer to the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

struct Subject {
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
  std::vector<std::string> labels;  ///< per frame, for a reader: "hard-edge-edge@0x1p-52"
};

/// How the ids of a variant are called in the subject.
struct Names {
  std::vector<std::uint32_t> body;                   ///< [body of the variant]
  std::vector<std::vector<std::uint32_t>> triangle;  ///< [body of the variant][its triangle]
  std::vector<std::vector<std::uint32_t>> vertex;    ///< [body of the variant][its vertex]
};

/// Every id by itself.
Names same_names(const std::vector<Body>& bodies);

/// The set in the names of the subject, canonical. Cells keep their ids: no variant has other
/// lattices. @pre the set names only what the variant has
ContactSet in_names_of_subject(ContactSet set, const Names& names);

struct Variant {
  /// What it is held against: the subject, or the subject in positions that can be moved exactly.
  std::shared_ptr<const Subject> plain;
  std::vector<Body> bodies;
  std::vector<std::optional<FrameData>> frames;  ///< per frame of `plain`; none: would lose a bit
  Names names;
};

/// As it is: for relations of calls.
Variant unchanged(std::shared_ptr<const Subject> subject);

}  // namespace contactcheck::test
