// `contactcheck reduce` with detectors whose minimal case is known, from the command line to the
// case that `contactcheck run` shows again.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reference/scene/scene.h"
#include "tests/faults/whole_run.h"
#include "tests/reference/scene/small_draw_rules.h"
#include "tests/support/files.h"

namespace contactcheck {
namespace {

using nlohmann::json;
using test::Outcome;
using test::Scratch;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Two divided boxes that press into one another; where they do, they reach above z = 1.5.
constexpr const char* kBoxes = R"({
  "id": "boxes", "frames": 1, "duration": 1, "levels": ["body", "triangle"],
  "bodies": [
    {"name": "lower", "mesh": {"shape": "box", "sides": [1.1, 1.2, 1.3], "divisions": 2,
     "center": [0.12, 0.34, 1.1]}},
    {"name": "upper", "mesh": {"shape": "box", "divisions": 2, "center": [0.31, 0.52, 2.17]}}]
})";

/// The same in lattices, the second bent.
constexpr const char* kBentBoxes = R"({
  "id": "bent", "frames": 1, "duration": 1, "levels": ["body", "triangle"],
  "bodies": [
    {"name": "lower", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [3, 3, 3]}},
    {"name": "upper", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [3, 3, 3]},
     "motion": {"position": [0.4, 0.3, 0.2],
                "deformers": [{"bend": {"axis": "y", "toward": "x", "degrees": 40}}]}}]
})";

class Reduce : public testing::Test {
 protected:
  Outcome reduce(const std::string& detector, std::vector<std::string> flags = {},
                 const char* scene = kBoxes) {
    scratch_.write("scene.json", scene);
    std::vector<std::string> words = {"reduce",     (scratch_.folder() / "scene.json").string(),
                                      "--detector", detector,
                                      "--out",      file_.string()};
    words.insert(words.end(), flags.begin(), flags.end());
    return test::run_program(CONTACTCHECK_WITH_FAULTS, words);
  }

  scene::Scene reduced() const { return scene::load_scene(file_); }

  static std::size_t triangles(const scene::Scene& scene, std::size_t body) {
    return scene.bodies[body].shape->mesh.triangles.size();
  }

  json run_again(const std::string& detector) {
    const std::filesystem::path out = scratch_.folder() / "out";
    test::run_program(CONTACTCHECK_WITH_FAULTS, {"run", file_.string(), "--detector", detector,
                                                 "--no-timing", "--quiet", "--out", out.string()});
    return json::parse(test::text_of(out / "results.json"));
  }

  Scratch scratch_;
  std::filesystem::path file_ = scratch_.folder() / "least.json";
};

TEST_F(Reduce, AMissToTwoTrianglesOfSmallWholeNumbers) {
  const Outcome outcome = reduce("fault-misses-high");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const scene::Scene scene = reduced();
  EXPECT_EQ(scene.id, "least");
  EXPECT_EQ(triangles(scene, 0), 1u);
  EXPECT_EQ(triangles(scene, 1), 1u);
  double highest = 0.0;
  for (const auto& body : scene.recorded[0])
    for (const Vec3& v : body) {
      highest = std::max(highest, v.z());
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(v[k], std::nearbyint(v[k]));
        EXPECT_LE(std::abs(v[k]), 9.0);
      }
    }
  EXPECT_GT(highest, 1.5);
}

TEST_F(Reduce, SaysWhatItFoundAndPrintsATest) {
  const Outcome outcome = reduce("fault-misses-high");
  const std::string& said = outcome.err;
  EXPECT_THAT(said, StartsWith("boxes, frame 0: fault-misses-high missed at level triangle\n"));
  EXPECT_THAT(said, HasSubstr("triangles                            96          2"));
  EXPECT_THAT(said, HasSubstr("answered: 0 pairs at level triangle of 1 true: 1 missed"));
  EXPECT_THAT(said, HasSubstr("least.json\n"));
  // Standard output is a source file.
  EXPECT_THAT(outcome.out, StartsWith("// fault-misses-high: missed at level triangle. From "
                                      "boxes, frame 0.\n"
                                      "TEST(FaultMissesHigh, MissedTriangleBoxes) {\n"));
  EXPECT_THAT(outcome.out, EndsWith("\n  EXPECT_TRUE(your_detector(first_vertices, "
                                    "first_triangles, second_vertices, second_triangles, 0, "
                                    "0));\n}\n"));
}

TEST_F(Reduce, PrintsPythonThatRunsAsItIs) {
  const Outcome outcome = reduce("fault-misses-high", {"--print", "python"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* answer : {"True", "False"}) {
    const std::string script =
        std::string("def your_detector(*given):\n    return ") + answer + "\n" + outcome.out;
    EXPECT_EQ(test::run_program("/usr/bin/env", {"python3", "-c", script}).exit_code == 0,
              answer == std::string("True"));
  }
}

TEST_F(Reduce, InALogSaysHowFarItIs) {
  const Outcome outcome = reduce("fault-hang:frame=0", {"--call-limit", "1", "--budget", "4"});
  EXPECT_THAT(outcome.err, HasSubstr(" candidates tried, now "));
}

TEST_F(Reduce, WritesACaseThatRunShowsAgain) {
  ASSERT_EQ(reduce("fault-misses-high").exit_code, 0);
  const json results = run_again("fault-misses-high");
  EXPECT_EQ(results.at("runs")[0].at("levels").at("triangle").at("missed"), 1);
  EXPECT_EQ(results.at("disagreements")[0].at("kind"), "missed");
}

TEST_F(Reduce, KeepsThreeTrianglesWhereItTakesThree) {
  ASSERT_EQ(reduce("fault-misses-crowds").exit_code, 0);
  EXPECT_EQ(triangles(reduced(), 0), 3u);
  EXPECT_EQ(triangles(reduced(), 1), 1u);
}

TEST_F(Reduce, GivesTheSameBytesEveryTime) {
  const std::string out = reduce("fault-misses-crowds").out;
  const std::string bytes = test::text_of(file_);
  EXPECT_EQ(reduce("fault-misses-crowds").out, out);
  EXPECT_EQ(test::text_of(file_), bytes);
}

TEST_F(Reduce, ACrash) {
  const Outcome outcome = reduce("fault-crashes-in-crowds");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("error: signal 11"));
  EXPECT_EQ(triangles(reduced(), 0) + triangles(reduced(), 1), 5u);
  EXPECT_EQ(run_again("fault-crashes-in-crowds").at("runs")[0].at("status"), "error");
}

