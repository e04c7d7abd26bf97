// Stands in for `contactcheck worker JOB --progress-fd FD`: tells the shared page that it is in
// detector 1, frame 7, phase update, and then does what its job file's one word says.
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "reference/run/shared_progress.h"

namespace contactcheck {
namespace {

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

void step_for_a_second(ProgressWriter& progress) {
  for (int i = 0; i < 20; ++i) {
    progress.enter(1, 7, Phase::kUpdate);
    progress.part(0.5);
    usleep(50'000);
  }
}

int act(const std::string& what, ProgressWriter& progress) {
  const auto finish = [&] { progress.enter(SharedProgress::kNoDetector, 0, Phase::kDone); };
  if (what == "crash") die(SIGSEGV);
  if (what == "abort") die(SIGABRT);
  if (what == "hang") sleep(60);
  if (what == "allocate") allocate_for_ever();
  if (what == "refuse") return 2;
  if (what == "leave") return 0;  // as a library that calls exit(0)
  if (what == "outside") {
    progress.enter(SharedProgress::kNoDetector, 3, Phase::kTruth);
    die(SIGSEGV);
  }
  if (what == "slowly") step_for_a_second(progress);
  finish();
  if (what == "crash late") die(SIGSEGV);
  return 0;
}

}  // namespace
}  // namespace contactcheck

int main(int argc, char** argv) {
  using namespace contactcheck;
  if (argc != 5 || std::strcmp(argv[1], "worker") != 0 ||
      std::strcmp(argv[3], "--progress-fd") != 0)
    return 64;
  void* page = mmap(nullptr, sizeof(SharedProgress), PROT_READ | PROT_WRITE, MAP_SHARED,
                    std::atoi(argv[4]), 0);
  if (page == MAP_FAILED) return 65;
  ProgressWriter progress(static_cast<SharedProgress*>(page));
  progress.enter(1, 7, Phase::kUpdate);
  std::string what;
  std::ifstream job(argv[2]);
  std::getline(job, what);
  return act(what, progress);
}
