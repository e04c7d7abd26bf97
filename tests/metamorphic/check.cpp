#include "tests/metamorphic/check.h"

#include <algorithm>
#include <iterator>

#include "reference/oracle/oracle.h"

namespace contactcheck::test {
namespace {

constexpr std::size_t kDifferencesShown = 5, kPairsShown = 3;

std::string text(const BodyPair& p) { return std::to_string(p.a) + "-" + std::to_string(p.b); }
std::string text(const ElementPair& p) {
  return std::to_string(p.body_a) + ":" + std::to_string(p.a) + "-" + std::to_string(p.body_b) +
         ":" + std::to_string(p.b);
}
std::string text(const VertexInBody& v) {
  return std::to_string(v.body) + ":" + std::to_string(v.vertex) + " in " + std::to_string(v.in);
}
std::string text(const SelfPair& p) {
  return std::to_string(p.body) + ":" + std::to_string(p.a) + "-" + std::to_string(p.b);
}
std::string text(std::uint32_t body) { return std::to_string(body); }
std::string text(const NearPair& p) {
  return std::to_string(p.body) + ":" + std::to_string(p.vertex) + "-" + std::to_string(p.other) +
         ":" + std::to_string(p.triangle);
}

// " missing: 0:3-1:4, ... (17)", of what `from` has and `other` lacks.
template <typename Item>
std::string lacking(const char* how, const std::vector<Item>& from,
                    const std::vector<Item>& other) {
  std::vector<Item> items;
  std::set_difference(from.begin(), from.end(), other.begin(), other.end(),
                      std::back_inserter(items));
  if (items.empty()) return "";
  std::string out = std::string(" ") + how;
  for (std::size_t i = 0; i < std::min(items.size(), kPairsShown); ++i)
    out += (i > 0 ? ", " : " ") + text(items[i]);
  return out + " (" + std::to_string(items.size()) + ")";
}

template <typename Item>
std::string difference(const char* kind, const std::vector<Item>& expected,
                       const std::vector<Item>& found) {
  const std::string text = lacking("missing", expected, found) + lacking("added", found, expected);
  return text.empty() ? "" : std::string("; ") + kind + text;
}

// "" where the sets are the same.
std::string difference(const ContactSet& expected, const ContactSet& found) {
  return difference("bodies", expected.bodies, found.bodies) +
         difference("cells", expected.cells, found.cells) +
         difference("triangles", expected.triangles, found.triangles) +
         difference("vertices", expected.vertices, found.vertices) +
         difference("near", expected.near, found.near) +
         difference("self", expected.self, found.self) +
         difference("self-cell", expected.self_cells, found.self_cells) +
         difference("self-near", expected.self_near, found.self_near) +
         difference("bodies with themselves", expected.self_bodies, found.self_bodies);
}

std::size_t elements(const ContactSet& set) {
  return set.bodies.size() + set.cells.size() + set.triangles.size() + set.vertices.size() +
         set.near.size() + set.self.size() + set.self_cells.size() + set.self_near.size() +
         set.self_bodies.size();
}

std::vector<ContactSet> truth_of(const Subject& subject) {
  oracle::Oracle oracle(subject.bodies);
  oracle::WantedTruth wanted;
  wanted.self = true;
  std::vector<ContactSet> truth;
  for (std::size_t f = 0; f < subject.frames.size(); ++f)
    truth.push_back(oracle.judge(subject.frames[f].frame(f), wanted).surface);
  return truth;
}

// What an exact detector must say to the questions that it answers.
Answers answers_by_truth(const ContactSet& truth, const std::vector<Question>& questions) {
  Answers out;
  for (Question question : questions) {
    if (question == Question::kSelf) {
      out[question].self = truth.self;
      out[question].self_bodies = truth.self_bodies;
      continue;
    }
    out[question].bodies = truth.bodies;
    if (question != Question::kBody) out[question].triangles = truth.triangles;
  }
  return out;
}

// Compares one answer after the other and books what it finds.
class Comparison {
 public:
  explicit Comparison(const Names& names) : names_(names) {}

  void add(const std::string& where, const Answers& expected, const Answers& found) {
    for (const auto& [question, set] : expected) {
      const auto own = found.find(question);
      const ContactSet read =
          own == found.end() ? ContactSet{} : in_names_of_subject(own->second, names_);
      outcome.elements += elements(set);
      note(where + ", " + name_of(question), difference(set, read));
      outcome.expected_hash = chain_hash(outcome.expected_hash, outcome.frames, set);
      outcome.found_hash = chain_hash(outcome.found_hash, outcome.frames, read);
    }
  }

  Outcome outcome;

 private:
  void note(const std::string& where, const std::string& found) {
    if (found.empty()) return;
    if (outcome.differing++ < kDifferencesShown) outcome.differences += "\n  " + where + found;
  }

  const Names& names_;
};

std::unique_ptr<Detector> prepared(const Maker& make, const std::vector<Body>& bodies) {
  std::unique_ptr<Detector> detector = make();
  detector->prepare(bodies);
  return detector;
}

}  // namespace

void Outcome::add(const Outcome& other) {
  frames += other.frames;
  skipped += other.skipped;
  elements += other.elements;
  differing += other.differing;
  differences += other.differences;
  constexpr std::uint64_t kPrime = 0x100000001b3ull;  // in order: equal parts must not cancel
  expected_hash = expected_hash * kPrime + other.expected_hash;
  found_hash = found_hash * kPrime + other.found_hash;
}

RelationCase::RelationCase(const Relation& relation, std::shared_ptr<const Subject> subject)
    : calls_(relation.calls), variant_(relation.variant(std::move(subject))) {}

Outcome RelationCase::against(const Maker& make, Detector& detector,
                              const std::vector<Answers>& expected) const {
  Comparison comparison(variant_.names);
  for (std::size_t f = 0; f < variant_.frames.size(); ++f) {
    if (!variant_.frames[f]) {
      ++comparison.outcome.skipped;
      continue;
    }
    ++comparison.outcome.frames;
    for (const Answers& answers : calls_({make, detector, variant_}, f))
      comparison.add(variant_.plain->labels[f], expected[f], answers);
  }
  return comparison.outcome;
}

Outcome RelationCase::against_truth(const Maker& make) {
  if (truth_.empty()) truth_ = truth_of(*variant_.plain);
  const auto detector = prepared(make, variant_.bodies);
  std::vector<Answers> expected;
  for (const ContactSet& truth : truth_)
    expected.push_back(answers_by_truth(truth, questions_of_frames(detector->semantics())));
  return against(make, *detector, expected);
}

Outcome RelationCase::against_own(const Maker& make) const {
  const Names same = same_names(variant_.plain->bodies);
  const auto plain = prepared(make, variant_.plain->bodies);
  std::vector<Answers> expected;
  for (std::size_t f = 0; f < variant_.plain->frames.size(); ++f) {
    Answers& own = expected.emplace_back(ask(*plain, variant_.plain->frames[f], f));
    for (auto& [question, set] : own) set = in_names_of_subject(std::move(set), same);
  }
  return against(make, *prepared(make, variant_.bodies), expected);
}

}  // namespace contactcheck::test
