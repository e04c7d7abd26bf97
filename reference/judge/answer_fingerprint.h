// What an answer was, without its records: enough to tell whether the answer that was timed is the
// one that was judged.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/contact_set.h"
#include "core/types/semantics.h"

namespace contactcheck::judge {

/// A number for each list of an answer, by ContactList.
using ListNumbers = std::array<std::uint64_t, kContactLists>;

/// A question, and how much of its answer is judged.
struct Asked {
  Question question = Question::kTriangles;
  bool own = true;                             ///< the detector's first
  std::array<bool, kContactLists> about = {};  ///< lists that are judged by this answer
};
Asked asked(Question question, const Semantics& semantics);

/// Per list that an answer is judged by, how many records it has and which; nothing of the others.
/// Of contacts the number alone, and that roughly.
struct AnswerFingerprint {
  ListNumbers sizes = {}, hashes = {};
};

/// @pre `contacts` is canonical
AnswerFingerprint fingerprint_of(const ContactSet& contacts, const Asked& asked);

/// Per frame, the answers to one question.
struct JudgedQuestion {
  Question question = Question::kTriangles;
  std::vector<AnswerFingerprint> frames;
};
/// In the order of the detector's questions.
using JudgedAnswers = std::vector<JudgedQuestion>;

/// Where `answer` is not `judged` (of contacts: has more than 8 where the other has less than
/// half): "it answered 0 pairs of triangles and not the 12 that were judged"; "" where it is.
std::string answer_difference(const AnswerFingerprint& answer, const AnswerFingerprint& judged);

}  // namespace contactcheck::judge
