// The suite itself, of steps: a detector with a fault seeded into it is caught, by the check that
// is there for this fault.
#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <limits>

#include "tests/conformance/detectors.h"
#include "tests/conformance/lifecycle.h"

namespace contactcheck {
namespace {

using test::Findings;
using test::Maker;
using test::Moment;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Key;

using Spoil = void (*)(Question, ContactSet&);

/// The ends of a step that a detector looks at.
enum class Ends { kBoth, kStart, kEnd, kEachAlone };

/// full-refit with its answers about steps spoiled.
class SpoiledSteps : public Detector {
 public:
  SpoiledSteps(Ends ends, Spoil spoil) : ends_(ends), spoil_(spoil) {}

  const Semantics& semantics() const override { return detector_->semantics(); }
  bool needs_vertices() const override { return detector_->needs_vertices(); }
  void prepare(const std::vector<Body>& bodies) override { detector_->prepare(bodies); }
  void update(const Frame& frame) override { detector_->update(frame); }
  void update_step(const Step& step) override { step_ = step; }
  void query(Question question, ContactSet& out) override {
    ask_of({ends_ == Ends::kEnd ? step_.end : step_.start,
            ends_ == Ends::kBoth || ends_ == Ends::kEnd ? step_.end : step_.start},
           question, out);
    if (ends_ == Ends::kEachAlone) ask_of({step_.end, step_.end}, question, out);
    out.canonicalize();
    spoil_(question, out);
  }

 private:
  void ask_of(const Step& step, Question question, ContactSet& out) {
    detector_->update_step(step);
    detector_->query(question, out);
  }

  std::unique_ptr<Detector> detector_ = test::make_detector("full-refit");
  Ends ends_;
  Spoil spoil_;
  Step step_;
};

const test::Case& case_of(const std::string& name) {
  for (const test::Case& c : test::step_cases())
    if (c.name == name) return c;
  throw std::logic_error("no case " + name);
}

void leave(Question, ContactSet&) {}

Findings findings_of(const std::string& name, Ends ends, Spoil spoil = leave) {
  return test::observe_steps([=] { return std::make_unique<SpoiledSteps>(ends, spoil); },
                             case_of(name))
      .findings;
}

TEST(StepFaults, AreNoneOfADetectorWithoutOne) {
  for (const test::Case& c : test::step_cases())
    EXPECT_THAT(findings_of(c.name, Ends::kBoth), IsEmpty()) << c.name;
}

// Which end is left out shows where contact is at that end alone.
TEST(StepFaults, OfAnEndThatIsLeftOutAreFound) {
  for (const char* level : {"impact missed", "impact-vf missed", "impact-triangle missed"}) {
    EXPECT_THAT(findings_of("step-crossing", Ends::kStart), Contains(Key(level)));
    EXPECT_THAT(findings_of("step-touch-vertex-face", Ends::kStart), Contains(Key(level)));
    EXPECT_THAT(findings_of("step-touch-vertex-face", Ends::kEnd), Contains(Key(level)));
  }
  EXPECT_THAT(findings_of("step-touch-edge-edge", Ends::kStart), Contains(Key("impact-ee missed")));
  EXPECT_THAT(findings_of("step-touch-edge-edge", Ends::kEnd), Contains(Key("impact-ee missed")));
  EXPECT_THAT(findings_of("step-own-triangles", Ends::kStart),
              IsSupersetOf({Key("impact-self-vf missed"), Key("impact-self-ee missed")}));
}

TEST(StepFaults, OfBodiesThatTunnelAreFound) {
  for (const char* name : {"step-tunnel", "step-tunnel-fast", "step-graze", "step-bare-triangles"})
    EXPECT_THAT(findings_of(name, Ends::kEachAlone), Contains(Key("impact missed"))) << name;
  EXPECT_THAT(findings_of("step-touch-vertex-face", Ends::kEachAlone),
              ::testing::Not(Contains(Key("impact missed"))))
      << "an end tells of this one";
}

// By a time that all pairs of bodies get.
template <typename Test>
void expect_found(double time, const Test& is_as_expected) {
  static double given;
  given = time;
  EXPECT_THAT(findings_of("step-crossing", Ends::kBoth,
                          [](Question, ContactSet& set) {
                            for (BodyImpact& impact : set.impacts) impact.time = given;
                          }),
              is_as_expected)
      << time;
}

TEST(StepFaults, OfTimesAreFound) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double time : {1.5, -0.25, 1 + 0x1p-52, -0x1p-60, kInfinity, -kInfinity,
                            std::numeric_limits<double>::quiet_NaN()})
    expect_found(time, Contains(Key("unusable time")));
  expect_found(0.5, IsEmpty());
  expect_found(0.5 + 0x1p-30, ElementsAre(Key("time late")));
  expect_found(0.5 - 0x1p-30, ElementsAre(Key("time early")));
  expect_found(1.0, ElementsAre(Key("time late")));
  expect_found(0.0, ElementsAre(Key("time early")));
  EXPECT_THAT(findings_of("step-crossing", Ends::kBoth,
                          [](Question, ContactSet& set) {
                            for (BodyImpact& impact : set.impacts) impact.time = std::nullopt;
                          }),
              IsEmpty())
      << "none needs to be reported";
}

