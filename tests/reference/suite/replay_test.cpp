// Real workers that time scenes whose frames were simulated or searched: on those of the recording.
#include <gmock/gmock.h>

#include "core/deform/recording.h"
#include "reference/suite/job.h"
#include "reference/suite/supervisor.h"
#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using testing::HasSubstr;

namespace fs = std::filesystem;

// In neither do the bodies touch; the bar is longer than the cube.
struct MadeScene {
  const char* name;
  const char* text;
};

constexpr MadeScene kSimulated = {"simulated", R"({
  "id": "made", "title": "A cube begins to fall", "frames": 2,
  "simulation": {"every": 1, "driver": "ffd-aabb+tri"}, "levels": ["body", "triangle"],
  "bodies": [
    {"name": "bar", "mesh": {"shape": "box", "sides": [2, 0.5, 0.5], "divisions": 2},
     "lattice": {"cells": [2, 2, 2]}, "motion": {"position": [0, 0.6, 0]}},
    {"name": "cube", "mesh": {"shape": "box", "divisions": 2}, "lattice": {"cells": [2, 2, 2]},
     "motion": {"position": [0.1, 1.7, 0.2]}, "material": {"model": "mass-spring", "mass": 1}}]
})"};

constexpr MadeScene kSwept = {"swept", R"({
  "id": "made", "levels": ["body", "triangle"],
  "sweep": {"separations": [0.1, 0.5], "orientations": 2, "seed": 3},
  "bodies": [{"name": "bar", "mesh": {"shape": "box", "sides": [2, 0.5, 0.25]}},
             {"name": "cube", "mesh": {"shape": "box"}}]
})"};

void PrintTo(const MadeScene& scene, std::ostream* out) { *out << scene.name; }

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

class Replay : public testing::TestWithParam<MadeScene> {
 protected:
  Job job(const fs::path& scene) const {
    Job job;
    job.scene = scene;
    job.settings.detectors = {"aabb-tree"};
    job.answer_file = scratch_.folder() / "answer";
    return job;
  }

  WorkerOutcome run(const Job& job) const {
    write_job(scratch_.folder() / "job", job);
    return run_supervised(CONTACTCHECK_PROGRAM, scratch_.folder() / "job", job.settings,
                          [](const WorkerProgress&) {});
  }

  // What a worker that judges says of a scene or recording, into a recording of this name.
  SceneAnswer judged(const fs::path& scene, const std::string& recording) const {
    Job asked = job(scene);
    asked.recording_file = scratch_.folder() / recording;
    const WorkerOutcome outcome = run(asked);
    EXPECT_TRUE(outcome.done) << outcome.error_text;
    return outcome.done ? read_answer(asked.answer_file) : SceneAnswer{};
  }

  // A job of one turn, in the detector's own question.
  Job timing_job(const fs::path& scene, const SceneAnswer& judged,
                 const fs::path& recording) const {
    Job asked = job(scene);
    asked.recording_file = recording;
    asked.answers = {judged.detectors.at(0).answers};
    asked.turns = {{0, asked.answers[0].at(0).question, false}};
    return asked;
  }

  // What became of that turn.
  TurnAnswer timed(const fs::path& scene, const SceneAnswer& judged,
                   const fs::path& recording) const {
    const Job asked = timing_job(scene, judged, recording);
    const WorkerOutcome outcome = run(asked);
    EXPECT_TRUE(outcome.done) << outcome.error_text;
    const SceneAnswer answer = outcome.done ? read_answer(asked.answer_file) : SceneAnswer{};
    EXPECT_EQ(answer.timed.size(), 1u);
    return answer.timed.empty() ? TurnAnswer{} : answer.timed[0];
  }

  // The same bodies with the cube about the middle of the bar in all frames.
  fs::path with_contact(const fs::path& recording) const {
    Recording moved = read_recording(recording);
    for (std::vector<std::vector<Vec3>>& nodes : moved.frames) {
      const Vec3 way = mean(nodes[0]) - mean(nodes[1]);
      for (Vec3& node : nodes[1]) node += way;
    }
    const fs::path file = scratch_.folder() / "moved.ccr";
    write_recording(file, moved);
    return file;
  }

  const Scratch scratch_;
};

TEST_P(Replay, GivesTheFramesThatWereJudged) {
  const fs::path scene = scratch_.write("made.json", GetParam().text);
  const SceneAnswer own = judged(scene, "made.ccr");
  const TurnAnswer turn = timed(scene, own, scratch_.folder() / "made.ccr");
  EXPECT_EQ(turn.error, "");
  EXPECT_EQ(turn.samples.size(), own.contact_frames.size());
}

// A recording that tells of other frames than the scene would make shows where they are from.
TEST_P(Replay, MakesNoFramesItself) {
  const fs::path scene = scratch_.write("made.json", GetParam().text);
  const SceneAnswer own = judged(scene, "made.ccr");
  const fs::path moved = with_contact(scratch_.folder() / "made.ccr");
  const SceneAnswer other = judged(moved, "again.ccr");
  EXPECT_THAT(own.contact_frames, testing::Each(false));
  ASSERT_THAT(other.contact_frames, testing::Each(true));
  EXPECT_EQ(timed(scene, other, moved).error, "");
  EXPECT_THAT(timed(scene, own, moved).error, HasSubstr("that were judged"));
}

TEST_P(Replay, WithoutARecordingTheFramesAreMadeAgain) {
  const fs::path scene = scratch_.write("made.json", GetParam().text);
  const SceneAnswer own = judged(scene, "made.ccr");
  fs::remove(scratch_.folder() / "made.ccr");
  const TurnAnswer turn = timed(scene, own, "");
  EXPECT_EQ(turn.error, "");
  EXPECT_EQ(turn.samples.size(), own.contact_frames.size());
}

TEST_P(Replay, OfAnotherSceneIsRefused) {
  const fs::path scene = scratch_.write("made.json", GetParam().text);
  const SceneAnswer own = judged(scene, "made.ccr");
  const fs::path file = scratch_.folder() / "made.ccr";
  Recording longer = read_recording(file);
  longer.frames.push_back(longer.frames.back());
  write_recording(file, longer);
  const WorkerOutcome outcome = run(timing_job(scene, own, file));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error_text, HasSubstr("has other frames or nodes than scene \"made\""));
}

INSTANTIATE_TEST_SUITE_P(All, Replay, testing::Values(kSimulated, kSwept),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace contactcheck::suite
