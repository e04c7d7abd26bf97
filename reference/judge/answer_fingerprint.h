// A hash of each answer instead of its records: enough to see whether the timed answer is the one
// that was judged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/semantics.h"

namespace contactcheck::judge {

/// One number for each list of an answer, indexed by ContactList.
using ListNumbers = std::array<std::uint64_t, kContactLists>;

/// A question, and how much of its answer is judged.
struct Asked {
  Question question = Question::kTriangles;
  bool own = true;                             ///< the detector's first
  std::array<bool, kContactLists> about = {};  ///< lists that are judged by this answer
};
Asked asked(Question question, const Semantics& semantics);

/// For each list that is judged: its number of records and a hash of them. For contacts (depths and
/// normals) only the number; all other lists stay 0.
struct AnswerFingerprint {
  ListNumbers sizes = {}, hashes = {};
};

/// @pre `contacts` is canonical
AnswerFingerprint fingerprint_of(const ContactSet& contacts, const Asked& asked);

/// The answers to one question, by frame.
struct JudgedQuestion {
  Question question = Question::kTriangles;
  std::vector<AnswerFingerprint> frames;
};
/// Indexed as the detector's questions are.
using JudgedAnswers = std::vector<JudgedQuestion>;

/// How `answer` differs from `judged` (numbers of contacts do if the larger one is above 8 and
/// twice the other): "it answered 0 pairs of triangles and not the 12 that were judged"; or "".
std::string answer_difference(const AnswerFingerprint& answer, const AnswerFingerprint& judged);

}  // namespace contactcheck::judge
