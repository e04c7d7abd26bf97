#include "reference/suite/job.h"

#include <gmock/gmock.h>

#include "tests/reference/scene/scratch.h"

namespace contactcheck::suite {
namespace {

using test::Scratch;
using test::sentence_of;
using testing::ElementsAre;
using testing::HasSubstr;

// Every field differs from its default.
Job full_job() {
  Job job;
  job.scene = scene::SceneText{"{\"id\": \"x\"}", "the scene \"x\"", "/a folder"};
  job.settings.detectors = {"fcl-aabb", "ffd-aabb:bounds=safe"};
  job.settings.frames = 7;
  job.settings.processes = 9;
  job.settings.one_pass_beyond = 0.1;
  job.settings.seed = scene::kLargestPairSeed;
  job.settings.step_repeats = 4;
  job.settings.closed_loop = true;
  job.settings.threads = 2;
  job.settings.timing = false;
  job.settings.call_limit = 1.0 / 3.0;
  job.settings.memory_limit = std::uint64_t{1} << 40;
  job.skip = {1, 4};
  job.unjudged = Unjudged{"the oracle, frame 3", 3};
  job.turns = {{1, Question::kBody, false}, {0, Question::kTriangles, true}};
  job.cold_frames = {0, 2, 3};
  job.answers = {{{Question::kBody, {judge::AnswerFingerprint{}}}}, {}};
  job.answers[0][0].frames[0].sizes[6] = 5;
  job.answer_file = "/tmp/answer";
  job.recording_file = "/tmp/x.ccr";
  job.temporary = "/tmp/own";
  return job;
}

TEST(Job, ReadsBackAsItWasWritten) {
  const Scratch scratch;
  const Job out = full_job();
  write_job(scratch.folder() / "job", out);
  const Job in = read_job(scratch.folder() / "job");
  const auto& text = std::get<scene::SceneText>(in.scene);
  EXPECT_EQ(text.text, "{\"id\": \"x\"}");
  EXPECT_EQ(text.name, "the scene \"x\"");
  EXPECT_EQ(text.folder, "/a folder");
  EXPECT_EQ(in.settings.detectors, out.settings.detectors);
  ASSERT_TRUE(in.unjudged);
  EXPECT_EQ(in.unjudged->why, out.unjudged->why);
  EXPECT_EQ(in.unjudged->frame, 3u);
  EXPECT_EQ(in.settings.frames, 7u);
  EXPECT_EQ(in.settings.processes, 9u);
  EXPECT_EQ(in.settings.one_pass_beyond, 0.1);
  EXPECT_EQ(in.settings.seed, scene::kLargestPairSeed);
  EXPECT_EQ(in.settings.step_repeats, 4u);
  EXPECT_TRUE(in.settings.closed_loop);
  EXPECT_EQ(in.settings.threads, 2u);
  EXPECT_FALSE(in.settings.timing);
  EXPECT_EQ(in.settings.call_limit, 1.0 / 3.0);
  EXPECT_EQ(in.settings.memory_limit, std::uint64_t{1} << 40);
  EXPECT_THAT(in.skip, ElementsAre(1, 4));
  ASSERT_EQ(in.turns.size(), 2u);
  EXPECT_EQ(in.turns[0].position, 1u);
  EXPECT_EQ(in.turns[0].question, Question::kBody);
  EXPECT_FALSE(in.turns[0].cold);
  EXPECT_TRUE(in.turns[1].cold);
  EXPECT_THAT(in.cold_frames, ElementsAre(0, 2, 3));
  ASSERT_EQ(in.answers.size(), 2u);
  ASSERT_EQ(in.answers[0].size(), 1u);
  EXPECT_EQ(in.answers[0][0].question, Question::kBody);
  EXPECT_EQ(in.answers[0][0].frames.at(0).sizes[6], 5u);
  EXPECT_EQ(in.answer_file, "/tmp/answer");
  EXPECT_EQ(in.recording_file, "/tmp/x.ccr");
  EXPECT_EQ(in.temporary, "/tmp/own");
}

TEST(Job, EachSourceOfASceneReadsBack) {
  const Scratch scratch;
  const auto reread = [&](const scene::SceneSource& source) {
    Job job = full_job();
    job.scene = source;
    write_job(scratch.folder() / "job", job);
    return read_job(scratch.folder() / "job").scene;
  };
  const std::filesystem::path file = "/a folder/scene \"x\".json";
  EXPECT_EQ(std::get<std::filesystem::path>(reread(file)), file);
  const auto pairs =
      std::get<scene::PairSpec>(reread(scene::PairSpec{10'000'000, scene::kLargestPairSeed}));
  EXPECT_EQ(pairs.count, 10'000'000u);
  EXPECT_EQ(pairs.seed, scene::kLargestPairSeed);
}

TEST(Job, TextOfAMissingFileIsRefusedWithItsPath) {
  EXPECT_THAT(sentence_of([] { read_text_file("/nonexistent/job"); }),
              HasSubstr("/nonexistent/job"));
}

TEST(Job, TextOfAFolderIsRefused) {
  const Scratch scratch;
  EXPECT_THAT(sentence_of([&] { read_text_file(scratch.folder()); }),
              HasSubstr(scratch.folder().string()));
}

TEST(Job, TextOfAnEmptyFileIsEmpty) {
  const Scratch scratch;
  EXPECT_EQ(read_text_file(scratch.write("empty", "")), "");
}

SceneAnswer reread(const SceneAnswer& answer) {
  const Scratch scratch;
  write_answer(scratch.folder() / "answer", answer);
  return read_answer(scratch.folder() / "answer");
}

// With a detector whose library prints what is no UTF-8.
SceneAnswer full_answer() {
  SceneAnswer answer;
  answer.scene.id = "s";
  answer.scene.truth[Level::kCell] = "not judged: a body has no lattice";
  answer.contact_frames = {false, true};
  answer.truth_contacts = R"([{"frame":1}])";
  answer.disagreements = {{"s", "fcl-aabb", "triangle", "missed", "/tmp/case", 1}};
  DetectorAnswer& detector = answer.detectors.emplace_back();
  detector.position = 2;
  detector.run.detector = "fcl-aabb";
  detector.run.message = "odd \xff byte";
  detector.run.contact_hash = "0x1";
  detector.contacts = R"({"detector":"fcl-aabb"})";
  return answer;
}

TEST(Answer, ReadsBackAsItWasWritten) {
  const SceneAnswer in = reread(full_answer());
  EXPECT_EQ(in.scene.id, "s");
  EXPECT_EQ(std::get<std::string>(in.scene.truth.at(Level::kCell)),
            "not judged: a body has no lattice");
  EXPECT_THAT(in.contact_frames, ElementsAre(false, true));
  EXPECT_EQ(in.truth_contacts, R"([{"frame":1}])");
  ASSERT_EQ(in.disagreements.size(), 1u);
  EXPECT_EQ(in.disagreements[0].case_file, "/tmp/case");
  ASSERT_EQ(in.detectors.size(), 1u);
  EXPECT_EQ(in.detectors[0].position, 2u);
  EXPECT_EQ(in.detectors[0].run.message, "odd \xef\xbf\xbd byte") << "U+FFFD for what is no UTF-8";
  EXPECT_EQ(in.detectors[0].run.contact_hash, "0x1");
  EXPECT_EQ(in.detectors[0].contacts, R"({"detector":"fcl-aabb"})");
}

TEST(Answer, TurnsReadBackBitForBit) {
  SceneAnswer answer = full_answer();
  TurnAnswer out;
  out.turn = {2, Question::kBody, true};
  out.lazy_map = true;
  out.notes = {"changed the locale"};
  out.samples = {{0.1, 1.0 / 3.0, 1e-300, std::nullopt, 0.2, 1.0 / 9.0},
                 {1.0, 2.0, 3.0, 4.0, 1.0 / 7.0, 5.0}};
  answer.timed.push_back(out);
  answer.timed.push_back({{0, Question::kTriangles, false}, "it threw", 3, false, {}, {}});
  const std::vector<TurnAnswer> in = reread(answer).timed;
  ASSERT_EQ(in.size(), 2u);
  EXPECT_EQ(in[0].turn.position, 2u);
  EXPECT_EQ(in[0].turn.question, Question::kBody);
  EXPECT_TRUE(in[0].turn.cold);
  EXPECT_TRUE(in[0].lazy_map);
  EXPECT_THAT(in[0].notes, ElementsAre("changed the locale"));
  EXPECT_EQ(in[0].failed_frame, std::nullopt);
  ASSERT_EQ(in[0].samples.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    const timing::PhaseSample &read = in[0].samples[f], &written = out.samples[f];
    EXPECT_EQ(read.map, written.map);
    EXPECT_EQ(read.update, written.update);
    EXPECT_EQ(read.query, written.query);
    EXPECT_EQ(read.reported, written.reported);
    EXPECT_EQ(read.cpu, written.cpu);
    EXPECT_EQ(read.taken, written.taken);
  }
  EXPECT_EQ(in[1].error, "it threw");
  EXPECT_EQ(in[1].failed_frame, 3u);
  EXPECT_TRUE(in[1].notes.empty());
}

TEST(Answer, JudgedAnswersReadBackEvenWhereTheyAreEmpty) {
  judge::AnswerFingerprint print;
  print.sizes = {1, 0, 2};
  print.hashes = {~std::uint64_t{0}, 0, 7};
  SceneAnswer answer = full_answer();
  answer.detectors[0].answers = {{Question::kTriangles, {print, {}}}, {Question::kBody, {}}};
  const judge::JudgedAnswers in = reread(answer).detectors.at(0).answers;
  ASSERT_EQ(in.size(), 2u);
  EXPECT_EQ(in[1].question, Question::kBody);
  ASSERT_EQ(in[0].frames.size(), 2u);
  EXPECT_EQ(in[0].frames[0].sizes, print.sizes);
  EXPECT_EQ(in[0].frames[0].hashes, print.hashes);
  EXPECT_EQ(in[0].frames[1].sizes, judge::ListNumbers{});
}

}  // namespace
}  // namespace contactcheck::suite
