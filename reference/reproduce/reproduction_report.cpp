#include "reference/reproduce/reproduction_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/reproduce/reproduction.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& value) { return value.get<std::string>(); }

// Null is what was not measured.
std::optional<double> real(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}
std::optional<std::int64_t> whole(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<std::int64_t>());
}
std::optional<Ratio> ratio(const Json& value) {
  if (value.is_null()) return std::nullopt;
  return Ratio{value.at("ratio"), value.at("low"), value.at("high")};
}

// Names at the left, figures at the right.
std::string head(const std::vector<const char*>& titles) {
  std::vector<Column> columns;
  for (const char* title : titles) columns.push_back({title, columns.empty(), ""});
  return table_head(columns);
}

std::string counts_table(const Json& counts) {
  std::string out = head({"count", "paper", "ours", "difference"});
  for (const auto& [name, c] : counts.items())
    out += table_line({name, format_count(whole(c.at("paper"))), format_count(whole(c.at("ours"))),
                       fmt::format("{:+.2f} %", c.at("difference_percent").get<double>())});
  return out + "\n";
}

std::vector<std::string> time_cells(const Json& t) {
  if (t.is_null()) return {"-", "-", "-", "-", "-"};
  std::vector<std::string> cells;
  for (const char* part : {"mss", "cell", "test", "response", "total"})
    cells.push_back(format_number(real(t.at(part))));
  return cells;
}

std::string time_line(const std::string& method, const std::string& whose, const Json& times,
                      bool judged) {
  std::vector<std::string> cells = {method, whose};
  for (std::string& cell : time_cells(times)) cells.push_back(std::move(cell));
  if (!judged || times.is_null()) {
    cells.insert(cells.end(), {"-", "-", "-"});
  } else {
    cells.push_back(text(times.at("level")));
    cells.push_back(fmt::format("{} of {}", format_count(whole(times.at("missed"))),
                                format_count(whole(times.at("truth")))));
    cells.push_back(format_count(whole(times.at("spurious"))));
  }
  return table_line(cells);
}

std::string times_table(const Json& steps) {
  std::string out = head({"method", "whose", "MSS", "CELL", "collision test", "response", "total",
                          "level", "missed", "spurious"});
  for (const Json& row : steps) {
    const Json& paper = row.at("paper_reports");
    if (!paper.is_null())
      out +=
          time_line(text(row.at("method")),
                    fmt::format("paper, {}, {}", text(paper.at("table")), text(paper.at("device"))),
                    paper, false);
    for (const MethodReading& reading : kReadings)
      out += time_line(text(row.at("method")), fmt::format("ours, {}", reading.id),
                       row.at(reading.id), true);
  }
  return out + "\n";
}

std::string ratios_table(const Json& ratios) {
  std::string out = head({"from", "to", "whose", "collision test", "frames per second",
                          "same contacts", "missed before, after"});
  for (const Json& row : ratios) {
    const Json& paper = row.at("paper_reports");
    const std::string from = text(row.at("before")), to = text(row.at("after"));
    if (!paper.is_null())
      out += table_line({from, to, "paper, " + text(paper.at("table")),
                         fmt::format("{:.2f}x", paper.at("test").get<double>()),
                         fmt::format("{:.3f}x", paper.at("total").get<double>()), "-", "-"});
    for (const MethodReading& reading : kReadings) {
      const Json& ours = row.at(reading.id);
      if (ours.is_null()) continue;
      out += table_line({from, to, fmt::format("ours, {}", reading.id),
                         format_ratio(ratio(ours.at("test")), true),
                         format_ratio(ratio(ours.at("total")), true),
                         ours.at("same_contacts").get<bool>() ? "yes" : "no",
                         fmt::format("{}, {}", format_count(whole(ours.at("missed_before"))),
                                     format_count(whole(ours.at("missed_after"))))});
    }
  }
  return out + "\n";
}

std::string closed_loop_line(const Json& loop) {
  if (!text(loop.at("error")).empty())
    return table_line({text(loop.at("detector")), text(loop.at("error")), "", "", "", "", "", ""});
  std::string recalls;
  for (const auto& [level, counts] : loop.at("levels").items())
    recalls += fmt::format("{}{} {}", recalls.empty() ? "" : ", ", level,
                           format_rate(real(counts.at("recall"))));
  return table_line(
      {text(loop.at("detector")), format_millimetres(real(loop.at("hover_at_rest_max"))),
       format_millimetres(real(loop.at("hover_at_rest_mean"))),
       format_millimetres(real(loop.at("deepest_penetration"))),
       format_number(real(loop.at("energy_gain"))), format_number(real(loop.at("last_speed"))),
       format_count(whole(loop.at("tunnelling_events"))), recalls});
}

std::string closed_loop_table(const Json& loops) {
  if (loops.empty()) return "";
  std::string out =
      "Closed loop: each detector drives the simulation itself, and is judged on the frames of its "
      "own motion. Hover at rest is the true distance of the pairs that it reports in the last "
      "tenth of the frames.\n\n" +
      head({"detector", "hover at rest mm, largest", "mean", "deepest penetration mm",
            "energy gain", "last speed m/s", "tunnelling", "recall"});
  for (const Json& loop : loops) out += closed_loop_line(loop);
  return out + "\n";
}

