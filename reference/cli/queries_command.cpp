#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/cli/command_checks.h"
#include "reference/cli/commands.h"
#include "reference/cli/own_detectors.h"
#include "reference/process/exit_codes.h"
#include "reference/queries/query_judge.h"
#include "reference/queries/query_pictures.h"
#include "reference/queries/query_report.h"
#include "reference/queries/query_worker.h"

namespace contactcheck::cli {
namespace {

queries::QueryDetector detector_of(const std::string& name, const OwnDetectors& own,
                                   const QueriesArguments& arguments) {
  const auto has_this_id = [&](const plugin::Plugin& plugin) {
    return plugin.declaration.id == name.substr(0, name.find(':'));
  };
  const auto plugin = std::ranges::find_if(own.plugins, has_this_id);
  // One of frames may be called as a detector of queries is: that one is not meant.
  if (plugin != own.plugins.end() && !plugin->declaration.impacts)
    throw InputError(plugin::described(plugin->source) + " answers no queries of moving elements");
  const DetectorSpec spec = own.catalog.parse_impact(name);
  const ImpactDetectorInfo& info = *own.catalog.find_impact(spec.id);
  if (plugin != own.plugins.end())
    return queries::worker_detector(info, spec, plugin::to_json(*plugin).dump(),
                                    std::filesystem::read_symlink("/proc/self/exe"),
                                    {arguments.call_limit, arguments.memory_limit_mib << 20});
  return queries::local_detector(info, spec);
}

/// Those that are named, each once; without any all of this program.
std::vector<queries::QueryDetector> chosen_detectors(const QueriesArguments& arguments,
                                                     const DetectorCatalog& catalog) {
  suite::RunSettings limits;
  limits.call_limit = arguments.call_limit;
  limits.memory_limit = arguments.memory_limit_mib << 20;
  OwnDetectors own = load_own_detectors(arguments.detectors, arguments.commands, limits, catalog);
  if (own.names.empty())
    for (const ImpactDetectorInfo& info : catalog.impact_detectors()) own.names.push_back(info.id);
  std::vector<queries::QueryDetector> chosen;
  for (const std::string& name : own.names) {
    queries::QueryDetector detector = detector_of(name, own, arguments);
    if (std::ranges::none_of(chosen, [&](const auto& c) { return c.name == detector.name; }))
      chosen.push_back(std::move(detector));
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
    if (!kind) {
      queries::QueryReader(target.file, ImpactKind::vertex_triangle);  // one that is not there
      throw InputError(
          target.file.string() +
          ": neither its name (vf.csv, 326ee.csv) nor a folder (vertex-face, edge-edge) "
          "says of what kind its queries are; --kind does");
    }
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

/// Prints what is found as it is found, and keeps it for the report.
class Printed {
 public:
  void add(const std::string& part) {
    const std::string lines = (text_.empty() ? "" : "\n") + part;
    std::fputs(lines.c_str(), stdout);
    std::fflush(stdout);
    text_ += lines;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::vector<queries::FileScore> judge_files(const QueriesArguments& arguments,
                                            const std::vector<queries::QueryDetector>& detectors,
                                            Printed& printed) {
  std::vector<queries::FileScore> scores;
  const std::vector<queries::QueryTargets> targets = targets_of(arguments);
  check_files(targets);
  for (const queries::QueryTargets& target : targets) {
    scores.push_back(queries::judge_queries(target, detectors, arguments.cap));
    printed.add(queries::text_of(scores.back()));
  }
  return scores;
}

std::vector<queries::FileScore> judge_families(const QueriesArguments& arguments,
                                               const std::vector<queries::QueryDetector>& detectors,
                                               Printed& printed) {
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
                                              next, detectors, arguments.cap));
    }
    printed.add(queries::text_of(family, scores));
    all.insert(all.end(), scores.begin(), scores.end());
  }
  printed.add(queries::summary_of(queries::query_families(), all));
  return all;
}

/// queries.md beside its pictures.
void write_report(const std::filesystem::path& out, const std::vector<queries::FileScore>& scores,
                  const ImpactTolerance& cap, const std::string& text) {
  std::string report = "# Detectors of moving elements\n\n";
  for (const auto& [name, picture] :
       {std::pair{"queries-times.svg", queries::time_error_picture(scores)},
        {"queries-cost.svg", queries::cost_picture(scores)}}) {
    std::error_code ignored;
    std::filesystem::remove(out / name, ignored);  // of another run
    if (picture.empty()) continue;
    write_file_atomically(out / name, picture);
    report += std::string("![](") + name + ")\n\n";
  }
  write_file_atomically(out / "queries.md", report + "```text\n" + text + "```\n");
  write_file_atomically(out / "queries.json", queries::json_of(scores, cap));
  std::printf("\n%s\n", (out / "queries.md").c_str());
}

}  // namespace

int queries_command(const QueriesArguments& arguments, const DetectorCatalog& catalog) {
  if (arguments.families != arguments.files.empty())
    throw InputError("queries judges files, or with --families its own hard families: one of both");
  const std::vector<queries::QueryDetector> detectors = chosen_detectors(arguments, catalog);
  check_place(arguments.out);
  Printed printed;
  const std::vector<queries::FileScore> scores = arguments.families
                                                     ? judge_families(arguments, detectors, printed)
                                                     : judge_files(arguments, detectors, printed);
  const bool errors = std::any_of(scores.begin(), scores.end(), [](const auto& score) {
    return std::any_of(score.detectors.begin(), score.detectors.end(),
                       [](const auto& d) { return d.errors > 0 || !d.failure.empty(); });
  });
  check_out(arguments.out);
  write_report(arguments.out, scores, arguments.cap, printed.text());
  return errors ? process::kExitUnlistedError : 0;
}

}  // namespace contactcheck::cli
