// The body prefilter: with boxes of lattice nodes every detector answers as without, and what may
// be left out is left out.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/types/check.h"
#include "reference/adapters/body_pair_detector.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<std::string> kPrefiltered = {"embree",         "fcl-aabb",
                                               "fcl-obbrss",     "fcl-collide",
                                               "bullet-gimpact", "bullet-vf",
                                               "bullet-cl",      "bullet-vf:margin=0.05",
                                               "bullet-cl:k=8",  "bullet-gimpact:margin=0.02"};

std::string with_prefilter(const std::string& name) {
  return name + (name.find(':') == std::string::npos ? ":" : ",") + "prefilter=nodes";
}

/// Five balls in lattices and one without, in a row with gaps and overlaps.
struct Balls {
  Balls() {
    const Body ball = make_body("ball", sphere_mesh(Vec3::Zero(), 1, 3), {4, 4, 4});
    bodies = {ball, ball, ball, ball, ball};
    bodies.push_back({"bare", make_bare_shape(sphere_mesh(Vec3::Zero(), 0.7, 2))});
  }
  /// Deformed by a quadratic term, `gap` between the surfaces of the first two; others follow.
  FrameData frame(double gap) const {
    std::vector<std::vector<Vec3>> nodes;
    const double at[] = {0.0, 2.0 + gap, 7.0, 8.7, 30.0, 9.9};
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      nodes.push_back(rest_nodes_at(*bodies[b].shape, Vec3::Zero()));
      for (Vec3& n : nodes.back()) {
        if (b != 0 && b != 1) n.y() += 0.1 * n.x() * n.x();
        n.x() += at[b];
      }
    }
    return make_frame(bodies, std::move(nodes));
  }
  std::vector<Body> bodies;
};

Frame without_vertices(Frame frame) {
  for (BodyState& body : frame.bodies) body.vertices = {};
  return frame;
}

void expect_same(const ContactSet& a, const ContactSet& b, const std::string& what) {
  EXPECT_EQ(a.bodies, b.bodies) << what;
  EXPECT_EQ(a.triangles, b.triangles) << what;
  EXPECT_EQ(a.vertices, b.vertices) << what;
  EXPECT_EQ(a.near, b.near) << what;
  EXPECT_EQ(a.piece_contacts.size(), b.piece_contacts.size()) << what;
}

// A library that finds nothing and keeps which bodies it was given.
class Given : public adapters::BodyPairDetector {
 public:
  explicit Given(adapters::Prefilter prefilter) : BodyPairDetector(prefilter) {}
  const Semantics& semantics() const override { return semantics_; }
  void prepare(const std::vector<Body>& all) override { set_bodies(all); }

  std::vector<std::uint32_t> bodies;

 private:
  void move(std::span<const adapters::CandidateBody> given) override {
    bodies.clear();
    for (const adapters::CandidateBody& body : given) bodies.push_back(body.body);
  }
  void collide(BodyPair, Question, ContactSet&) override {}
  Semantics semantics_;
};

// So that a reference does no work that a simulator would spare it.
TEST(Prefilter, BodiesWhoseBoxesMeetNoOtherAreNotGivenToTheLibrary) {
  const Balls balls;
  const FrameData apart = balls.frame(0.5), touching = balls.frame(-0.1);
  for (const auto by : {adapters::Prefilter::kNone, adapters::Prefilter::kNodes}) {
    Given library(by);
    library.prepare(balls.bodies);
    library.update(apart.frame());
    EXPECT_THAT(library.bodies, ElementsAre(2, 3, 5));
    library.update(touching.frame());
    EXPECT_THAT(library.bodies, ElementsAre(0, 1, 2, 3, 5));
  }
}

TEST(Prefilter, AnswersAreThoseWithoutIt) {
  const Balls balls;
  for (const std::string& name : kPrefiltered) {
    const auto plain = make_detector(name), filtered = make_detector(with_prefilter(name));
    EXPECT_TRUE(plain->needs_vertices()) << name;
    EXPECT_FALSE(filtered->needs_vertices()) << name;
    plain->prepare(balls.bodies);
    filtered->prepare(balls.bodies);
    std::size_t found = 0;
    // Also back to an earlier frame, after others in which bodies were left out.
    for (const double gap : {-0.2, 0.5, 1e-3, -1e-3, 0.0, -0.2}) {
      const FrameData data = balls.frame(gap);
      plain->update(data.frame());
      filtered->update(without_vertices(data.frame()));
      for (const Question question : plain->semantics().questions) {
        const std::string what = name + " " + name_of(question) + " " + std::to_string(gap);
        const ContactSet expected = ask(*plain, question), got = ask(*filtered, question);
        expect_same(expected, got, what);
        found += expected.bodies.size();
      }
    }
    EXPECT_GT(found, 5u) << name;
  }
}

// Boxes of two bodies that touch in a point: neither prefilter may lose it.
TEST(Prefilter, BodiesThatOnlyTouchAreKept) {
  const Body cube = make_body("cube", unit_box_mesh(2), {1, 1, 1}, 0.5);
  const std::vector<Body> bodies = {cube, cube};
  const FrameData data = make_frame(bodies, {rest_nodes_at(*cube.shape, Vec3::Zero()),
                                             rest_nodes_at(*cube.shape, Vec3(1, 1, 1))});
  for (const std::string name :
       {"embree", "embree:prefilter=nodes", "fcl-aabb", "fcl-aabb:prefilter=nodes"}) {
    const auto detector = make_detector(name);
    detector->prepare(bodies);
    detector->update(data.frame());
    EXPECT_THAT(ask(*detector, Question::kBody).bodies, ::testing::ElementsAre(BodyPair{0, 1}))
        << name;
  }
}

// Bullet's margins reach across a gap that boxes of vertices do not.
TEST(Prefilter, MarginsGrowTheBoxes) {
  const World world({unit_box_mesh(2), box_mesh(Vec3(1.06, 0, 0), Vec3(2, 1, 1), 2)});
  for (const std::string name : {"bullet-vf:margin=0.05", "bullet-cl:margin=0.05",
                                 "bullet-vf:margin=0.05,prefilter=nodes"}) {
    EXPECT_THAT(ask(name, world, Question::kBody).bodies, ::testing::ElementsAre(BodyPair{0, 1}))
        << name;
  }
  EXPECT_THAT(ask("bullet-vf:margin=0.02", world, Question::kBody).bodies, IsEmpty());
}

// A body that is apart is refused all the same: whether a scene is refused must not hang on where
// its bodies are.
TEST(Prefilter, NodesThatAreNotFiniteAreRefused) {
  const Balls balls;
  for (const std::string& name : kPrefiltered) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const auto detector = make_detector(with_prefilter(name));
      detector->prepare(balls.bodies);
      FrameData data = balls.frame(0.5);
      data.nodes[4][3].z() = bad;
      EXPECT_THROW(detector->update(data.frame()), RefusedInput) << name;
    }
  }
}

}  // namespace
}  // namespace contactcheck::test
