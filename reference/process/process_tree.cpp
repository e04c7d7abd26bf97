#include "reference/process/process_tree.h"

#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace contactcheck::process {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostProcesses = 4096;  // one that forks without end is not followed

void add_children(pid_t process, std::vector<pid_t>& out) {
  std::error_code gone;
  const fs::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : fs::directory_iterator(tasks, gone)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child && out.size() < kMostProcesses;) out.push_back(child);
  }
}

}  // namespace

std::vector<pid_t> process_tree(pid_t root) {
  std::vector<pid_t> tree = {root};
  for (std::size_t i = 0; i < tree.size(); ++i) add_children(tree[i], tree);
  return tree;
}

std::uint64_t resident_bytes(pid_t process) {
  std::ifstream statm("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t resident_bytes_of_tree(pid_t root) {
  std::uint64_t sum = 0;
  for (const pid_t process : process_tree(root)) sum += resident_bytes(process);
  return sum;
}

void kill_tree(pid_t root) {
  for (const pid_t process : process_tree(root)) kill(process, SIGKILL);
}

}  // namespace contactcheck::process
