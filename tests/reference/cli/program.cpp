#include "tests/reference/cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <utility>

#include "tests/support/files.h"

extern char** environ;

namespace contactcheck::test {
namespace {

int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

RunningProgram::RunningProgram(const std::filesystem::path& program,
                               const std::vector<std::string>& arguments) {
  const std::string out = (scratch_.folder() / "out").string(),
                    err = (scratch_.folder() / "err").string();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_CREAT | O_WRONLY, 0600);
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // A test that was started in the background may be deaf to interrupts; its programs are not.
  sigset_t interrupts;
  sigemptyset(&interrupts);
  for (const int number : {SIGINT, SIGQUIT, SIGTERM, SIGHUP}) sigaddset(&interrupts, number);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &interrupts);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawn(&pid_, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  EXPECT_EQ(error, 0) << "cannot start " << program;
  if (error != 0) pid_ = 0;
}

RunningProgram::~RunningProgram() {
  if (pid_ == 0) return;
  kill(pid_, SIGKILL);
  wait_for(pid_);
}

bool RunningProgram::has_ended() const {
  siginfo_t info = {};
  return pid_ == 0 ||
         (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          info.si_pid == pid_);
}

void RunningProgram::send(int signal) const {
  if (pid_ != 0) kill(pid_, signal);
}

Outcome RunningProgram::outcome() {
  if (pid_ == 0) return {};
  Outcome outcome;
  outcome.exit_code = wait_for(std::exchange(pid_, 0));
  outcome.out = text_of(scratch_.folder() / "out");
  outcome.err = text_of(scratch_.folder() / "err");
  return outcome;
}

Outcome run_program(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments) {
  return RunningProgram(program, arguments).outcome();
}

Outcome contactcheck_program(const std::vector<std::string>& arguments) {
  return run_program(CONTACTCHECK_PROGRAM, arguments);
}

}  // namespace contactcheck::test
