// Scenes drawn from a seed: what they promise, judged by the oracle, and that they stay the same.
#include "reference/scene/drawn_scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "core/types/hash.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/step_truth.h"
#include "reference/scene/draw_rules.h"
#include "reference/text/file_text.h"
#include "tests/reference/scene/scratch.h"
#include "tests/reference/scene/small_draw_rules.h"
#include "tests/support/shapes.h"

namespace contactcheck::scene {
namespace {

DrawnSpec small_spec(std::uint64_t number, const std::string& shares = "") {
  DrawnSpec spec;
  spec.rules = shares.empty() ? test::small_draw_rules() : test::small_draw_rules(shares);
  spec.rules_name = "rules";
  spec.seed = 7;
  spec.number = number;
  return spec;
}

std::uint64_t frames_hash(const Scene& scene) {
  Fnv1a hash;
  for (std::size_t f = 0; f < scene.frames; ++f)
    for (const std::vector<Vec3>& nodes : scene.nodes_of_frame(f))
      hash.bytes(nodes.data(), sizeof(Vec3) * nodes.size());
  return hash.digest();
}

// Frames with contact, and with containment.
std::pair<std::size_t, std::size_t> judged(const Scene& scene) {
  oracle::Oracle oracle(scene.bodies);
  oracle::WantedTruth wanted;
  wanted.containment = true;
  std::pair<std::size_t, std::size_t> out;
  for (std::size_t f = 0; f < scene.frames; ++f) {
    const test::FrameData data = test::make_frame(scene.bodies, scene.nodes_of_frame(f));
    const oracle::Truth truth = oracle.judge(data.frame(f), wanted);
    out.first += !truth.surface.bodies.empty();
    out.second += !truth.containment.empty();
  }
  return out;
}

TEST(DrawnScene, IsTheSameForTheSameSeedOnEveryMachine) {
  Fnv1a all;
  for (std::uint64_t number = 1; number <= 12; ++number) {
    const DrawnScene scene = draw_scene(small_spec(number));
    const std::uint64_t hash = frames_hash(scene.scene);
    all.value(hash);
    if (number <= 3) {
      EXPECT_EQ(draw_scene(small_spec(number)).text.text, scene.text.text);
    }
  }
  EXPECT_EQ(all.digest(), 0x32634cfb55a231a1ull) << std::hex << all.digest();
}

DrawnSpec step_spec(std::uint64_t number, const std::string& shares,
                    const std::string& self = "0.5") {
  DrawnSpec spec = small_spec(number);
  spec.rules = test::small_step_rules(shares, self);
  return spec;
}

// In all steps: pairs of bodies that meet, and of elements of one body.
std::pair<std::size_t, std::size_t> judged_steps(const Scene& scene) {
  oracle::StepOracle oracle(scene.bodies);
  std::pair<std::size_t, std::size_t> out;
  for (std::size_t f = 0; f + 1 < scene.frames; ++f) {
    const test::FrameData start = test::make_frame(scene.bodies, scene.nodes_of_frame(f));
    const test::FrameData end = test::make_frame(scene.bodies, scene.nodes_of_frame(f + 1));
    const oracle::StepTruth truth =
        oracle.judge({start.frame(f), end.frame(f + 1)}, {}, {true, true});
    out.first += truth.first.size();
    out.second +=
        truth.contacts.self_impact_vertices.size() + truth.contacts.self_impact_edges.size();
  }
  return out;
}

constexpr const char* kEachShare =
    R"("apart": 1, "near-miss": 1, "graze": 1, "touch": 1, "deep": 1, "pile": 1, "nested": 1, "pass": 1)";

TEST(DrawnSteps, AreTheSameForTheSameSeedOnEveryMachine) {
  Fnv1a all;
  for (std::uint64_t number = 1; number <= 8; ++number) {
    const DrawnScene drawn = draw_scene(step_spec(number, kEachShare));
    const Scene kept = load_scene_text(drawn.text);
    all.value(frames_hash(kept));
    EXPECT_EQ(frames_hash(kept), frames_hash(drawn.scene));
    EXPECT_EQ(kept.levels, drawn.scene.levels);
    EXPECT_EQ(kept.id, "drawn-steps-7-" + std::to_string(number));
  }
  EXPECT_EQ(all.digest(), 0x857c1784b7fc4649ull) << std::hex << all.digest();
}

// Bodies that pass touch in no frame, and meet in every step.
TEST(DrawnSteps, BodiesThatPassMeetBetweenFramesAlone) {
  for (std::uint64_t number = 1; number <= 3; ++number) {
    const Scene scene = draw_scene(step_spec(number, R"("pass": 1)", "0")).scene;
    EXPECT_EQ(judged(scene).first, 0u) << number;
    EXPECT_GE(judged_steps(scene).first, scene.frames - 1) << number;
  }
}

TEST(DrawnSteps, AreJudgedForContactOfBodiesWithThemselvesInAShareOfTheScenes) {
  std::size_t own = 0;
  for (std::uint64_t number = 1; number <= 6; ++number) {
    const Scene with = draw_scene(step_spec(number, R"("apart": 1)", "1")).scene;
    EXPECT_TRUE(with.judges(Level::kImpactSelfVf) && with.judges(Level::kImpactSelfEe));
    EXPECT_TRUE(with.judges(Level::kImpact) && !with.judges(Level::kTriangle));
    own += judged_steps(with).second;
    EXPECT_FALSE(
        draw_scene(step_spec(number, R"("apart": 1)", "0")).scene.judges(Level::kImpactSelfVf));
  }
  EXPECT_GT(own, 40u);
}

TEST(DrawnSteps, HaveFewerTrianglesTheFurtherTheySweep) {
  DrawnSpec spec;
  spec.rules = text::read_file_bytes(CONTACTCHECK_FIXTURES "/drawn-steps.json", "rules file");
  spec.rules_name = "drawn-steps.json";
  const DrawRules rules = parse_draw_rules(spec.rules, spec.rules_name);
  ASSERT_TRUE(rules.steps);
  std::size_t slow = 0, fast = 0;
  for (int i = 1; i <= 500; ++i) {
    spec.number = static_cast<std::uint64_t>(i);
    const Drawn drawn = draw_parameters(spec);
    const double triangles = drawn.parameters.at("triangles");
    const double speed = drawn.parameters.at("speed");
    ASSERT_TRUE(speed >= rules.speed.low && speed <= rules.speed.high);
    ASSERT_LE(triangles * drawn.parameters.at("bodies") * speed, rules.steps->most_swept);
    slow += speed < 0.01;
    fast += speed > 0.1;
  }
  // A third of them each.
  EXPECT_NEAR(static_cast<double>(slow), 500.0 / 3.0, 50.0);
  EXPECT_NEAR(static_cast<double>(fast), 500.0 / 3.0, 50.0);
}

TEST(DrawnScene, IsAnotherOneForEveryKey) {
  DrawnSpec spec = small_spec(1);
  std::vector<std::string> texts = {draw_scene(spec).text.text};
  spec.number = 2;
  texts.push_back(draw_scene(spec).text.text);
  spec = small_spec(1);
  spec.seed = 8;
  texts.push_back(draw_scene(spec).text.text);
  spec = small_spec(1);
  spec.redrawn = 1;
  texts.push_back(draw_scene(spec).text.text);
  std::set<std::uint64_t> hashes;
  for (const std::string& text : texts)
    hashes.insert(frames_hash(load_scene_text({text, "kept", {}})));
  EXPECT_EQ(hashes.size(), texts.size());
}

TEST(DrawnScene, AsASceneFileHasTheSameFrames) {
  for (std::uint64_t number = 1; number <= 8; ++number) {
    const DrawnScene drawn = draw_scene(small_spec(number));
    const Scene kept = load_scene_text(drawn.text);
    EXPECT_EQ(frames_hash(kept), frames_hash(drawn.scene));
    ASSERT_TRUE(kept.drawn);
    EXPECT_EQ(kept.drawn->happens, drawn.scene.drawn->happens);
    EXPECT_EQ(kept.drawn->parameters, drawn.scene.drawn->parameters);
    EXPECT_FALSE(kept.bisects_time());
  }
}

TEST(DrawnScene, HasContactInExactlyTheFramesDrawn) {
  for (const char* what : {"graze", "touch", "deep", "pile"})
    for (std::uint64_t number = 1; number <= 6; ++number) {
      const std::string share = std::string("\"") + what + "\": 1";
      const DrawnScene drawn = draw_scene(small_spec(number, share));
      const double wanted = drawn.scene.drawn->parameters.at("contact_share");
      const auto frames = static_cast<double>(drawn.scene.frames);
      EXPECT_EQ(static_cast<double>(judged(drawn.scene).first), std::ceil(wanted * frames))
          << what << " " << number;
      EXPECT_GE(wanted, 1.0 / 3.0);
    }
}

TEST(DrawnScene, HasNoContactWhereNoneIsDrawn) {
  for (const char* what : {"apart", "near-miss", "nested"})
    for (std::uint64_t number = 1; number <= 6; ++number) {
      const std::string share = std::string("\"") + what + "\": 1";
      const DrawnScene drawn = draw_scene(small_spec(number, share));
      const auto [contact, containment] = judged(drawn.scene);
      EXPECT_EQ(contact, 0u) << what << " " << number;
      EXPECT_EQ(containment, std::string(what) == "nested" ? drawn.scene.frames : 0u)
          << what << " " << number;
    }
}

TEST(DrawnScene, KeepsToTheRulesAndTheirShares) {
  DrawnSpec spec;
  spec.rules = text::read_file_bytes(CONTACTCHECK_FIXTURES "/drawn.json", "rules file");
  spec.rules_name = "drawn.json";
  const DrawRules rules = parse_draw_rules(spec.rules, spec.rules_name);
  constexpr int kScenes = 2000;
  std::map<std::string, int> count;
  double low = rules.triangles.high, high = 0.0;
  for (int i = 1; i <= kScenes; ++i) {
    spec.number = static_cast<std::uint64_t>(i);
    const Drawn drawn = draw_parameters(spec);
    ++count[drawn.happens];
    const auto in = [&](const char* name, const DrawRange& range) {
      return drawn.parameters.at(name) >= range.low && drawn.parameters.at(name) <= range.high;
    };
    ASSERT_TRUE(in("bodies", rules.bodies) && in("cells", rules.cells) &&
                in("frames", rules.frames) && in("speed", rules.speed) &&
                in("size_ratio", rules.size_ratio) && in("triangles", rules.triangles));
    ASSERT_LE(drawn.parameters.at("bodies") * drawn.parameters.at("triangles"), 400000.0);
    low = std::min(low, drawn.parameters.at("triangles"));
    high = std::max(high, drawn.parameters.at("triangles"));
  }
  EXPECT_LT(low, 550.0);
  EXPECT_GT(high, 150000.0);
  for (std::size_t i = 0; i < kHappenings.size(); ++i) {
    const double wanted = kScenes * rules.shares[i] / 20.0;
    EXPECT_NEAR(count[kHappenings[i]], wanted, 4.0 * std::sqrt(wanted)) << kHappenings[i];
  }
}

TEST(DrawnScene, RefusesAMeshThatNoLatticeHolds) {
  const test::Scratch scratch;
  scratch.write("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  EXPECT_THAT(test::sentence_of([&] { check_drawn_mesh(scratch.folder() / "point.obj"); }),
              testing::HasSubstr("is a point and can meet nothing"));
}

}  // namespace
}  // namespace contactcheck::scene
