// Stands in for `contactcheck worker JOB --progress-fd FD`: tells the shared page that it is in
// detector 1, frame 7, phase update, and then does what the first line of its job file says. A real
// job's file tells it the same by the name of its scene.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "reference/judge/contacts_json.h"
#include "reference/process/shared_progress.h"
#include "reference/process/surroundings.h"
#include "reference/suite/job.h"

namespace contactcheck::suite {
namespace {

void begin(process::ProgressWriter& progress) { progress.enter(1, 7, process::Phase::kUpdate); }

// Dies by the signal itself, also where a sanitizer has taken its handler over.
void die(int number) {
  signal(number, SIG_DFL);
  raise(number);
}

void allocate_for_ever() {
  constexpr std::size_t kBlock = std::size_t{16} << 20, kMost = 256;  // 4 GiB at most
  std::vector<std::vector<char>> blocks;
  while (blocks.size() < kMost) {
    blocks.emplace_back(kBlock, char{1});
    usleep(5'000);
  }
}

// In an orphan in a session of its own.
void allocate_away() {
  if (fork() == 0) {
    if (fork() == 0) {
      setsid();
      allocate_for_ever();
      sleep(300);
    }
    _exit(0);
  }
  sleep(300);
}

void step_for_a_second(process::ProgressWriter& progress) {
  for (int i = 0; i < 20; ++i) {
    progress.enter(1, 7, process::Phase::kUpdate);
    progress.part(0.5);
    usleep(50'000);
  }
}

// A child that would sleep on, `away` in a session of its own; the numbers of both are written
// beside the job file.
void leave_child(const std::string& job_file, bool away = false) {
  const pid_t child = fork();
  if (child == 0) {
    if (away) setsid();
    sleep(300);
    _exit(0);
  }
  while (away && getsid(child) != child) usleep(1'000);
  const std::string name = job_file + ".pids";
  std::ofstream(name + ".part") << getpid() << ' ' << child << '\n';
  std::rename((name + ".part").c_str(), name.c_str());
}

void talk() {
  std::puts("to standard output");
  std::fputs("last words\n", stderr);
  std::fflush(stdout);
}

// Standard input is there and empty.
void read_input() {
  char byte = 0;
  if (read(STDIN_FILENO, &byte, 1) != 0) die(SIGKILL);
}

void flood() {
  const std::string block(std::size_t{1} << 20, 'x');
  for (int i = 0; i < 256; ++i)
    if (write(STDERR_FILENO, block.data(), block.size()) < 0) return;
  sleep(60);
}

// Of nine frames: detector 0 takes 18 ms, the others 27 ns.
timing::Pass fake_pass(const Turn& turn) {
  return turn.position == 0 ? timing::Pass(9, {0, 1e6, 1e6}) : timing::Pass(9, {1, 1, 1});
}

void write_fake_answer(const Job& job, std::vector<DetectorAnswer> detectors,
                       const std::string& truth_contacts = "") {
  SceneAnswer answer;
  answer.scene.id = "fake";
  answer.scene.frames = 9;
  answer.scene.contact_frames = 4;
  answer.contact_frames.assign(9, true);
  answer.truth_contacts = truth_contacts;
  answer.detectors = std::move(detectors);
  for (const Turn& turn : job.turns)
    answer.timed.push_back({turn, "", {}, false, fake_pass(turn), {}});
  contactcheck::suite::write_answer(job.answer_file, answer);
}

DetectorAnswer answer_of(const Job& job, std::uint32_t position) {
  DetectorAnswer answer;
  answer.position = position;
  answer.run.scene = "fake";
  answer.run.detector = job.settings.detectors[position];
  return answer;
}

// The answer of a worker whose detector 0 refused the scene and whose others were left out.
void write_answer(const Job& job) {
  DetectorAnswer answer = answer_of(job, 0);
  answer.run.status = results::Status::kRefused;
  write_fake_answer(job, {answer});
}

// The answer of a worker whose detectors all worked; each missed triangles 2 and 5 in frame 3.
void write_listed_answer(const Job& job) {
  std::vector<DetectorAnswer> answers;
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (std::find(job.skip.begin(), job.skip.end(), i) != job.skip.end()) continue;
    DetectorAnswer& answer = answers.emplace_back(answer_of(job, i));
    answer.run.semantics.questions = {Question::kTriangles};
    answer.run.per_frame = {Level::kTriangle, {1}, {1}, {0}, {}, {}};
    answer.answers = {{Question::kTriangles, {judge::AnswerFingerprint{}}}};
    answer.contacts = judge::detector_contacts(answer.run, {}, {{3, {1, {{0, 1, 2, 5}}}, {}}});
  }
  write_fake_answer(job, answers, R"([{"frame":3,"count":1,"pairs":[0,2,1,5]}])");
}

// Whether a process that times has what was judged of the detectors that have a turn in it, and of
// no others.
bool has_answers_of_its_turns(const Job& job) {
  for (std::uint32_t i = 0; i < job.settings.detectors.size(); ++i) {
    const bool timed = std::any_of(job.turns.begin(), job.turns.end(),
                                   [&](const Turn& turn) { return turn.position == i; });
    if (job.answers.at(i).empty() == timed) return false;
  }
  return true;
}

// A real worker that need not judge ends every detector in the error that it was given.
void write_unjudged_answer(const Job& job) {
  std::vector<DetectorAnswer> answers;
  for (std::uint32_t i = 0; i < job.settings.detectors.size(); ++i) {
    DetectorAnswer& answer = answers.emplace_back(answer_of(job, i));
    answer.run.status = results::Status::kError;
    answer.run.message = job.unjudged->why;
    answer.run.failed_frame = job.unjudged->frame;
  }
  write_fake_answer(job, answers);
}

int act(const std::string& what, process::ProgressWriter& progress) {
  const auto finish = [&] {
    progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kDone);
  };
  if (what == "crash") die(SIGSEGV);
  if (what == "abort") die(SIGABRT);
  if (what == "hang") sleep(60);
  if (what == "allocate") allocate_for_ever();
  if (what == "allocate away") allocate_away();
  if (what == "refuse") return 2;
  if (what == "leave") return 0;  // as a library that calls exit(0)
  if (what == "outside") {
    progress.enter(process::SharedProgress::kNoDetector, 3, process::Phase::kTruth);
    die(SIGSEGV);
  }
  if (what == "wild") {
    progress.enter(77, 3, process::Phase::kUpdate);
    die(SIGSEGV);
  }
  if (what == "last words") {
    talk();
    die(SIGSEGV);
  }
  if (what == "talk") talk();
  if (what == "flood") flood();
  if (what == "read") read_input();
  if (what == "slowly") step_for_a_second(progress);
  finish();
  if (what == "crash late") die(SIGSEGV);
  if (what == "hang late") sleep(60);
  return 0;
}

int act_as_oracle(const std::string& what, const Job& job, process::ProgressWriter& progress) {
  progress.enter(process::SharedProgress::kNoDetector, 3, process::Phase::kTruth);
  if (what == "judge") die(SIGSEGV);
  if (!job.unjudged) allocate_for_ever();
  write_unjudged_answer(job);
  return act("answer", progress);
}

// What a job's scene is called: "outside" dies outside detectors unless detector 1 is left out,
// "always" dies whatever is left out, "later" dies in detector 1 in the second process,
// "second-pass" in the third, "well" nowhere; "answers" works and ends in exit code 2 where it is
// given other answers than those of its turns, "refuse" says that the input is bad, "oracle" and
// "judge" take too much memory and die where the oracle works, before any detector.
int act_for_suite(const Job& job, process::ProgressWriter& progress) {
  const std::string what = std::get<std::filesystem::path>(job.scene).stem().string();
  if (what == "refuse") {
    progress.enter(process::SharedProgress::kNoDetector, 0, process::Phase::kScene);
    std::fputs("contactcheck: the scene is bad\n", stderr);
    return 2;
  }
  if (what == "oracle" || what == "judge") return act_as_oracle(what, job, progress);
  begin(progress);
  const bool skipped = std::find(job.skip.begin(), job.skip.end(), 1u) != job.skip.end();
  if (what == "later" || what == "second-pass" || what == "well") {
    // The first process judges, each other one is a pass: SCENE.NUMBER.answer.
    const bool third = job.answer_file.stem().extension() == ".2";
    if (what == "later" && !job.turns.empty() && !skipped) return act("crash", progress);
    if (what == "second-pass" && third && !skipped) return act("abort", progress);
    write_listed_answer(job);
    return act("answer", progress);
  }
  if (what == "answers") {
    if (!job.turns.empty() && !has_answers_of_its_turns(job)) return 2;
    write_listed_answer(job);
    return act("answer", progress);
  }
  if (!skipped || what == "always") return act("outside", progress);
  write_answer(job);
  return act("answer", progress);
}

int act_on_job(const std::string& job_file, process::ProgressWriter& progress) {
  std::string what;
  std::ifstream in(job_file);
  std::getline(in, what);
  if (what.rfind('{', 0) == 0) return act_for_suite(read_job(job_file), progress);
  begin(progress);
  if (what == "crash with child") {
    leave_child(job_file);
    die(SIGSEGV);
  }
  if (what == "crash with child away") {
    leave_child(job_file, true);
    die(SIGSEGV);
  }
  if (what == "hang with child") {
    leave_child(job_file);
    sleep(60);
  }
  return act(what, progress);
}

}  // namespace
}  // namespace contactcheck::suite

int main(int argc, char** argv) {
  using namespace contactcheck;
  if (argc != 5 || std::strcmp(argv[1], "worker") != 0 ||
      std::strcmp(argv[3], "--progress-fd") != 0)
    return 64;
  process::SharedProgress none;
  process::SharedProgress* shared = process::join_supervisor(std::atoi(argv[4]), &none);
  if (shared == &none) return 65;
  process::ProgressWriter progress(shared);
  return suite::act_on_job(argv[2], progress);
}
