#include <cstdio>

#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
#include "reference/cli/run_and_report.h"
#include "reference/results/results_file.h"
#include "reference/suite/out_lock.h"
#include "reference/suite/shard_merge.h"

namespace contactcheck::cli {
namespace {

namespace fs = std::filesystem;

// Goals and known defects are this program's own words.
void require_own_version(const suite::ShardResults& shard) {
  const std::string& version = shard.results.version;
  if (version != CONTACTCHECK_VERSION)
    throw InputError(shard.file.string() + ": was written by contactcheck " + version +
                     ", and this is " CONTACTCHECK_VERSION
                     ": the program that ran the shards merges them");
}

// The merged results would take a shard's place, cases and all.
void require_other_folder(const suite::ShardResults& shard, const fs::path& out) {
  std::error_code none;  // without the folder they are not the same
  if (fs::equivalent(shard.folder().empty() ? "." : shard.folder(), out, none))
    throw InputError("--out " + out.string() + ": is the folder of shard " + shard.shard().name());
}

}  // namespace

int merge_command(const std::vector<std::string>& files, const fs::path& out) {
  std::vector<suite::ShardResults> given;
  for (const std::string& file : files) given.push_back({file, results::results_in(file)});
  const std::vector<suite::ShardResults> shards = suite::checked_shards(std::move(given));
  for (const suite::ShardResults& shard : shards) {
    require_own_version(shard);
    require_other_folder(shard, out);
  }
  check_out(out);
  const suite::OutLock lock(out);
  suite::SuiteOutcome outcome;
  const results::Results results =
      suite::merge_shards(shards, out, results::read_known_defects(hard_cases_folder()), &outcome);
  const auto reports = report_texts(results, out, all_report_formats());
  write_report(out, reports);
  std::printf("merged %zu shards, %zu scenes\n%s  %s\n", shards.size(), results.scenes.size(),
              (out / "results.json").c_str(), report_paths(out, reports).c_str());
  return exit_code_of(outcome);
}

}  // namespace contactcheck::cli
