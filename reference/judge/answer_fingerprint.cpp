#include "reference/judge/answer_fingerprint.h"

#include <algorithm>

#include "core/types/hash.h"
#include "reference/judge/judge.h"

namespace contactcheck::judge {
namespace {

enum List : std::size_t {
  kBodies,
  kCells,
  kTriangles,
  kVertices,
  kNear,
  kSelfBodies,
  kSelf,
  kSelfCells,
  kSelfNear,
  kPieces,
  kVertexContacts
};

constexpr const char* kRecords[kAnswerLists] = {"pairs of bodies",
                                                "pairs of cells",
                                                "pairs of triangles",
                                                "vertices in bodies",
                                                "near pairs",
                                                "bodies in contact with themselves",
                                                "pairs of one body's triangles",
                                                "pairs of one body's cells",
                                                "near pairs of one body",
                                                "contacts of pieces",
                                                "contacts of vertices"};

// What is judged of the answer (accuracy.h). A question `body` may end at the first pair of
// triangles that it finds: detectors do not claim which one.
bool is_compared(std::size_t list, const Asked& asked) {
  switch (list) {
    case kBodies:
      return asked.own || asked.question != Question::kContacts;
    case kCells:
    case kTriangles:
      return asked.question != Question::kBody &&
             (asked.own || asked.question != Question::kContacts);
    case kVertices:
    case kNear:
      return asked.vertices;
    case kSelfBodies:
    case kSelf:
    case kSelfCells:
    case kSelfNear:
      return asked.question == Question::kSelf;
    default:
      return asked.question == Question::kContacts;
  }
}

void feed(const BodyPair& p, Fnv1a& hash) {
  for (const std::uint32_t id : {p.a, p.b}) hash.value(id);
}
void feed(const ElementPair& p, Fnv1a& hash) {
  for (const std::uint32_t id : {p.body_a, p.body_b, p.a, p.b}) hash.value(id);
}
void feed(const VertexInBody& v, Fnv1a& hash) {
  for (const std::uint32_t id : {v.body, v.in, v.vertex}) hash.value(id);
}
void feed(const SelfPair& p, Fnv1a& hash) {
  for (const std::uint32_t id : {p.body, p.a, p.b}) hash.value(id);
}
void feed(std::uint32_t body, Fnv1a& hash) { hash.value(body); }
void feed(const NearPair& p, Fnv1a& hash) {
  for (const std::uint32_t id : {p.body, p.other, p.vertex, p.triangle}) hash.value(id);
}

// 0 of nothing.
template <typename Record>
std::uint64_t hash_of(const std::vector<Record>& records) {
  if (records.empty()) return 0;
  Fnv1a hash;
  for (const Record& record : records) feed(record, hash);
  return hash.digest();
}

// Of contacts none: see is_other_count().
std::uint64_t hash_of(const ContactSet& contacts, std::size_t list) {
  switch (list) {
    case kBodies:
      return hash_of(contacts.bodies);
    case kCells:
      return hash_of(contacts.cells);
    case kTriangles:
      return hash_of(contacts.triangles);
    case kVertices:
      return hash_of(contacts.vertices);
    case kNear:
      return hash_of(contacts.near);
    case kSelfBodies:
      return hash_of(contacts.self_bodies);
    case kSelf:
      return hash_of(contacts.self);
    case kSelfCells:
      return hash_of(contacts.self_cells);
    case kSelfNear:
      return hash_of(contacts.self_near);
    default:
      return 0;
  }
}

bool is_of_contacts(std::size_t list) { return list == kPieces || list == kVertexContacts; }

// Libraries that give depths are not always sure of themselves: FCL 0.7 has two contacts or none of
// a triangle that is a point, from call to call. Of contacts only a number of another size counts.
bool is_other_count(std::size_t list, std::uint64_t answered, std::uint64_t judged) {
  if (!is_of_contacts(list)) return answered != judged;
  constexpr std::uint64_t kFew = 8;
  const auto [fewer, more] = std::minmax(answered, judged);
  return more > kFew && 2 * fewer < more;
}

std::string count_difference(std::size_t list, std::uint64_t answered, std::uint64_t judged) {
  return "it answered " + std::to_string(answered) + " " + kRecords[list] + " and not the " +
         std::to_string(judged) + " that were judged";
}

AnswerSizes sizes_of(const ContactSet& c) {
  return {c.bodies.size(),    c.cells.size(),          c.triangles.size(),      c.vertices.size(),
          c.near.size(),      c.self_bodies.size(),    c.self.size(),           c.self_cells.size(),
          c.self_near.size(), c.piece_contacts.size(), c.vertex_contacts.size()};
}

}  // namespace

Asked asked(Question question, const Semantics& semantics) {
  return {question, question == semantics.questions.front(),
          question == question_of(Level::kVertex, semantics)};
}

AnswerFingerprint fingerprint_of(const ContactSet& contacts, const Asked& asked) {
  const AnswerSizes sizes = sizes_of(contacts);
  AnswerFingerprint out;
  for (std::size_t list = 0; list < kAnswerLists; ++list) {
    if (!is_compared(list, asked)) continue;
    out.sizes[list] = sizes[list];
    out.hashes[list] = hash_of(contacts, list);
  }
  return out;
}

std::string answer_difference(const AnswerFingerprint& answer, const AnswerFingerprint& judged) {
  // From the finest lists to the bodies that they imply.
  for (std::size_t list = kAnswerLists; list-- > 0;) {
    if (is_other_count(list, answer.sizes[list], judged.sizes[list]))
      return count_difference(list, answer.sizes[list], judged.sizes[list]);
    if (answer.hashes[list] != judged.hashes[list])
      return "it answered " + std::to_string(answer.sizes[list]) + " " + kRecords[list] +
             ", and others than those that were judged";
  }
  return "";
}

}  // namespace contactcheck::judge
