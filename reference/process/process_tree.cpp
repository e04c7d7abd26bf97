#include "reference/process/process_tree.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace contactcheck::process {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostProcesses = 4096;  // one that forks without end is not followed
constexpr int kMostRounds = 100;  // then one that forks faster than it is killed is given up

std::vector<const Child*>& all_of_this_process() {
  static std::vector<const Child*> all;
  return all;
}

void add_children(pid_t process, std::vector<pid_t>& out) {
  std::error_code gone;
  const fs::path tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : fs::directory_iterator(tasks, gone)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child && out.size() < kMostProcesses;) out.push_back(child);
  }
}

// 0 when it is gone.
std::uint64_t resident_bytes(pid_t process) {
  std::ifstream statm("/proc/" + std::to_string(process) + "/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// A zombie has a group and a name until it is waited for. True of one that is gone.
bool has_ended(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t state = text.rfind(')') + 2;  // behind a name in brackets
  return state >= text.size() || text[state] == 'Z' || text[state] == 'X';
}

std::vector<pid_t> children_of_this_process() {
  std::vector<pid_t> out;
  add_children(getpid(), out);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::vector<pid_t> process_tree(pid_t root) {
  std::vector<pid_t> tree = {root};
  for (std::size_t i = 0; i < tree.size(); ++i) add_children(tree[i], tree);
  return tree;
}

std::string descendant_outside_its_group() {
  for (const pid_t leader : children_of_this_process()) {
    if (getpgid(leader) != leader) continue;
    for (const pid_t process : process_tree(leader)) {
      if (getpgid(process) == leader || has_ended(process)) continue;
      std::ifstream file("/proc/" + std::to_string(process) + "/comm");
      if (std::string name; std::getline(file, name)) return name;
    }
  }
  return "";
}

std::uint64_t resident_bytes_of_tree(pid_t root) {
  std::uint64_t sum = 0;
  for (const pid_t process : process_tree(root)) sum += resident_bytes(process);
  return sum;
}

void kill_tree(pid_t root) {
  for (const pid_t process : process_tree(root)) kill(process, SIGKILL);
}

void adopt_orphans() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

Child::Child() : before_(children_of_this_process()) {
  adopt_orphans();
  all_of_this_process().push_back(this);
}

Child::~Child() { std::erase(all_of_this_process(), this); }

// What a killed orphan has started becomes a child in its turn, so a round follows until there is
// none. Nothing else can have the number of a child that has not been reaped.
void Child::end_orphans() const {
  for (int round = 0; round < kMostRounds; ++round) {
    bool any = false;
    for (const pid_t child : children_of_this_process()) {
      if (std::binary_search(before_.begin(), before_.end(), child) ||
          std::ranges::any_of(all_of_this_process(), [&](const Child* each) {
            return each != this && each->pid_ == child;
          }))
        continue;
      if (kill(child, SIGKILL) != 0) continue;  // another user's
      any = true;
      while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
    if (!any) return;
  }
}

}  // namespace contactcheck::process
