#include "tests/faults/mutant_findings.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

namespace contactcheck::test {
namespace {

// Of the current case, for the signal handler: no memory may be allocated there.
std::array<char, 512> current_case = {};

void write_text(const char* text) {
  [[maybe_unused]] const auto written = write(STDOUT_FILENO, text, std::strlen(text));
}

extern "C" void name_case_and_exit(int signal) {
  write_text("FAULT ");
  write_text(current_case.data());
  write_text(signal == SIGXCPU ? ": does not end\n" : ": ends the program\n");
  _exit(1);
}

// What a mutant leaves undefined may ask for any amount of memory; the machine is not its own.
// Seen with mapping-last-lanes: ffd-lazy's collide() does not end where vertices of a leaf were
// never written, and what it has found grows by a gigabyte in seconds.
void limit_memory() {
  constexpr rlim_t kBytes = rlim_t{4} << 30;
  const rlimit limit = {kBytes, kBytes};
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

std::string MutantCase::text() const {
  return "scene=" + scene + " frame=" + std::to_string(frame) + " detector=" + detector +
         " level=" + level;
}

void MutantFindings::name_crashes(unsigned seconds) {
  for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
    std::signal(signal, name_case_and_exit);
  limit_memory();
  // Of the processor's time: that a machine has other work is no fault of the mutant.
  const rlimit limit = {seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &limit);
}

void MutantFindings::enter(const MutantCase& now) {
  now_ = now;
  const std::string text = now.text();
  const std::size_t length = std::min(text.size(), current_case.size() - 1);
  std::copy_n(text.begin(), length, current_case.begin());
  current_case[length] = '\0';
}

void MutantFindings::add(const std::string& what) { faults_.push_back(now_.text() + ": " + what); }

}  // namespace contactcheck::test
