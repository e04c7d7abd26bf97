#include <algorithm>
#include <cstdio>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/cli/report_folder.h"
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
    const auto kind = arguments.kind ? arguments.kind : queries::kind_of_file(target.file);
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

std::vector<queries::FileScore> judge_files(const QueriesArguments& arguments,
                                            const std::vector<ImpactDetectorInfo>& detectors) {
  std::vector<queries::FileScore> scores;
  for (const queries::QueryTargets& target : targets_of(arguments)) {
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
  const std::vector<queries::FileScore> scores =
      arguments.families ? judge_families(detectors) : judge_files(arguments, detectors);
  const bool errors = std::any_of(scores.begin(), scores.end(), [](const auto& score) {
    return std::any_of(score.detectors.begin(), score.detectors.end(),
                       [](const auto& detector) { return detector.errors > 0; });
  });
  write_report(arguments.out, {{"queries.json", queries::json_of(scores)}});
  std::printf("\n%s\n", (arguments.out / "queries.json").c_str());
  return errors ? process::kExitUnlistedError : 0;
}

}  // namespace contactcheck::cli
