#include <CLI/CLI.hpp>
#include <memory>

#include "reference/cli/arguments.h"
#include "reference/plugin/examination.h"
#include "reference/plugin/plugin.h"
#include "reference/queries/query_worker.h"
#include "reference/reduce/probe_worker.h"
#include "reference/suite/worker.h"

namespace contactcheck::cli {
namespace {

struct WorkerWords {
  std::string job;
  int fd = -1;
};

struct ProbeWords {
  std::string detector;
  std::vector<std::string> plugins;
  int fd = -1;
};

struct ExamineWords {
  std::string kind, text;
  int fd = -1;
};

void add_worker(CommandLine& line) {
  const auto words = std::make_shared<WorkerWords>();
  CLI::App* worker = line.app.add_subcommand("worker", "")->group("");
  worker->add_option("job", words->job)->required();
  worker->add_option("--progress-fd", words->fd);
  choose(*worker, line, [words, &line] {
    const std::vector<std::string> plugins = suite::read_job(words->job).settings.plugins;
    return suite::run_worker(words->job, plugin::with_plugins(line.catalog, plugins), words->fd);
  });
}

void add_probe(CommandLine& line) {
  const auto words = std::make_shared<ProbeWords>();
  CLI::App* probe = line.app.add_subcommand("probe", "")->group("");
  probe->add_option("detector", words->detector)->required();
  probe->add_option("--channel-fd", words->fd)->required();
  probe->add_option("--plugin", words->plugins)->allow_extra_args(false);
  choose(*probe, line, [words, &line] {
    return reduce::run_probe_worker(words->detector,
                                    plugin::with_plugins(line.catalog, words->plugins), words->fd);
  });
}

void add_examine(CommandLine& line) {
  const auto words = std::make_shared<ExamineWords>();
  CLI::App* examine = line.app.add_subcommand("examine", "")->group("");
  examine->add_option("kind", words->kind)->required();
  examine->add_option("--text", words->text)->required();
  examine->add_option("--answer-fd", words->fd)->required();
  choose(*examine, line, [words] {
    return plugin::run_examination({plugin::plugin_kind_from_name(words->kind), words->text},
                                   words->fd);
  });
}

void add_query_worker(CommandLine& line) {
  const auto words = std::make_shared<ProbeWords>();
  CLI::App* worker = line.app.add_subcommand("query-worker", "")->group("");
  worker->add_option("detector", words->detector)->required();
  worker->add_option("--page-fd", words->fd)->required();
  worker->add_option("--plugin", words->plugins)->allow_extra_args(false);
  choose(*worker, line, [words, &line] {
    return queries::run_query_worker(words->detector,
                                     plugin::with_plugins(line.catalog, words->plugins), words->fd);
  });
}

}  // namespace

void add_workers(CommandLine& line) {
  add_worker(line);
  add_probe(line);
  add_examine(line);
  add_query_worker(line);
}

}  // namespace contactcheck::cli
