#include "reference/report/tables/origin.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "reference/report/tables/run_row.h"
#include "reference/results/statistics.h"
#include "reference/text/lists.h"

namespace contactcheck::report {

std::string instruction_set(const std::string& isa) {
  return isa.starts_with("AVX3") ? "AVX-512" : isa;
}

std::vector<std::string> machine_lines(const results::Results& results) {
  const results::Machine& m = results.machine;
  const std::string libraries =
      text::joined(results.libraries, [](const auto& one) { return one.first + " " + one.second; });
  std::vector<std::string> out = {
      fmt::format("command: `{}`", results.command),
      fmt::format("machine: {}, {} cores, {}, {}", m.cpu, m.cores, instruction_set(m.isa), m.os),
      fmt::format("built with {}, {}", m.compiler, m.build), "libraries: " + libraries,
      fmt::format("contactcheck {}, schema {}", results.version, results::kSchema)};
  for (const std::string& line : {timing_line(results), steadiness_line(results)})
    if (!line.empty()) out.push_back(line);
  return out;
}

std::string timing_line(const results::Results& results) {
  if (!results.timing) return "";
  const results::Timing& t = *results.timing;
  std::string out = fmt::format("timing: {}, {} in a fresh process that has judged nothing",
                                counted_passes(t.processes), t.processes == 1 ? "made" : "each");
  if (t.one_pass_beyond > 0.0 && t.processes > 1)
    out += fmt::format(". A detector whose pass takes over {:g} s has 1", t.one_pass_beyond);
  out += fmt::format(". Order drawn by seed {}", t.seed);
  Range cold;
  for (const results::Scene& scene : results.scenes)
    if (!scene.cold_frames.empty()) cold.add(static_cast<double>(scene.cold_frames.size()));
  if (cold.low)
    out += fmt::format(". Cold: {} {} of each scene after a sweep of {:g} MiB", format_counts(cold),
                       *cold.high > 1.0 ? "frames" : "frame",
                       static_cast<double>(t.sweep_bytes) / 1048576.0);
  double taken = 0.0, wall = 0.0;
  for (const results::Run& run : results.runs)
    for (const results::QuestionTimes& times : run.times) {
      const double away = times.playback.taken.value_or(0.0);
      taken += away;
      wall += times.playback.frame + away;
    }
  if (taken > 0.0)
    out +=
        fmt::format(". {:.1f} % of the time was given to others by the machine, and is taken off",
                    100.0 * taken / wall);
  return out;
}

std::string steadiness_line(const results::Results& results) {
  std::size_t inside = 0, fewest = 0;
  std::vector<double> half_widths;
  for (const results::Run& run : results.runs)
    for (const results::QuestionTimes& times : run.times) {
      std::vector<double> ratios;
      for (std::size_t p = 0; p + 1 < times.pass_ms.size(); p += 2)
        ratios.push_back(times.pass_ms[p] / times.pass_ms[p + 1]);
      if (ratios.size() < results::kFewestForInterval) continue;
      const results::Ratio beside_itself = results::mean_ratio(ratios);
      inside += beside_itself.low <= 1.0 && 1.0 <= beside_itself.high;
      half_widths.push_back(std::sqrt(beside_itself.high / beside_itself.low) - 1.0);
      if (fewest == 0 || ratios.size() < fewest) fewest = ratios.size();
    }
  if (half_widths.empty()) return "";
  return fmt::format(
      "each detector beside itself, over {} pairs of passes: 1.00 lies inside {} of {} "
      "intervals of 95 %; their median half-width is {:.1f} %",
      fewest, inside, half_widths.size(), 100.0 * results::median(half_widths));
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
    out.push_back(fmt::format("Put together from {} shard{} (`contactcheck merge`).",
                              results.merged.size(), results.merged.size() == 1 ? "" : "s"));
  const std::string resumed = text::joined(results.resumed.value_or(std::vector<std::string>{}));
  // Their times are of another process than the others'.
  if (!resumed.empty())
    out.push_back(fmt::format(
        "Taken over from an earlier run (`--resume`), with the times measured then: {}.", resumed));
  return out;
}

}  // namespace contactcheck::report
