#include "reference/report/origin.h"

#include <fmt/format.h>

#include <set>

#include "reference/report/run_row.h"

namespace contactcheck {

std::vector<std::string> machine_lines(const results::Results& results) {
  const results::Machine& m = results.machine;
  std::string libraries;
  for (const auto& [name, version] : results.libraries)
    libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  std::vector<std::string> out = {
      fmt::format("command: `{}`", results.command),
      fmt::format("machine: {}, {} cores, {}, {}", m.cpu, m.cores, m.isa, m.os),
      fmt::format("built with {}, {}", m.compiler, m.build), "libraries: " + libraries,
      fmt::format("contactcheck {}, schema {}", results.version, results::kSchema)};
  if (const std::string line = timing_line(results); !line.empty()) out.push_back(line);
  return out;
}

std::string timing_line(const results::Results& results) {
  if (!results.timing) return "";
  const results::Timing& t = *results.timing;
  std::string out = fmt::format("timing: {}, {} in a fresh process that has judged nothing",
                                counted_passes(t.processes), t.processes == 1 ? "made" : "each");
  if (t.one_pass_beyond > 0.0 && t.processes > 1)
    out += fmt::format("; a detector whose pass takes over {:g} s has 1", t.one_pass_beyond);
  out += fmt::format("; order drawn by seed {}", t.seed);
  Range cold;
  for (const results::Scene& scene : results.scenes)
    if (!scene.cold_frames.empty()) cold.add(static_cast<double>(scene.cold_frames.size()));
  if (cold.low)
    out += fmt::format("; cold: {} {} of each scene after a sweep of {:g} MiB", format_counts(cold),
                       *cold.high > 1.0 ? "frames" : "frame",
                       static_cast<double>(t.sweep_bytes) / 1048576.0);
  return out;
}

std::vector<std::string> part_sentences(const results::Results& results) {
  std::vector<std::string> out;
  if (results.shard)
    out.push_back(fmt::format(
        "Shard {} of {}: {} of the {} scenes of `{}`; `contactcheck merge` puts the shards "
        "together.",
        results.shard->index, results.shard->of, results.scenes.size(),
        results.shard->scenes.size(), results.shard->command));
  else if (!results.merged.empty())
    out.push_back(
        fmt::format("Put together from {} shards (`contactcheck merge`).", results.merged.size()));
  std::string resumed;
  for (const std::string& scene : results.resumed.value_or(std::vector<std::string>{}))
    resumed += (resumed.empty() ? "" : ", ") + scene;
  // Their times are of another process than the others'.
  if (!resumed.empty())
    out.push_back(fmt::format(
        "Taken over from an earlier run that was interrupted (`--resume`), with the times measured "
        "then: {}.",
        resumed));
  return out;
}

TitledTable semantics_table(const results::Results& results) {
  TitledTable out{"What each detector claims",
                  "A level that is not claimed is not judged.",
                  {{"detector", true, ""}, {"options", true, ""}, {"claims", true, ""}},
                  {}};
  std::set<std::string> seen;
  for (const results::Run& run : results.runs)
    if (run.ok() && !run.semantics.levels.empty() && seen.insert(run.detector).second)
      out.rows.push_back({run.detector, options_text(run.options), semantics_text(run.semantics)});
  return out;
}

}  // namespace contactcheck
