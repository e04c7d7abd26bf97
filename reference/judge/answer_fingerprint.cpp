#include "reference/judge/answer_fingerprint.h"

#include <algorithm>

#include "core/types/hash.h"
#include "reference/judge/judge.h"

namespace contactcheck::judge {
namespace {

// In the order of ContactList.
constexpr const char* kRecords[kContactLists] = {"pairs of bodies",
                                                 "pairs of cells",
                                                 "pairs of triangles",
                                                 "vertices in bodies",
                                                 "near pairs",
                                                 "bodies in contact with themselves",
                                                 "pairs of one body's triangles",
                                                 "pairs of one body's cells",
                                                 "near pairs of one body",
                                                 "pairs of bodies within a step",
                                                 "pairs of triangles within a step",
                                                 "vertices with triangles within a step",
                                                 "pairs of edges within a step",
                                                 "vertices with triangles of their body",
                                                 "pairs of edges of one body",
                                                 "contacts of pieces",
                                                 "contacts of vertices"};

// What is judged of the answer (accuracy.h). A question `body` may end at the first pair of
// triangles that it finds: detectors do not claim which one.
bool is_compared(ContactList list, const Asked& asked) {
  switch (list) {
    case ContactList::kBodies:
      return asked.own || asked.question != Question::kContacts;
    case ContactList::kCells:
    case ContactList::kTriangles:
      return asked.question != Question::kBody &&
             (asked.own || asked.question != Question::kContacts);
    default:
      return asked.about[static_cast<std::size_t>(list)];
  }
}

void feed(std::uint32_t body, Fnv1a& hash) { hash.value(body); }
template <typename Record>
void feed(const Record& record, Fnv1a& hash) {
  for (const std::uint32_t id : record.ids()) hash.value(id);
}

// 0 of nothing.
template <typename Record>
std::uint64_t hash_of(const std::vector<Record>& records) {
  if (records.empty()) return 0;
  Fnv1a hash;
  for (const Record& record : records) feed(record, hash);
  return hash.digest();
}

// Contacts are compared only by their number: see is_other_count().
std::uint64_t hash_of(const std::vector<PieceContact>&) { return 0; }
std::uint64_t hash_of(const std::vector<VertexContact>&) { return 0; }

bool is_of_contacts(ContactList list) {
  return list == ContactList::kPieceContacts || list == ContactList::kVertexContacts;
}

// Libraries that give depths are not always sure of themselves: FCL 0.7 has two contacts or none of
// a triangle that is a point, from call to call. Of contacts only a number of another size counts.
bool is_other_count(std::size_t list, std::uint64_t answered, std::uint64_t judged) {
  if (!is_of_contacts(static_cast<ContactList>(list))) return answered != judged;
  constexpr std::uint64_t kFew = 8;
  const auto [fewer, more] = std::minmax(answered, judged);
  return more > kFew && 2 * fewer < more;
}

std::string count_difference(std::size_t list, std::uint64_t answered, std::uint64_t judged) {
  return "it answered " + std::to_string(answered) + " " + kRecords[list] + " and not the " +
         std::to_string(judged) + " that were judged";
}

}  // namespace

Asked asked(Question question, const Semantics& semantics) {
  Asked out{question, question == semantics.questions.front()};
  for (std::size_t list = 0; list < kContactLists; ++list)
    out.about[list] = question_about(static_cast<ContactList>(list), semantics) == question;
  return out;
}

AnswerFingerprint fingerprint_of(const ContactSet& contacts, const Asked& asked) {
  AnswerFingerprint out;
  for_each_list(
      [&](ContactList list, const auto& records) {
        if (!is_compared(list, asked)) return;
        const auto at = static_cast<std::size_t>(list);
        out.sizes[at] = records.size();
        out.hashes[at] = hash_of(records);
      },
      contacts);
  return out;
}

std::string answer_difference(const AnswerFingerprint& answer, const AnswerFingerprint& judged) {
  // From the finest lists to the bodies that they imply.
  for (std::size_t list = kContactLists; list-- > 0;) {
    if (is_other_count(list, answer.sizes[list], judged.sizes[list]))
      return count_difference(list, answer.sizes[list], judged.sizes[list]);
    if (answer.hashes[list] != judged.hashes[list])
      return "it answered " + std::to_string(answer.sizes[list]) + " " + kRecords[list] +
             ", and others than those that were judged";
  }
  return "";
}

}  // namespace contactcheck::judge
