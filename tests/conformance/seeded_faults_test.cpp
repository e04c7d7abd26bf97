// The suite itself: a detector with a fault seeded into it is caught, by the check that is there
// for this fault.
#include <gmock/gmock.h>

#include <atomic>
#include <limits>

#include "tests/conformance/detectors.h"
#include "tests/conformance/lifecycle.h"

namespace contactcheck {
namespace {

using test::Findings;
using test::Maker;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Key;

using Spoil = void (*)(Question, ContactSet&);

/// FCL with its answers spoiled.
class Spoiled : public Detector {
 public:
  explicit Spoiled(Spoil spoil) : spoil_(spoil) {}

  const Semantics& semantics() const override { return detector_->semantics(); }
  bool needs_vertices() const override { return detector_->needs_vertices(); }
  void prepare(const std::vector<Body>& bodies) override { detector_->prepare(bodies); }
  void update(const Frame& frame) override { detector_->update(frame); }
  void query(Question question, ContactSet& out) override {
    detector_->query(question, out);
    spoil_(question, out);
  }

 private:
  std::unique_ptr<Detector> detector_ = test::make_detector("fcl-aabb");
  Spoil spoil_;
};

const test::Case& touching_tips() {
  static const test::Case scene = test::cases_of(test::CaseGroup::kTouching).front();
  return scene;
}

Findings findings_of(Spoil spoil) {
  return test::observe([spoil] { return std::make_unique<Spoiled>(spoil); }, touching_tips())
      .findings;
}

TEST(SeededFaults, OfTheAnswerAreFound) {
  EXPECT_THAT(findings_of([](Question, ContactSet&) {}), IsEmpty());
  EXPECT_EQ(findings_of([](Question, ContactSet& set) {
              if (!set.triangles.empty()) set.triangles.pop_back();
            }),
            (Findings{{"triangle missed", 1}, {"contradiction", 1}}));
  EXPECT_EQ(findings_of([](Question q, ContactSet& set) {
              if (q == Question::kTriangles || q == Question::kContacts)
                set.triangles.push_back({0, 1, 1, 1});
            }),
            (Findings{{"triangle spurious", 1}}));
  EXPECT_EQ(findings_of([](Question q, ContactSet& set) {
              if (q == Question::kBody) set.bodies.clear();
            }),
            (Findings{{"body missed", 1}, {"contradiction", 1}}));
  EXPECT_EQ(findings_of([](Question q, ContactSet& set) {
              if (q == Question::kContacts) set.triangles.pop_back();
            }),
            (Findings{{"contradiction", 1}}));
}

TEST(SeededFaults, OfIdsAreFound) {
  for (const ElementPair& bad : {ElementPair{0, 1, 8, 0}, ElementPair{0, 1, 0, 8},
                                 ElementPair{0, 2, 0, 0}, ElementPair{1, 1, 0, 0}}) {
    static ElementPair added;
    added = bad;
    EXPECT_THAT(findings_of([](Question q, ContactSet& set) {
                  if (q != Question::kBody) set.triangles.push_back(added);
                }),
                Contains(Key("invalid id")));
  }
  EXPECT_THAT(findings_of([](Question, ContactSet& set) {
                set.bodies.push_back({0, 2});
              }),
              Contains(Key("invalid id")));
  EXPECT_THAT(findings_of([](Question, ContactSet& set) {
                set.near.push_back({0, 1, 6, 0});
              }),
              Contains(Key("invalid id")));
  EXPECT_THAT(findings_of([](Question, ContactSet& set) {
                set.near.push_back({0, 1, 0, 8});
              }),
              Contains(Key("invalid id")));
}

TEST(SeededFaults, OfContactsAreFound) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [depth, normal] :
       {std::pair(-1.0, Vec3(1, 0, 0)), std::pair(kNaN, Vec3(1, 0, 0)),
        std::pair(1.0, Vec3(0, 0, 0)), std::pair(1.0, Vec3(0.6, 0.7, 0)),
        std::pair(1.0, Vec3(kNaN, 0, 0))}) {
    static PieceContact contact;
    contact.depth = depth;
    contact.normal = normal;
    EXPECT_EQ(findings_of([](Question q, ContactSet& set) {
                if (q != Question::kContacts) return;
                contact.pieces = set.triangles.front();
                set.piece_contacts.push_back(contact);
              }),
              (Findings{{"unusable contact", 1}}));
  }
  EXPECT_EQ(findings_of([](Question q, ContactSet& set) {
              if (q == Question::kContacts)
                set.piece_contacts.push_back({{0, 1, 1, 1}, 0.0, Vec3::UnitX()});
            }),
            (Findings{{"contradiction", 1}}));
}

enum class Fault {
  kNone,
  kIgnoresUpdates,     // after the first one
  kLagsBehind,         // answers about the frame before
  kKeepsItsContacts,   // of earlier frames
  kForgetsAfterQuery,  // answers only once per update
  kClears,             // what the caller had
  kDisturbsOthers,     // loses a pair while there is another instance
  kDependsOnOrder,     // of the bodies
  kWornByPreparing,    // loses a pair in its second scene
  kRebuildsWrongly     // loses a pair when prepared on other rest shapes
};

