#include "reference/run/process_mark.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

// glibc 2.36 forgot to say so in the header itself.
extern "C" {
#include <sys/pidfd.h>
}

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>

extern char** environ;

namespace contactcheck {
namespace {

constexpr const char* kVariable = "CONTACTCHECK_STARTED_BY=";
constexpr int kMostRounds =
    100;  // one that forks faster than it is killed is not followed for ever

std::string new_word() {
  std::random_device random;
  char text[32];
  std::snprintf(text, sizeof text, "%d-%08x%08x", getpid(), random(), random());
  return text;
}

// Empty for a process that is gone, a zombie, or another user's.
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

}  // namespace

ProcessMark::ProcessMark() : word_(new_word()) {
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
  for (int round = 0; round < kMostRounds && kill_bearers_once(); ++round) {
  }
}

// The descriptor is taken first: what is killed is the process that was looked at, even where its
// number has gone to another one meanwhile.
bool ProcessMark::kill_bearers_once() const {
  bool any = false;
  for (const int process : all_processes()) {
    const int descriptor = pidfd_open(process, 0);
    if (descriptor < 0) continue;
    if (bears(process)) any = pidfd_send_signal(descriptor, SIGKILL, nullptr, 0) == 0 || any;
    close(descriptor);
  }
  return any;
}

bool ProcessMark::bears(int process) const {
  return environment_of(process).find(word_) != std::string::npos;
}

}  // namespace contactcheck
