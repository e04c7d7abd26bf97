#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/reduce/probe_worker.h"
#include "reference/run/worker.h"

namespace contactcheck {
namespace {

struct WorkerWords {
  std::string job;
  int fd = -1;
};

struct ProbeWords {
  std::string detector;
  int fd = -1;
};

void add_worker(CommandLine& line) {
  const auto words = std::make_shared<WorkerWords>();
  CLI::App* worker = line.app.add_subcommand("worker", "")->group("");
  worker->add_option("job", words->job)->required();
  worker->add_option("--progress-fd", words->fd);
  choose(*worker, line, [words, &line] { return run_worker(words->job, line.catalog, words->fd); });
}

void add_probe(CommandLine& line) {
  const auto words = std::make_shared<ProbeWords>();
  CLI::App* probe = line.app.add_subcommand("probe", "")->group("");
  probe->add_option("detector", words->detector)->required();
  probe->add_option("--channel-fd", words->fd)->required();
  choose(*probe, line,
         [words, &line] { return run_probe_worker(words->detector, line.catalog, words->fd); });
}

}  // namespace

void add_workers(CommandLine& line) {
  add_worker(line);
  add_probe(line);
}

}  // namespace contactcheck