TEST(StepFaults, OfTheAnswerAreFound) {
  const auto found = [](Spoil spoil) { return findings_of("step-crossing", Ends::kBoth, spoil); };
  EXPECT_EQ(found([](Question, ContactSet& set) {
              if (!set.impact_triangles.empty()) set.impact_triangles.pop_back();
            }),
            (Findings{{"impact-triangle missed", 1}}));
  EXPECT_EQ(found([](Question question, ContactSet& set) {
              if (question == Question::kImpacts) set.impact_vertices.push_back({1, 0, 0, 0});
            }),
            (Findings{{"impact-vf spurious", 1}}));
  EXPECT_EQ(found([](Question question, ContactSet& set) {
              if (question == Question::kSelfImpacts) set.self_impact_edges.push_back({0, 0, 1});
            }),
            (Findings{{"impact-self-ee spurious", 1}}));
  EXPECT_EQ(found([](Question question, ContactSet& set) {
              if (question == Question::kSelfImpacts) set.impacts.push_back({{0, 1}, 0.5});
            }),
            (Findings{{"list of another question", 1}}));
  EXPECT_EQ(found([](Question question, ContactSet& set) {
              if (question == Question::kImpacts) set.bodies.push_back({0, 1});
            }),
            (Findings{{"list of another question", 1}}));
}

// An octahedron has 6 vertices, 8 triangles and 12 edges.
TEST(StepFaults, OfIdsAreFound) {
  const auto found = [](Spoil spoil) { return findings_of("step-crossing", Ends::kBoth, spoil); };
  for (const Spoil spoil : {+[](Question, ContactSet& set) {
                              set.impacts.push_back({{0, 2}, 0.5});
                            },
                            +[](Question, ContactSet& set) {
                              set.impacts.push_back({{1, 1}, 0.5});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_triangles.push_back({0, 1, 8, 0});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_triangles.push_back({0, 1, 0, 8});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_vertices.push_back({0, 1, 6, 0});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_vertices.push_back({1, 0, 0, 8});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_edges.push_back({0, 1, 12, 0});
                            },
                            +[](Question, ContactSet& set) {
                              set.impact_edges.push_back({0, 1, 0, 12});
                            },
                            +[](Question, ContactSet& set) {
                              set.self_impact_vertices.push_back({0, 1, 0, 0});
                            },
                            +[](Question, ContactSet& set) {
                              set.self_impact_vertices.push_back({0, 0, 6, 0});
                            },
                            +[](Question, ContactSet& set) {
                              set.self_impact_edges.push_back({0, 3, 3});
                            },
                            +[](Question, ContactSet& set) {
                              set.self_impact_edges.push_back({0, 0, 12});
                            },
                            +[](Question, ContactSet& set) {
                              set.self_impact_edges.push_back({2, 0, 1});
                            }})
    EXPECT_THAT(found(spoil), Contains(Key("invalid id")));
}

TEST(StepFaults, OfTheFloatingPointEnvironmentAreFoundAndUndone) {
  EXPECT_THAT(findings_of("step-crossing", Ends::kBoth,
                          [](Question, ContactSet&) { std::fesetround(FE_UPWARD); }),
              Contains(Key("floating-point environment")));
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

enum class StepFault {
  kNone,
  kIgnoresUpdates,      // after the first one
  kLagsBehind,          // answers about the step before
  kKeepsItsStart,       // takes the first step's start for that of all
  kKeepsItsContacts,    // of earlier steps
  kForgetsAfterQuery,   // answers only once per update
  kClears,              // what the caller had
  kDisturbsOthers,      // loses a pair while there is another instance
  kDependsOnOrder,      // of the bodies
  kWornByPreparing,     // loses a pair in its second scene
  kWornByFrames,        // loses a pair after a frame
  kRebuildsWrongly,     // loses a pair when prepared on other rest shapes
  kKeepsTheCallersStep  // looks at it when it is asked
};

/// full-refit with a fault in the way that it is driven.
class FaultySteps : public Detector {
 public:
  explicit FaultySteps(StepFault fault) : fault_(fault) { ++alive_; }
  ~FaultySteps() override { --alive_; }

  const Semantics& semantics() const override { return detector_->semantics(); }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<Body>& bodies) override {
    ++prepared_;
    updated_ = false;
    bare_ = !bodies.empty() && !bodies.front().shape->lattice;
    detector_->prepare(bodies);
  }
  void update(const Frame& frame) override {
    framed_ = true;
    detector_->update(frame);
  }
  void update_step(const Step& step) override;
  void query(Question question, ContactSet& out) override;

 private:
  using Places = std::array<test::FrameData, 2>;

  static test::FrameData copy_of(const Frame& frame);
  bool loses() const;

  StepFault fault_;
  std::unique_ptr<Detector> detector_ = test::make_detector("full-refit");
  int prepared_ = 0;
  bool bare_ = false, updated_ = false, queried_ = false, framed_ = false;
  const Step* callers_ = nullptr;
  // Copies: a fault may ask about a step that its owner has let go.
  Places last_, shown_;
  std::vector<NearPair> kept_;
  static inline std::atomic<int> alive_ = 0;
};