TEST_F(Reduce, AHang) {
  const Outcome outcome = reduce("fault-hang:frame=0", {"--call-limit", "0.2", "--budget", "15"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("error: time limit"));
  EXPECT_THAT(outcome.err, HasSubstr("15 candidates tried, the whole budget"));
  EXPECT_EQ(triangles(reduced(), 0) + triangles(reduced(), 1), 2u);
}

TEST_F(Reduce, WhatThrowsAndWhatEatsMemory) {
  EXPECT_THAT(reduce("fault-throw:frame=0", {"--budget", "50"}).err, HasSubstr("error: threw"));
  EXPECT_THAT(reduce("fault-memory:frame=0", {"--budget", "1", "--memory-limit", "500"}).err,
              HasSubstr("error: memory limit"));
}

class RunAndReduce : public testing::Test {
 protected:
  Outcome run(const std::string& target, const std::vector<std::string>& detectors) {
    std::vector<std::string> words = {"run",     target,  "--reduce",   "--no-timing",
                                      "--quiet", "--out", out_.string()};
    for (const std::string& detector : detectors)
      words.insert(words.end(), {"--detector", detector});
    return test::run_program(CONTACTCHECK_WITH_FAULTS, words);
  }
  scene::Scene least(const std::string& id) const {
    return scene::load_scene(out_ / "cases" / (id + ".json"));
  }

  Scratch scratch_;
  std::filesystem::path out_ = scratch_.folder() / "out";
};

TEST_F(RunAndReduce, TheFirstErrorOfEachDetectorLevelAndKind) {
  const std::string scene = scratch_.write("scene.json", kBoxes).string();
  const Outcome outcome =
      run(scene, {"full-refit", "fault-misses-high", "fault-crashes-in-crowds"});
  EXPECT_EQ(outcome.exit_code, 3);  // the crash
  EXPECT_THAT(outcome.out, Not(HasSubstr("not reduced")));
  const std::filesystem::path file =
      out_ / "cases/min-fault-misses-high-missed-triangle-boxes.json";
  EXPECT_THAT(outcome.out, HasSubstr("\nreduced: boxes, frame 0: fault-misses-high missed at level "
                                     "triangle: 2 triangles: " +
                                     file.string() + "\n"));
  EXPECT_EQ(least("min-fault-misses-high-missed-triangle-boxes").bodies.size(), 2u);
  EXPECT_EQ(least("min-fault-crashes-in-crowds-error-boxes").bodies.size(), 2u);
}

TEST_F(RunAndReduce, SaysWhatCannotBeReduced) {
  const std::string scene = scratch_.write("scene.json", kBentBoxes).string();
  const Outcome outcome = run(scene, {"fault-misses-in-lattices"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("\nnot reduced: bent, frame 0, fault-misses-in-lattices: "));
}

TEST_F(RunAndReduce, OfADrawnSceneNamesItsParameters) {
  const std::string rules =
      scratch_.write("rules.json", test::small_draw_rules(R"("deep": 1)")).string();
  std::vector<std::string> words = {"run",         rules,        "--seed",
                                    "7",           "--count",    "2",
                                    "--reduce",    "--detector", "fault-misses-crowds",
                                    "--no-timing", "--quiet",    "--out",
                                    out_.string()};
  const Outcome outcome = test::run_program(CONTACTCHECK_WITH_FAULTS, words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string text =
      test::text_of(out_ / "cases/min-fault-misses-crowds-missed-triangle-drawn-7-1.json");
  EXPECT_THAT(text, testing::ContainsRegex("scene drawn-7-1 .bodies [2-4], .*, frame [0-9]+, "
                                           "detector fault-misses-crowds"));
}

TEST_F(Reduce, UndoesWhatADetectorChangesInItsProcess) {
  for (const char* fault : {"fault-close", "fault-stdout", "fault-locale", "fault-trap"}) {
    const Outcome outcome = reduce(std::string(fault) + ":frame=0");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("nothing is wrong")) << fault;
  }
}

// The first frame is answered rightly, and the second one, in the same process, is not.
TEST_F(Reduce, RefusesWhatDependsOnEarlierAnswers) {
  std::string two_frames = kBoxes;
  two_frames.replace(two_frames.find("\"frames\": 1"), 11, "\"frames\": 2");
  const Outcome outcome = reduce("fault-forgets", {}, two_frames.c_str());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("depends on what ran before it in its process"));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(Reduce, RefusesWhatTakesTheLatticeOfTheScene) {
  const Outcome outcome = reduce("fault-misses-in-lattices", {}, kBentBoxes);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("with the scene's own lattices and rest shapes alone"));
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace contactcheck
