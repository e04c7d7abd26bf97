#include "reference/plugin/pipe_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "core/types/check.h"
#include "reference/process/process_tree.h"
#include "reference/text/printable.h"

namespace contactcheck::plugin {
namespace {

constexpr int kPollMilliseconds = 20;    // between two looks at the limits
constexpr int kLeaveMilliseconds = 500;  // for a command whose input has ended
constexpr int kPipeBytes = 1 << 20;      // of a pipe's buffer: fewer switches per frame
constexpr std::size_t kBlock = 1 << 16;
constexpr std::size_t kLongestErrorText = 1 << 16;

/// A pipe whose ends are closed here when they are not taken.
struct Pipe {
  int read = -1, write = -1;

  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw InputError(std::string("cannot make a pipe: ") + std::strerror(errno));
    // Out of the way of 0, 1 and 2, to which the child moves its ends: this program may have been
    // started with streams closed.
    read = fcntl(ends[0], F_DUPFD_CLOEXEC, 3);
    write = fcntl(ends[1], F_DUPFD_CLOEXEC, 3);
    const int error = errno;
    close(ends[0]);
    close(ends[1]);
    if (read < 0 || write < 0) {
      close_ends();
      throw InputError(std::string("cannot make a pipe: ") + std::strerror(error));
    }
    if (write >= 0) fcntl(write, F_SETPIPE_SZ, kPipeBytes);  // refused: it stays as it is
  }
  ~Pipe() { close_ends(); }
  void close_ends() const {
    for (const int end : {read, write})
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

int taken(int& end) {
  const int out = end;
  end = -1;
  return out;
}

/// Writing to a command that has ended is an error code here, not a signal that ends the worker.
class NoBrokenPipeSignal {
 public:
  NoBrokenPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t waiting;
    sigemptyset(&waiting);
    sigpending(&waiting);
    was_waiting_ = sigismember(&waiting, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoBrokenPipeSignal() {
    constexpr timespec kAtOnce = {0, 0};
    if (!was_waiting_)
      while (sigtimedwait(&pipe_, nullptr, &kAtOnce) < 0 && errno == EINTR) {
      }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoBrokenPipeSignal(const NoBrokenPipeSignal&) = delete;
  NoBrokenPipeSignal& operator=(const NoBrokenPipeSignal&) = delete;

 private:
  sigset_t pipe_ = {}, before_ = {};
  bool was_waiting_ = false;
};

ssize_t write_some(int fd, std::string_view bytes) {
  const NoBrokenPipeSignal guard;
  return write(fd, bytes.data(), bytes.size());
}

// Whether the shell has something to do but to start one program: operators, expansions. What
// stands in quotes is text, a path with parentheses for one.
bool has_operators(const std::string& command) {
  char quote = '\0';
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (c == '\\' && quote != '\'') {
      ++i;
    } else if (quote == '\0' && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = '\0';
    } else if (quote != '\'' && std::strchr(quote == '"' ? "$`" : ";&|<>(){}$`\n!", c) != nullptr) {
      return true;
    }
  }
  return false;
}

// A shell that waits for one program would hold its output open and translate its end.
std::string for_shell(const std::string& command) {
  const std::size_t begin = command.find_first_not_of(" \t");
  if (begin == std::string::npos) return command;
  const std::string first = command.substr(begin, command.find_first_of(" \t", begin) - begin);
  const bool the_shells = first.find('=') != std::string::npos || first == "exec" || first == "." ||
                          first == "eval" || first == "command";
  return the_shells || has_operators(command) ? command : "exec " + command;
}

void drop_blank_end(std::string& text) { text.erase(text.find_last_not_of(" \t\r\n") + 1); }

// The last line `File "mine.py", line 7, in update` of a Python traceback.
std::string traceback_place(const std::string& text) {
  const std::size_t found = text.rfind("\n  File \"");
  return found == std::string::npos ? "" : text::printable_line(text.substr(found));
}

struct LastWords {
  std::string cause, place;
};

// Drops the last line if it begins so.
bool drop_last_line(const char* beginning, std::string& text) {
  const std::size_t line = text.rfind('\n') + 1;  // 0 for the only line
  if (text.compare(line, std::strlen(beginning), beginning) != 0) return false;
  text.erase(line);
  drop_blank_end(text);
  return true;
}

// Node.js ends with its version. Above it, behind an empty line, stands `TypeError: no such model`,
// then the calls, the innermost first, and what else the error has.
LastWords last_words_of_node(std::string text) {
  constexpr const char* kCall = "\n    at ";
  drop_last_line("(Use `node ", text);
  const std::size_t error = text.rfind("\n\n");
  const std::size_t call = error == std::string::npos ? error : text.find(kCall, error);
  if (call == std::string::npos)
    return {text::printable_line(text.substr(text.rfind('\n') + 1)), ""};
  std::string place = text::printable_line(text.substr(call + std::strlen(kCall)));
  if (place.ends_with(" {")) place.resize(place.size() - 2);
  return {text::printable_line(text.substr(error + 2)), std::move(place)};
}

LastWords last_words_of(std::string text) {
  drop_blank_end(text);
  if (drop_last_line("Node.js v", text)) return last_words_of_node(std::move(text));
  // Of V8, which then lists its own functions.
  if (const std::size_t fatal = text.rfind("\nFATAL ERROR: "); fatal != std::string::npos)
    return {text::printable_line(text.substr(fatal + 1)), ""};
  const std::size_t end = text.find_last_of('\n');
  return {text::printable_line(text.substr(end + 1)),
          end == std::string::npos ? "" : traceback_place(text.substr(0, end))};
}

// Between fork and exec: system calls alone. A library may have changed what is inherited.
[[noreturn]] void become(const char* command, int input, int output, int errors, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);
  process::adopt_orphans();  // they end with it, and not with another command
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0u,
              0);  // the command must not inherit what this process has open
  signal(SIGPIPE, SIG_DFL);
  signal(SIGXFSZ, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execl("/bin/sh", "sh", "-c", command, static_cast<char*>(nullptr));
  _exit(127);
}

}  // namespace

PipeProcess::PipeProcess(const std::string& command, const PipeLimits& limits)
    : limits_(limits), errors_("contactcheck-command-errors") {
  fcntl(errors_.fd(), F_SETFL, O_APPEND);
  Pipe input, output;
  start(command, input.read, output.write);
  input_ = taken(input.write);
  output_ = taken(output.read);
  fcntl(input_, F_SETFL, O_NONBLOCK);
}

void PipeProcess::start(const std::string& command, int input, int output) {
  const pid_t parent = getpid();
  const std::string text = for_shell(command);
  const pid_t pid = fork();
  if (pid == 0) become(text.c_str(), input, output, errors_.fd(), parent);
  if (pid < 0) throw InputError("cannot start \"" + command + "\": " + std::strerror(errno));
  setpgid(pid, pid);  // whoever comes first; after exec the child has done it
  child_.started(pid);
}

PipeProcess::~PipeProcess() {
  close_input();
  resume();
  if (!ends_within(kLeaveMilliseconds)) kill();
  child_.end_orphans();  // what it has left behind
  close(output_);
}

void PipeProcess::kill() {
  if (reaped_) return;
  process::kill_tree(child_.pid());
  while (waitpid(child_.pid(), &status_, 0) < 0 && errno == EINTR) {
  }
  reaped_ = true;
  child_.end_orphans();
}

// Until it is reaped, no other group can have its number.
void PipeProcess::pause() {
  if (!reaped_ && !paused_) paused_ = ::kill(-child_.pid(), SIGSTOP) == 0;
}

void PipeProcess::resume() {
  if (!reaped_ && paused_) ::kill(-child_.pid(), SIGCONT);
  paused_ = false;
}

void PipeProcess::close_input() {
  if (input_ >= 0) close(taken(input_));
}

bool PipeProcess::ends_within(int milliseconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(milliseconds);
  while (!reaped_) {
    reaped_ = waitpid(child_.pid(), &status_, WNOHANG) == child_.pid();
    if (reaped_ || Clock::now() > end) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return reaped_;
}

void PipeProcess::send(std::string_view bytes) {
  resume();
  while (!bytes.empty()) {
    short ready = 0;
    if (wait_for(POLLOUT, &ready)) read_more();
    if (buffer_.size() > limits_.unasked)
      fail("wrote more than " + std::to_string(limits_.unasked >> 10) +
           " KiB that it was not asked for");
    if (ready == 0) continue;
    const ssize_t written = write_some(input_, bytes.substr(0, kBlock));
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno == EPIPE) fail_ended();
  }
}

std::string PipeProcess::receive_line() {
  std::size_t searched = 0, end = 0;
  while ((end = buffer_.find('\n', searched)) == std::string::npos) {
    searched = buffer_.size();
    if (searched > limits_.line)
      fail("wrote a line of more than " + std::to_string(limits_.line >> 10) + " KiB");
    read_more();
  }
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end + 1);
  return line;
}

std::string PipeProcess::receive(std::size_t bytes) {
  while (buffer_.size() < bytes) read_more();
  std::string out = buffer_.substr(0, bytes);
  buffer_.erase(0, bytes);
  return out;
}

// True when its output can be read; `ready`: what its input is ready for.
bool PipeProcess::wait_for(short input_events, short* ready) const {
  std::array<pollfd, 2> both = {pollfd{output_, POLLIN, 0}, pollfd{input_, input_events, 0}};
  const nfds_t count = input_events == 0 ? 1 : 2;
  poll(both.data(), count, kPollMilliseconds);  // timed out or interrupted: nothing is ready
  const auto now = std::chrono::steady_clock::now();
  if (now - checked_ >= std::chrono::milliseconds(kPollMilliseconds)) {
    checked_ = now;
    check_limits();
  }
  if (ready != nullptr) *ready = both[1].revents;
  return both[0].revents != 0;
}

void PipeProcess::read_more() {
  while (!wait_for(0, nullptr)) {
  }
  std::array<char, kBlock> block;
  const ssize_t size = read(output_, block.data(), block.size());
  if (size < 0 && errno == EINTR) return;
  if (size <= 0) fail_ended();
  buffer_.append(block.data(), static_cast<std::size_t>(size));
}

void PipeProcess::check_limits() const {
  if (errors_.size() > limits_.errors)
    fail("wrote more than " + std::to_string(limits_.errors >> 20) +
         " MiB to standard error (output limit)");
}

void PipeProcess::fail_ended() {
  close_input();
  if (ends_within(kLeaveMilliseconds))
    fail("ended with " + process::describe_status(status_) + last_words());
  fail("closed its standard output" + last_words());
}

void PipeProcess::fail(const std::string& what) const {
  throw std::runtime_error("the command " + what);
}

std::string PipeProcess::first_error_line() const {
  return text::printable_line(errors_.text(kLongestErrorText));
}

// An interpreter names the cause in the last line of many, and before it where that was.
std::string PipeProcess::last_words() const {
  const LastWords words = last_words_of(errors_.last_text(kLongestErrorText));
  if (words.cause.empty()) return "";
  return "; its last words: " + words.cause + (words.place.empty() ? "" : " (" + words.place + ")");
}

}  // namespace contactcheck::plugin
