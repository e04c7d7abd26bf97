#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "core/types/check.h"
#include "reference/ab/ab_text.h"
#include "reference/cli/ab_rounds.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"

namespace contactcheck {
namespace {

// Before anything runs: a summary that nobody can write would be noticed too late.
std::string summary_file() {
  const char* const file = std::getenv("GITHUB_STEP_SUMMARY");
  if (file == nullptr || *file == '\0')
    throw InputError("--github: the environment names no file in GITHUB_STEP_SUMMARY");
  return file;
}

void append(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::app | std::ios::binary);
  out << text << std::flush;
  if (!out) throw InputError("cannot write " + file + ": " + std::strerror(errno));
}

// What stands for itself in a workflow command's message.
std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '%' || c == '\r' || c == '\n') {
      out += c == '%' ? "%25" : (c == '\r' ? "%0D" : "%0A");
    } else {
      out += c;
    }
  }
  return out;
}

void tell_github(const std::string& file, const AbJudgement& judgement, const AbSetting& setting) {
  for (const std::string& failure : ab_failures(judgement, setting))
    std::printf("::error title=contactcheck ab::%s\n", escaped(failure).c_str());
  append(file, ab_markdown(judgement, setting));
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
  const std::string summary = arguments.github ? summary_file() : "";
  const std::vector<AbSide> sides = ab_sides(arguments, catalog);
  check_out(arguments.out);
  const std::vector<AbRound> rounds = run_rounds(sides, arguments, [&](std::size_t round) {
    if (!arguments.quiet) std::fprintf(stderr, "round %zu of %zu\n", round + 1, arguments.rounds);
  });
  const AbSetting setting = setting_of(arguments);
  const AbJudgement judgement = judge_ab(rounds, setting.limits);
  std::fputs(ab_text(judgement, setting).c_str(), stdout);
  if (arguments.github) tell_github(summary, judgement, setting);
  return setting.fails(judgement) ? 1 : 0;
}

}  // namespace contactcheck