/// aabb-tree with a fault in the way that it is driven.
class Faulty : public Detector {
 public:
  explicit Faulty(Fault fault) : fault_(fault) { ++alive_; }
  ~Faulty() override { --alive_; }

  const Semantics& semantics() const override { return detector_->semantics(); }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<Body>& bodies) override {
    ++prepared_;
    updated_ = false;
    bare_ = !bodies.empty() && !bodies.front().shape->lattice;
    detector_->prepare(bodies);
  }
  void update(const Frame& frame) override;
  void query(Question question, ContactSet& out) override;

 private:
  void spoil(ContactSet& set);

  Fault fault_;
  std::unique_ptr<Detector> detector_ = test::make_detector("aabb-tree");
  int prepared_ = 0;
  bool bare_ = false, updated_ = false, queried_ = false;
  std::vector<std::vector<Vec3>> last_, shown_;
  std::vector<ElementPair> kept_;
  static inline std::atomic<int> alive_ = 0;
};

void Faulty::update(const Frame& frame) {
  queried_ = false;
  if (fault_ == Fault::kIgnoresUpdates && updated_) return;
  const std::vector<std::vector<Vec3>> before = last_;
  last_.clear();
  for (const BodyState& body : frame.bodies)
    last_.emplace_back(body.vertices.begin(), body.vertices.end());
  // Copies: a fault may ask about a frame that its owner has let go.
  shown_ = fault_ == Fault::kLagsBehind && updated_ ? before : last_;
  Frame used = frame;
  for (std::size_t b = 0; b < shown_.size(); ++b) used.bodies[b].vertices = shown_[b];
  updated_ = true;
  detector_->update(used);
}

void Faulty::query(Question question, ContactSet& out) {
  if (fault_ == Fault::kForgetsAfterQuery && queried_) return;
  if (fault_ == Fault::kClears) out.clear();
  ContactSet set;
  detector_->query(question, set);
  set.canonicalize();
  if (question != Question::kBody) spoil(set);
  queried_ = question == semantics().questions.back();
  out.bodies.insert(out.bodies.end(), set.bodies.begin(), set.bodies.end());
  out.triangles.insert(out.triangles.end(), set.triangles.begin(), set.triangles.end());
}

void Faulty::spoil(ContactSet& set) {
  if (fault_ == Fault::kKeepsItsContacts) {
    kept_.insert(kept_.end(), set.triangles.begin(), set.triangles.end());
    set.triangles = kept_;
  }
  const bool loses = fault_ == Fault::kDependsOnOrder ||
                     (fault_ == Fault::kDisturbsOthers && alive_ > 1) ||
                     (fault_ == Fault::kWornByPreparing && prepared_ > 1) ||
                     (fault_ == Fault::kRebuildsWrongly && bare_);
  // Never the only pair: the bodies are right, only the elements are not.
  if (loses && set.triangles.size() > 1) set.triangles.pop_back();
}

/// The lifecycle checks that find something.
std::vector<std::string> finders_of(const Maker& make) {
  constexpr auto kFrame = test::Moment::kFrame;
  std::vector<std::string> names;
  for (const test::LifecycleCheck& check : test::lifecycle_checks(kFrame))
    if (!test::guarded([&] { return check.run(make, kFrame); }).findings.empty())
      names.push_back(check.name);
  return names;
}

std::vector<std::string> finders_of(Fault fault) {
  return finders_of([fault] { return std::make_unique<Faulty>(fault); });
}

TEST(SeededFaults, OfTheLifecycleAreFoundByTheirChecks) {
  EXPECT_THAT(finders_of(Fault::kNone), IsEmpty());
  EXPECT_THAT(finders_of(Fault::kIgnoresUpdates),
              IsSupersetOf({"answers-follow-the-motion", "fresh-structure"}));
  EXPECT_THAT(finders_of(Fault::kLagsBehind),
              IsSupersetOf({"update-without-motion", "large-motion-and-back", "frames-in-any-order",
                            "fresh-structure"}));
  EXPECT_THAT(finders_of(Fault::kKeepsItsContacts), Contains("frames-in-any-order"));
  EXPECT_THAT(finders_of(Fault::kForgetsAfterQuery), Contains("repeated-query"));
  EXPECT_THAT(finders_of(Fault::kClears), ElementsAre("appended-answer"));
  EXPECT_THAT(finders_of(Fault::kDependsOnOrder), ElementsAre("swapped-bodies"));
  EXPECT_THAT(finders_of(Fault::kDisturbsOthers), ElementsAre("two-threads", "swapped-bodies"));
  EXPECT_THAT(finders_of(Fault::kWornByPreparing), ElementsAre("prepare-again"));
  EXPECT_THAT(finders_of(Fault::kRebuildsWrongly), ElementsAre("rebuilt-structure"));
}

}  // namespace
}  // namespace contactcheck