std::string frame_rate_line(const Json& rate) {
  if (rate.is_null()) return "";
  return fmt::format(
      "`{}`: {:.0f} whole steps per second, {:.1f} times real time, on one core.\n\n",
      text(rate.at("detector")), rate.at("steps_per_second").get<double>(),
      rate.at("simulated_over_real_time").get<double>());
}

std::string hover_line(const Json& hover) {
  if (hover.is_null()) return "";
  std::string out =
      fmt::format("At rest `{}` keeps the surfaces {} mm apart on average, `{}` {} mm", kMethods[2],
                  format_millimetres(real(hover.at(kMethods[2]))), kTraditional,
                  format_millimetres(real(hover.at(kTraditional))));
  if (!hover.at("factor").is_null())
    out += fmt::format(": {:.1f} times as far", hover.at("factor").get<double>());
  return out + ".\n\n";
}

std::string scene_section(const Json& scene) {
  std::string out =
      fmt::format("## {}\n\nScene `{}`, {} frames, {} with contact.\n\n", text(scene.at("scene")),
                  text(scene.at("ours")), format_count(whole(scene.at("frames"))),
                  format_count(whole(scene.at("contact_frames"))));
  out += counts_table(scene.at("counts"));
  out += "Milliseconds per whole step, timed in lockstep from the same states, cold.\n\n" +
         times_table(scene.at("steps"));
  out += ratios_table(scene.at("ratios"));
  for (const Json& sentence : scene.at("sentences")) out += "- " + text(sentence) + "\n";
  out += scene.at("sentences").empty() ? "" : "\n";
  return out + frame_rate_line(scene.at("frame_rate")) + hover_line(scene.at("hover_at_rest")) +
         closed_loop_table(scene.at("closed_loop"));
}

std::string means_section(const Json& means) {
  if (means.is_null()) return "";
  const Json &test = means.at("test_ratio"), &rate = means.at("frame_rate_ratio");
  std::string out = fmt::format(
      "## Means, two levels of spheres against one, bounds=safe ({} of the scenes)\n\n"
      "- collision test (geometric mean): ours {:.2f}x, the paper's {:.2f}x\n"
      "- frames per second (mean): ours {:.3f}x; the paper's totals give {:.3f}x",
      means.at("scenes").get<std::size_t>(), test.at("ours").get<double>(),
      test.at("paper").get<double>(), rate.at("ours").get<double>(),
      rate.at("paper").get<double>());
  if (!rate.at("paper_claims").is_null())
    out += fmt::format(", its text says {:.3f}x", rate.at("paper_claims").get<double>());
  return out + "\n\n";
}

std::string introduction(const Json& reproduction) {
  const Json& machine = reproduction.at("machine");
  std::string out = fmt::format(
      "# The paper's tables beside ours\n\n- command: `{}`\n- machine: {}, {} cores, {}, {}\n"
      "- contactcheck {}\n\nReadings of the method:\n\n",
      text(reproduction.at("command")), text(machine.at("cpu")),
      format_count(whole(machine.at("cores"))), text(machine.at("isa")), text(machine.at("os")),
      text(reproduction.at("version")));
  for (const MethodReading& reading : kReadings)
    out += fmt::format("- `{}`: {}\n", reading.id, reading.says);
  return out +
         "\nMSS is the deformation with gravity and ground; CELL maps every vertex and updates the "
         "detector's boxes and spheres. The paper's milliseconds are of phones of 2012: only "
         "ratios compare.\n\n";
}

}  // namespace

std::string reproduction_markdown(const Json& reproduction) {
  std::string out = introduction(reproduction) + means_section(reproduction.at("means"));
  for (const Json& scene : reproduction.at("scenes")) out += scene_section(scene);
  return out;
}

std::string reproduction_terminal(const Json& reproduction) {
  std::string out =
      fmt::format("  {:<10} {:<22} {:>9} {:>24} {:>24}  {}\n", "scene", "two levels over one",
                  "paper", "ours, safe", "ours, paper", "same contacts at safe");
  for (const Json& scene : reproduction.at("scenes"))
    for (const Json& row : scene.at("ratios")) {
      if (row.at("after") != kMethods[2] || row.at("safe").is_null()) continue;
      for (const char* part : {"test", "total"})
        out += fmt::format(
            "  {:<10} {:<22} {:>8.3f}x {:>24} {:>24}  {}\n", text(scene.at("scene")),
            part == std::string("test") ? "collision test" : "frames per second",
            row.at("paper_reports").at(part).get<double>(),
            format_ratio(ratio(row.at("safe").at(part)), true),
            row.at("paper").is_null() ? "-" : format_ratio(ratio(row.at("paper").at(part)), true),
            row.at("safe").at("same_contacts").get<bool>() ? "yes" : "no");
    }
  return out;
}

}  // namespace contactcheck
