#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/process/exit_codes.h"
#include "reference/queries/query_judge.h"
#include "reference/queries/query_report.h"
#include "reference/text/lists.h"

namespace contactcheck::cli {
namespace {

std::vector<ImpactDetectorInfo> chosen_detectors(const std::vector<std::string>& names) {
  const std::vector<ImpactDetectorInfo> all = adapters::standard_impact_detectors();
  if (names.empty()) return all;
  std::vector<ImpactDetectorInfo> chosen;
  for (const std::string& name : names) {
    const auto named = [&](const ImpactDetectorInfo& info) { return info.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), named);
    if (found == all.end())
      throw InputError("no detector of queries is named \"" + name + "\"; there are " +
                       text::joined(all, [](const ImpactDetectorInfo& info) { return info.name; }));
    if (std::none_of(chosen.begin(), chosen.end(), named)) chosen.push_back(*found);
  }
  return chosen;
}

std::vector<queries::QueryTargets> targets_of(const QueriesArguments& arguments) {
  if (!arguments.truths.empty() && arguments.truths.size() != arguments.files.size())
    throw InputError("--truth is needed once for each file, in their order, or not at all");
  std::vector<queries::QueryTargets> targets;
  for (std::size_t i = 0; i < arguments.files.size(); ++i) {
    queries::QueryTargets target;
    target.file = arguments.files[i];
    std::optional<ImpactKind> kind = queries::kind_of_file(target.file);
    if (!arguments.kind.empty())
      kind = arguments.kind == name_of(ImpactKind::edge_edge) ? ImpactKind::edge_edge
                                                              : ImpactKind::vertex_triangle;
    if (!kind)
      throw InputError(
          target.file.string() +
          ": neither its name (vf.csv, 326ee.csv) nor a folder (vertex-face, edge-edge) "
          "says of what kind its queries are; --kind does");
    target.kind = *kind;
    if (!arguments.truths.empty()) target.truth = arguments.truths[i];
    targets.push_back(std::move(target));
  }
  return targets;
}

/// Where `out` will be made there is a folder that takes it: what is judged is not lost in the end.
void check_place(const std::filesystem::path& out) {
  std::filesystem::path folder = std::filesystem::absolute(out);
  std::error_code ignored;
  while (!std::filesystem::exists(folder, ignored) && folder.has_relative_path())
    folder = folder.parent_path();
  if (!std::filesystem::is_directory(folder))
    throw InputError("--out " + out.string() + ": " + std::strerror(ENOTDIR));
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError("--out " + out.string() + ": cannot be written");
}

/// All files can be opened, before the first is judged.
void check_files(const std::vector<queries::QueryTargets>& targets) {
  for (const queries::QueryTargets& target : targets) {
    queries::QueryReader(target.file, target.kind);
    if (target.truth) queries::read_truth(*target.truth);
  }
}

std::vector<queries::FileScore> judge_files(const QueriesArguments& arguments,
                                            const std::vector<ImpactDetectorInfo>& detectors) {
  std::vector<queries::FileScore> scores;
  const std::vector<queries::QueryTargets> targets = targets_of(arguments);
  check_files(targets);
  for (const queries::QueryTargets& target : targets) {
    scores.push_back(queries::judge_queries(target, detectors));
    std::printf("%s%s", scores.size() > 1 ? "\n" : "", queries::text_of(scores.back()).c_str());
    std::fflush(stdout);
  }
  return scores;
}

std::vector<queries::FileScore> judge_families(const std::vector<ImpactDetectorInfo>& detectors) {
  std::vector<queries::FileScore> all;
  for (const queries::QueryFamily& family : queries::query_families()) {
    std::vector<queries::FileScore> scores;
    for (std::size_t i = 0; i < family.values.size(); ++i) {
      const std::vector<ImpactQuery> list = family.queries(family.values[i]);
      std::size_t given = 0;
      const auto next = [&](queries::FileQuery& query) {
        if (given == list.size()) return false;
        query.query = list[given++];
        query.line = given;
        return true;
      };
      scores.push_back(queries::judge_queries(family.id + "@" + std::to_string(i), family.kind,
                                              next, detectors));
    }
    std::printf("%s%s", all.empty() ? "" : "\n", queries::text_of(family, scores).c_str());
    std::fflush(stdout);
    all.insert(all.end(), scores.begin(), scores.end());
  }
  return all;
}

}  // namespace

int queries_command(const QueriesArguments& arguments) {
  if (arguments.families != arguments.files.empty())
    throw InputError("queries judges files, or with --families its own hard families: one of both");
  const std::vector<ImpactDetectorInfo> detectors = chosen_detectors(arguments.detectors);
  check_place(arguments.out);
  const std::vector<queries::FileScore> scores =
      arguments.families ? judge_families(detectors) : judge_files(arguments, detectors);
  const bool errors = std::any_of(scores.begin(), scores.end(), [](const auto& score) {
    return std::any_of(score.detectors.begin(), score.detectors.end(),
                       [](const auto& detector) { return detector.errors > 0; });
  });
  check_out(arguments.out);
  write_file_atomically(arguments.out / "queries.json", queries::json_of(scores));
  std::printf("\n%s\n", (arguments.out / "queries.json").c_str());
  return errors ? process::kExitUnlistedError : 0;
}

}  // namespace contactcheck::cli
