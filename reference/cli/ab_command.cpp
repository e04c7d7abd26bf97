#include <cstdio>

#include "core/types/check.h"
#include "reference/ab/ab_text.h"
#include "reference/cli/ab_rounds.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/github_job.h"
#include "reference/gate/github.h"
#include "reference/run/exit_codes.h"
#include "reference/run/out_lock.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

// Before anything runs: a summary that nobody can write would be noticed too late.
fs::path required_summary_file() {
  fs::path file = github_summary_file();
  if (file.empty())
    throw InputError("--github: the environment names no file in GITHUB_STEP_SUMMARY");
  return file;
}

void tell_github(const fs::path& file, const AbJudgement& judgement, const AbSetting& setting) {
  for (const std::string& failure : ab_failures(judgement, setting))
    std::fputs(github_annotation("error", "contactcheck ab", failure).c_str(), stdout);
  append_github_summary(file, ab_markdown(judgement, setting));
}

AbSetting setting_of(const AbArguments& arguments) {
  return {arguments.base.string(),
          arguments.head.string(),
          arguments.rounds,
          {arguments.slower_than, arguments.floor_us},
          arguments.accuracy_may_change};
}

}  // namespace

int ab_command(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const fs::path summary = arguments.github ? required_summary_file() : "";
  const std::vector<AbSide> sides = ab_sides(arguments, catalog);
  check_out(arguments.out);
  const OutLock lock(arguments.out);
  const std::vector<AbRound> rounds = run_rounds(sides, arguments, [&](std::size_t round) {
    if (!arguments.quiet) std::fprintf(stderr, "round %zu of %zu\n", round + 1, arguments.rounds);
  });
  const AbSetting setting = setting_of(arguments);
  const AbJudgement judgement = judge_ab(rounds, setting.limits);
  std::fputs(ab_text(judgement, setting).c_str(), stdout);
  if (arguments.github) tell_github(summary, judgement, setting);
  return setting.fails(judgement) ? kExitNo : 0;
}

}  // namespace contactcheck
