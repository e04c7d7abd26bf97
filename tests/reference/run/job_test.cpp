#include "reference/run/job.h"

#include <gmock/gmock.h>

#include "tests/reference/scene/scratch.h"

namespace contactcheck {
namespace {

using test::Scratch;
using test::sentence_of;
using testing::ElementsAre;
using testing::HasSubstr;

// Every field differs from its default.
Job full_job() {
  Job job;
  job.scene_file = "/a folder/scene \"x\".json";
  job.text = SceneText{"{\"id\": \"x\"}", "the scene \"x\"", "/a folder"};
  job.settings.detectors = {"fcl-aabb", "ffd-aabb:bounds=safe"};
  job.settings.frames = 7;
  job.settings.repeats = 9;
  job.settings.processes = 3;
  job.settings.time_budget = 0.1;
  job.settings.fewest_timed_frames = 2;
  job.settings.closed_loop = true;
  job.settings.threads = 2;
  job.settings.sweep_bytes = 12345;
  job.settings.timing = false;
  job.settings.call_limit = 1.0 / 3.0;
  job.settings.memory_limit = std::uint64_t{1} << 40;
  job.skip = {1, 4};
  job.process = 2;
  job.unjudged = Unjudged{"the oracle, frame 3", 3};
  job.order = {3, 0, 2};
  job.prefixes = {3, 0};
  job.answers = {{{Question::kBody, {AnswerPrint{}}}}, {}};
  job.answers[0][0].frames[0].sizes[6] = 5;
  job.answer_file = "/tmp/answer";
  job.recording_file = "/tmp/x.ccr";
  return job;
}

TEST(Job, ReadsBackAsItWasWritten) {
  const Scratch scratch;
  const Job out = full_job();
  write_job(scratch.folder() / "job", out);
  const Job in = read_job(scratch.folder() / "job");
  EXPECT_EQ(in.scene_file, out.scene_file);
  ASSERT_TRUE(in.text);
  EXPECT_EQ(in.text->text, out.text->text);
  EXPECT_EQ(in.text->name, out.text->name);
  EXPECT_EQ(in.text->folder, out.text->folder);
  EXPECT_EQ(in.settings.detectors, out.settings.detectors);
  ASSERT_TRUE(in.unjudged);
  EXPECT_EQ(in.unjudged->why, out.unjudged->why);
  EXPECT_EQ(in.unjudged->frame, 3u);
  EXPECT_EQ(in.settings.frames, 7u);
  EXPECT_EQ(in.settings.repeats, 9u);
  EXPECT_EQ(in.settings.processes, 3u);
  EXPECT_EQ(in.settings.time_budget, 0.1);
  EXPECT_EQ(in.settings.fewest_timed_frames, 2u);
  EXPECT_TRUE(in.settings.closed_loop);
  EXPECT_EQ(in.settings.threads, 2u);
  EXPECT_EQ(in.settings.sweep_bytes, 12345u);
  EXPECT_FALSE(in.settings.timing);
  EXPECT_EQ(in.settings.call_limit, 1.0 / 3.0);
  EXPECT_EQ(in.settings.memory_limit, std::uint64_t{1} << 40);
  EXPECT_THAT(in.skip, ElementsAre(1, 4));
  EXPECT_EQ(in.process, 2u);
  EXPECT_THAT(in.order, ElementsAre(3, 0, 2));
  EXPECT_THAT(in.prefixes, ElementsAre(3, 0));
  ASSERT_EQ(in.answers.size(), 2u);
  ASSERT_EQ(in.answers[0].size(), 1u);
  EXPECT_EQ(in.answers[0][0].question, Question::kBody);
  EXPECT_EQ(in.answers[0][0].frames.at(0).sizes[6], 5u);
  EXPECT_EQ(in.answer_file, "/tmp/answer");
  EXPECT_EQ(in.recording_file, "/tmp/x.ccr");
}

TEST(Job, RandomPairsReadBackInPlaceOfAFile) {
  const Scratch scratch;
  Job out = full_job();
  EXPECT_FALSE(
      (write_job(scratch.folder() / "job", out), read_job(scratch.folder() / "job").pairs));
  out.pairs = PairSpec{10'000'000, kLargestPairSeed};
  write_job(scratch.folder() / "job", out);
  const Job in = read_job(scratch.folder() / "job");
  ASSERT_TRUE(in.pairs);
  EXPECT_EQ(in.pairs->count, 10'000'000u);
  EXPECT_EQ(in.pairs->seed, kLargestPairSeed);
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
  answer.order = {1, 0};
  answer.prefixes = {0, 0, 2};
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
  EXPECT_THAT(in.order, ElementsAre(1, 0));
  EXPECT_THAT(in.prefixes, ElementsAre(0, 0, 2));
  EXPECT_EQ(in.truth_contacts, R"([{"frame":1}])");
  ASSERT_EQ(in.disagreements.size(), 1u);
  EXPECT_EQ(in.disagreements[0].case_file, "/tmp/case");
  ASSERT_EQ(in.detectors.size(), 1u);
  EXPECT_EQ(in.detectors[0].position, 2u);
  EXPECT_EQ(in.detectors[0].run.message, "odd \xef\xbf\xbd byte") << "U+FFFD for what is no UTF-8";
  EXPECT_EQ(in.detectors[0].run.contact_hash, "0x1");
  EXPECT_EQ(in.detectors[0].contacts, R"({"detector":"fcl-aabb"})");
}

TEST(Answer, SamplesReadBackBitForBit) {
  SceneAnswer answer = full_answer();
  QuestionSamples& out = answer.detectors[0].samples.emplace_back();
  out.question = Question::kBody;
  out.lazy_map = true;
  out.frames[4].cold = {{0.1, 1.0 / 3.0, 1e-300}, {1.0, 2.0, 3.0, 4.0}};
  out.frames[4].hot = {{4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}};
  out.frames[17].cold = out.frames[17].hot = {{1.5, 2.5, 3.5}, {0.0, 0.0, 0.0}};
  const QuestionSamples in = reread(answer).detectors.at(0).samples.at(0);
  EXPECT_EQ(in.question, Question::kBody);
  EXPECT_TRUE(in.lazy_map);
  ASSERT_EQ(in.frames.size(), 2u);
  for (const auto& [frame, samples] : out.frames)
    for (const auto mode : {&FrameSamples::cold, &FrameSamples::hot}) {
      const auto& read = in.frames.at(frame).*mode;
      ASSERT_EQ(read.size(), 2u);
      for (std::size_t r = 0; r < 2; ++r) {
        EXPECT_EQ(read[r].map, (samples.*mode)[r].map);
        EXPECT_EQ(read[r].update, (samples.*mode)[r].update);
        EXPECT_EQ(read[r].query, (samples.*mode)[r].query);
        EXPECT_EQ(read[r].reported, (samples.*mode)[r].reported);
      }
    }
}

TEST(Answer, JudgedAnswersReadBackEvenWhereTheyAreEmpty) {
  AnswerPrint print;
  print.sizes = {1, 0, 2};
  print.hashes = {~std::uint64_t{0}, 0, 7};
  SceneAnswer answer = full_answer();
  answer.detectors[0].answers = {{Question::kTriangles, {print, {}}}, {Question::kBody, {}}};
  const JudgedAnswers in = reread(answer).detectors.at(0).answers;
  ASSERT_EQ(in.size(), 2u);
  EXPECT_EQ(in[1].question, Question::kBody);
  ASSERT_EQ(in[0].frames.size(), 2u);
  EXPECT_EQ(in[0].frames[0].sizes, print.sizes);
  EXPECT_EQ(in[0].frames[0].hashes, print.hashes);
  EXPECT_EQ(in[0].frames[1].sizes, AnswerSizes{});
}

}  // namespace
}  // namespace contactcheck
