#include "reference/cli/ab_rounds.h"

#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "core/types/check.h"
#include "reference/results/results_file.h"
#include "reference/run/interrupts.h"
#include "reference/run/printable.h"
#include "reference/run/worker_process.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

constexpr auto kPollInterval = std::chrono::milliseconds(20);

/// One of the two builds.
class Build {
 public:
  Build(const AbSide& side, const AbArguments& arguments)
      : name_(side.name), program_(side.program), out_(fs::absolute(arguments.out) / side.name) {
    words_ = {"run", "--quiet", "--processes", "1"};
    if (arguments.frames > 0) add("--frames", std::to_string(arguments.frames));
    for (const std::string& detector : side.detectors) add("--detector", detector);
    add("--out", out_.string());
    words_.insert(words_.end(), arguments.targets.begin(), arguments.targets.end());
  }

  results::Results run() const {
    // What an earlier round has left must not pass for this one's.
    std::error_code ignored;
    fs::remove(out_ / "results.json", ignored);
    run_to_the_end();
    return results_in(out_ / "results.json");
  }

 private:
  void add(const char* flag, const std::string& value) {
    words_.push_back(flag);
    words_.push_back(value);
  }

  void run_to_the_end() const {
    const MemoryFile nothing("contactcheck-nothing");  // a descriptor that the program ignores
    WorkerProcess process(program_, words_, nothing.fd());
    InterruptGuard interrupts;
    while (!process.has_ended()) {
      std::this_thread::sleep_for(kPollInterval);
      if (!interrupts.interrupted()) continue;
      process.kill();
      process.reap();
      interrupts.pass_on();
    }
    const int status = process.reap();
    // 3: a detector ended in an error, which its row says; the results are whole.
    const bool done = WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 3);
    if (done) return;
    const std::string words = printable_line(process.error_text());
    throw InputError(name_ + " \"" + program_.string() + "\" ended in " + describe_status(status) +
                     (words.empty() ? "" : ": " + words));
  }

  std::string name_;
  fs::path program_, out_;
  std::vector<std::string> words_;
};

}  // namespace

std::vector<AbRound> run_rounds(const std::vector<AbSide>& sides, const AbArguments& arguments,
                                const std::function<void(std::size_t)>& on_round) {
  const Build base(sides.at(0), arguments), head(sides.at(1), arguments);
  std::vector<AbRound> rounds(arguments.rounds);
  for (std::size_t r = 0; r < rounds.size(); ++r) {
    on_round(r);
    const bool base_first = r % 2 == 0;
    if (base_first) rounds[r].base = base.run();
    rounds[r].head = head.run();
    if (!base_first) rounds[r].base = base.run();
  }
  return rounds;
}

}  // namespace contactcheck