test::FrameData FaultySteps::copy_of(const Frame& frame) {
  test::FrameData data;
  for (const BodyState& body : frame.bodies) {
    data.nodes.emplace_back(body.nodes.begin(), body.nodes.end());
    data.vertices.emplace_back(body.vertices.begin(), body.vertices.end());
  }
  return data;
}

void FaultySteps::update_step(const Step& step) {
  queried_ = false;
  callers_ = &step;
  if (fault_ == StepFault::kIgnoresUpdates && updated_) return;
  const Places before = last_;
  last_ = {copy_of(step.start), copy_of(step.end)};
  if (fault_ == StepFault::kKeepsItsStart && updated_) last_[0] = before[0];
  shown_ = fault_ == StepFault::kLagsBehind && updated_ ? before : last_;
  updated_ = true;
}

bool FaultySteps::loses() const {
  return fault_ == StepFault::kDependsOnOrder ||
         (fault_ == StepFault::kDisturbsOthers && alive_ > 1) ||
         (fault_ == StepFault::kWornByPreparing && prepared_ > 1) ||
         (fault_ == StepFault::kWornByFrames && framed_) ||
         (fault_ == StepFault::kRebuildsWrongly && bare_);
}

void FaultySteps::query(Question question, ContactSet& out) {
  if (!is_of_steps(question)) return detector_->query(question, out);
  if (fault_ == StepFault::kForgetsAfterQuery && queried_) return;
  if (fault_ == StepFault::kClears) out.clear();
  ContactSet set;
  if (fault_ == StepFault::kKeepsTheCallersStep)
    shown_ = {copy_of(callers_->start), copy_of(callers_->end)};
  detector_->update_step({shown_[0].frame(), shown_[1].frame()});
  detector_->query(question, set);
  set.canonicalize();
  if (fault_ == StepFault::kKeepsItsContacts) {
    kept_.insert(kept_.end(), set.impact_vertices.begin(), set.impact_vertices.end());
    if (question == Question::kImpacts) set.impact_vertices = kept_;
  }
  if (loses() && set.impact_vertices.size() > 1) set.impact_vertices.pop_back();
  queried_ = question == semantics().questions.back();
  for_each_list([](ContactList, auto& all,
                   const auto& some) { all.insert(all.end(), some.begin(), some.end()); },
                out, set);
}

/// The checks of steps that find something.
std::vector<std::string> finders_among_steps(StepFault fault) {
  const Maker make = [fault] { return std::make_unique<FaultySteps>(fault); };
  std::vector<std::string> names;
  for (const test::LifecycleCheck& check : test::lifecycle_checks(Moment::kStep)) {
    // Without a step of its own that outlives the call, this fault reads memory that is gone.
    if (fault == StepFault::kKeepsTheCallersStep && check.name != "step-of-the-call-alone")
      continue;
    if (!test::guarded([&] { return check.run(make, Moment::kStep); }).findings.empty())
      names.push_back(check.name);
  }
  return names;
}

TEST(StepFaults, OfTheLifecycleAreFoundByTheirChecks) {
  EXPECT_THAT(finders_among_steps(StepFault::kNone), IsEmpty());
  EXPECT_THAT(finders_among_steps(StepFault::kIgnoresUpdates),
              IsSupersetOf({"step-answers-follow-the-motion", "step-fresh-structure"}));
  EXPECT_THAT(finders_among_steps(StepFault::kLagsBehind),
              IsSupersetOf({"step-update-without-motion", "step-large-motion-and-back",
                            "steps-in-any-order", "step-fresh-structure"}));
  EXPECT_THAT(finders_among_steps(StepFault::kKeepsItsStart),
              IsSupersetOf({"step-large-motion-and-back", "step-fresh-structure"}));
  EXPECT_THAT(finders_among_steps(StepFault::kKeepsItsContacts), Contains("steps-in-any-order"));
  EXPECT_THAT(finders_among_steps(StepFault::kForgetsAfterQuery), Contains("step-repeated-query"));
  EXPECT_THAT(finders_among_steps(StepFault::kClears), ElementsAre("step-appended-answer"));
  EXPECT_THAT(finders_among_steps(StepFault::kDependsOnOrder), ElementsAre("step-swapped-bodies"));
  EXPECT_THAT(finders_among_steps(StepFault::kDisturbsOthers),
              ElementsAre("step-two-threads", "step-swapped-bodies"));
  EXPECT_THAT(finders_among_steps(StepFault::kWornByPreparing), ElementsAre("step-prepare-again"));
  EXPECT_THAT(finders_among_steps(StepFault::kWornByFrames), ElementsAre("step-frames-between"));
  EXPECT_THAT(finders_among_steps(StepFault::kRebuildsWrongly), Contains("step-rebuilt-structure"));
  EXPECT_THAT(finders_among_steps(StepFault::kKeepsTheCallersStep),
              ElementsAre("step-of-the-call-alone"));
}

}  // namespace
}  // namespace contactcheck
