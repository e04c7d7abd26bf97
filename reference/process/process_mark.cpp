#include "reference/process/process_mark.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

// glibc 2.36 forgot to say so in the header itself.
extern "C" {
#include <sys/pidfd.h>
}

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

extern char** environ;

namespace contactcheck::process {
namespace {

constexpr const char* kVariable = "CONTACTCHECK_STARTED_BY=";
constexpr int kMostRounds = 100;  // then a process that forks faster than it is killed is given up
constexpr int kMostPauses = 20;   // for programs without an environment: about to have one?
constexpr useconds_t kPause = 1000;

std::string new_word() {
  std::random_device random;
  char text[32];
  std::snprintf(text, sizeof text, "%d-%08x%08x", getpid(), random(), random());
  return text;
}

// Empty for a process that is gone, a zombie, another user's, or in the middle of exec.
std::string environment_of(int process) {
  const std::string path = "/proc/" + std::to_string(process) + "/environ";
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return "";
  std::string text;
  std::array<char, 4096> block;
  for (ssize_t size = 0; (size = read(file, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(size));
  close(file);
  return text;
}

std::vector<int> all_processes() {
  std::vector<int> out;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/proc"), closedir);
  if (!folder) return out;
  while (const dirent* entry = readdir(folder.get())) {
    const int process = std::atoi(entry->d_name);
    if (process > 0 && process != getpid()) out.push_back(process);
  }
  return out;
}

// Clock ticks since the machine was started, as /proc gives them.
std::uint64_t ticks_now() {
  timespec now = {};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const auto per_second = static_cast<std::uint64_t>(sysconf(_SC_CLK_TCK));
  return static_cast<std::uint64_t>(now.tv_sec) * per_second +
         static_cast<std::uint64_t>(now.tv_nsec) * per_second / 1'000'000'000;
}

// Between two programs: exec has put the new one in place, and not yet its environment. (Kernel
// threads and zombies have no program.)
bool may_be_in_exec(int process, std::uint64_t since) {
  const std::string folder = "/proc/" + std::to_string(process);
  char first;
  if (readlink((folder + "/exe").c_str(), &first, 1) != 1) return false;
  std::ifstream file(folder + "/stat");
  std::string stat, word;
  std::getline(file, stat);
  // Field 22 is the start. The second, the name, ends with the last parenthesis.
  std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
  for (int field = 3; field <= 22; ++field) fields >> word;
  return fields && std::strtoull(word.c_str(), nullptr, 10) >= since;
}

}  // namespace

ProcessMark::ProcessMark() : word_(new_word()), made_(ticks_now()) {
  const std::string name = kVariable;
  std::string inherited;
  // None at all after clearenv().
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
    const std::string text = *variable;
    if (text.starts_with(name)) {
      inherited = text.substr(name.size()) + " ";
    } else {
      variables_.push_back(text);
    }
  }
  variables_.push_back(name + inherited + word_);
  for (std::string& variable : variables_) pointers_.push_back(variable.data());
  pointers_.push_back(nullptr);
}

void ProcessMark::kill_bearers() const {
  int pauses = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    bool any = false, unsure = false;
    for (const int process : all_processes()) {
      // The descriptor is taken first: what is killed is the process that was looked at, even where
      // its number has gone to another one meanwhile.
      const int descriptor = pidfd_open(process, 0);
      if (descriptor < 0) continue;
      const std::string environment = environment_of(process);
      if (environment.find(word_) != std::string::npos)
        any = pidfd_send_signal(descriptor, SIGKILL, nullptr, 0) == 0 || any;
      else if (environment.empty())
        unsure = unsure || may_be_in_exec(process, made_);
      close(descriptor);
    }
    if (any) continue;
    if (!unsure || pauses++ == kMostPauses) return;
    usleep(kPause);
  }
}

}  // namespace contactcheck::process
