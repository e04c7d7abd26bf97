#include "reference/reproduce/reproduction_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "reference/report/formats/markdown.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/origin.h"
#include "reference/reproduce/paper_report.h"
#include "reference/reproduce/reproduction.h"
#include "reference/text/lists.h"

namespace contactcheck::reproduce {
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
std::optional<results::Ratio> ratio(const Json& value) {
  if (value.is_null()) return std::nullopt;
  return results::Ratio{value.at("ratio"), value.at("low"), value.at("high")};
}

// Titles of words and of figures; the first column names what a row is of.
report::Column words(const char* title) { return {title, true, ""}; }
report::Column figures(const char* title) { return {title, false, ""}; }

report::TitledTable counts_table(const Json& counts) {
  report::TitledTable table = {
      "Counts", "", {words("count"), figures("paper"), figures("ours"), figures("difference")}, {}};
  for (const auto& [name, c] : counts.items())
    table.rows.push_back({name, report::format_count(whole(c.at("paper"))),
                          report::format_count(whole(c.at("ours"))),
                          fmt::format("{:+.2f} %", c.at("difference_percent").get<double>())});
  return table;
}

std::vector<std::string> time_row(const std::string& method, const std::string& whose,
                                  const Json& times, bool judged) {
  std::vector<std::string> cells = {method, whose};
  for (const char* part : {"mss", "cell", "test", "response", "total"})
    cells.push_back(times.is_null() ? "-" : report::format_number(real(times.at(part))));
  if (!judged || times.is_null()) {
    cells.insert(cells.end(), {"-", "-", "-"});
  } else {
    cells.push_back(text(times.at("level")));
    cells.push_back(fmt::format("{} of {}", report::format_count(whole(times.at("missed"))),
                                report::format_count(whole(times.at("truth")))));
    cells.push_back(report::format_count(whole(times.at("spurious"))));
  }
  return cells;
}

report::TitledTable times_table(const Json& steps) {
  report::TitledTable table = {
      "Milliseconds per whole step, timed in lockstep from the same states, cold",
      "",
      {words("method"), words("whose"), figures("MSS"), figures("CELL"), figures("collision test"),
       figures("response"), figures("total"), words("level"), figures("missed"),
       figures("spurious")},
      {}};
  for (const Json& row : steps) {
    const Json& paper = row.at("paper_reports");
    const std::string method = text(row.at("method"));
    if (!paper.is_null())
      table.rows.push_back(time_row(
          method, fmt::format("paper, {}, {}", text(paper.at("table")), text(paper.at("device"))),
          paper, false));
    for (const MethodReading& reading : kReadings)
      table.rows.push_back(
          time_row(method, fmt::format("ours, {}", reading.id), row.at(reading.id), true));
  }
  return table;
}

std::string paper_test(const Json& paper) {
  return fmt::format("{:.2f}x", paper.at("test").get<double>());
}
std::string paper_total(const Json& paper) {
  return fmt::format("{:.3f}x", paper.at("total").get<double>());
}

report::TitledTable ratios_table(const Json& ratios) {
  report::TitledTable table = {
      "From one method to the next: the time before over the time after",
      "",
      {words("from"), words("to"), words("whose"), figures("collision test"),
       figures("frames per second"), words("same contacts"), figures("missed before, after")},
      {}};
  for (const Json& row : ratios) {
    const Json& paper = row.at("paper_reports");
    const std::string from = text(row.at("before")), to = text(row.at("after"));
    if (!paper.is_null())
      table.rows.push_back({from, to, "paper, " + text(paper.at("table")), paper_test(paper),
                            paper_total(paper), "-", "-"});
    for (const MethodReading& reading : kReadings) {
      const Json& ours = row.at(reading.id);
      if (ours.is_null()) continue;
      table.rows.push_back(
          {from, to, fmt::format("ours, {}", reading.id),
           report::format_ratio_range(ratio(ours.at("test"))),
           report::format_ratio_range(ratio(ours.at("total"))),
           ours.at("same_contacts").get<bool>() ? "yes" : "no",
           fmt::format("{}, {}", report::format_count(whole(ours.at("missed_before"))),
                       report::format_count(whole(ours.at("missed_after"))))});
    }
  }
  return table;
}

report::TitledTable closed_loop_table(const Json& loops) {
  report::TitledTable table = {
      "Closed loop: each detector drives the simulation itself, and is judged on the frames of its "
      "own motion",
      "Hover at rest is the true distance of the pairs that it reports in the last tenth of the "
      "frames.",
      {words("detector"), figures("hover at rest mm, largest"), figures("mean"),
       figures("deepest penetration mm"), figures("energy gain"), figures("last speed m/s"),
       figures("tunnelling"), words("recall")},
      {}};
  for (const Json& loop : loops) {
    if (const std::string error = text(loop.at("error")); !error.empty()) {
      table.rows.push_back({text(loop.at("detector")), error, "", "", "", "", "", ""});
      continue;
    }
    const std::string recalls = text::joined(loop.at("levels").items(), [](const auto& level) {
      return level.key() + " " + report::format_rate(real(level.value().at("recall")));
    });
    table.rows.push_back({text(loop.at("detector")),
                          report::format_millimetres(real(loop.at("hover_at_rest_max"))),
                          report::format_millimetres(real(loop.at("hover_at_rest_mean"))),
                          report::format_millimetres(real(loop.at("deepest_penetration"))),
                          report::format_number(real(loop.at("energy_gain"))),
                          report::format_number(real(loop.at("last_speed"))),
                          report::format_count(whole(loop.at("tunnelling_events"))), recalls});
  }
  return table;
}

// How fast the bodies move and how close they rest; what was not measured is left out.
std::vector<std::string> motion_sentences(const Json& scene) {
  std::vector<std::string> out;
  if (const Json& rate = scene.at("frame_rate"); !rate.is_null())
    out.push_back(
        fmt::format("`{}`: {:.0f} whole steps per second, {:.1f} times real time, on one core.",
                    text(rate.at("detector")), rate.at("steps_per_second").get<double>(),
                    rate.at("simulated_over_real_time").get<double>()));
  if (const Json& hover = scene.at("hover_at_rest"); !hover.is_null()) {
    std::string sentence =
        fmt::format("At rest `{}` keeps the surfaces {} mm apart on average, `{}` {} mm",
                    kMethods[2], report::format_millimetres(real(hover.at(kMethods[2]))),
                    kTraditional, report::format_millimetres(real(hover.at(kTraditional))));
    if (!hover.at("factor").is_null())
      sentence += fmt::format(": {:.1f} times as far", hover.at("factor").get<double>());
    out.push_back(sentence + ".");
  }
  return out;
}

std::string scene_words(const Json& scene) {
  return fmt::format("`{}`, {} frames, {} with contact", text(scene.at("ours")),
                     report::format_count(whole(scene.at("frames"))),
                     report::format_count(whole(scene.at("contact_frames"))));
}

std::string markdown_list(const std::vector<std::string>& sentences) {
  std::string out;
  for (const std::string& sentence : sentences) out += "- " + sentence + "\n";
  return out.empty() ? "" : out + "\n";
}

// Below a scene's heading a table has no heading of its own, and only its first column is at the
// left.
std::string markdown_below(report::TitledTable table, const std::string& paragraph) {
  table.title.clear();
  table.text = paragraph;
  for (std::size_t i = 1; i < table.columns.size(); ++i) table.columns[i].left = false;
  return report::markdown_of(table);
}

std::string scene_section(const Json& scene) {
  const report::TitledTable times = times_table(scene.at("steps"));
  const report::TitledTable loops = closed_loop_table(scene.at("closed_loop"));
  std::string out =
      fmt::format("## {}\n\nScene {}.\n\n", text(scene.at("scene")), scene_words(scene)) +
      markdown_below(counts_table(scene.at("counts")), "") +
      markdown_below(times, times.title + ".") +
      markdown_below(ratios_table(scene.at("ratios")), "") +
      markdown_list(scene.at("sentences").get<std::vector<std::string>>());
  for (const std::string& sentence : motion_sentences(scene)) out += sentence + "\n\n";
  return out + markdown_below(loops, loops.title + ". " + loops.text);
}

// @pre there are means
std::string means_title(const Json& means) {
  return fmt::format("Means, two levels of spheres against one, bounds=safe ({} of the scenes)",
                     means.at("scenes").get<std::size_t>());
}

std::vector<std::string> means_lines(const Json& means) {
  const Json &test = means.at("test_ratio"), &rate = means.at("frame_rate_ratio");
  std::string rates =
      fmt::format("frames per second (mean): ours {:.3f}x; the paper's totals give {:.3f}x",
                  rate.at("ours").get<double>(), rate.at("paper").get<double>());
  if (!rate.at("paper_claims").is_null())
    rates += fmt::format(", its text says {:.3f}x", rate.at("paper_claims").get<double>());
  return {fmt::format("collision test (geometric mean): ours {:.2f}x, the paper's {:.2f}x",
                      test.at("ours").get<double>(), test.at("paper").get<double>()),
          std::move(rates)};
}

std::vector<std::string> reading_lines() {
  std::vector<std::string> out;
  for (const MethodReading& reading : kReadings)
    out.push_back(fmt::format("`{}`: {}", reading.id, reading.says));
  return out;
}

std::string introduction(const Json& reproduction) {
  const Json& machine = reproduction.at("machine");
  return fmt::format(
             "# The paper's tables beside ours\n\n- command: `{}`\n- machine: {}, {} cores, {}, "
             "{}\n- contactcheck {}\n\nReadings of the method:\n\n",
             text(reproduction.at("command")), text(machine.at("cpu")),
             report::format_count(whole(machine.at("cores"))),
             report::instruction_set(text(machine.at("isa"))), text(machine.at("os")),
             text(reproduction.at("version"))) +
         markdown_list(reading_lines()) +
         "MSS is the deformation with gravity and ground; CELL maps every vertex and updates the "
         "detector's boxes and spheres. The paper's milliseconds are of phones of 2012: only "
         "ratios compare.\n\n";
}

// Two levels over one is the paper's own step: a row per scene, ours beside the paper's.
report::TitledTable overview(const Json& scenes) {
  report::TitledTable table = {
      "Two levels of spheres over one: the paper's ratios beside ours", "", {words("scene")}, {}};
  for (const char* title : {"collision test: paper", "frames per second: paper"}) {
    table.columns.push_back(figures(title));
    for (const MethodReading& reading : kReadings)
      table.columns.push_back({fmt::format("ours, {}", reading.id), false, ""});
  }
  for (const Json& scene : scenes)
    for (const Json& row : scene.at("ratios")) {
      const Json& paper = row.at("paper_reports");
      if (row.at("after") != kMethods[2] || paper.is_null()) continue;
      std::vector<std::string> cells = {text(scene.at("scene"))};
      for (const char* part : {"test", "total"}) {
        cells.push_back(part == std::string("test") ? paper_test(paper) : paper_total(paper));
        for (const MethodReading& reading : kReadings) {
          const Json& ours = row.at(reading.id);
          cells.push_back(ours.is_null() ? "-" : report::format_ratio_range(ratio(ours.at(part))));
        }
      }
      table.rows.push_back(std::move(cells));
    }
  return table;
}

report::PaperPart::Scene scene_part(const Json& scene) {
  report::PaperPart::Scene out = {
      text(scene.at("scene")),
      scene_words(scene),
      scene.at("sentences").get<std::vector<std::string>>(),
      // What the paper is about comes first.
      {ratios_table(scene.at("ratios")), times_table(scene.at("steps")),
       counts_table(scene.at("counts")), closed_loop_table(scene.at("closed_loop"))}};
  for (std::string& sentence : motion_sentences(scene))
    out.sentences.push_back(std::move(sentence));
  return out;
}

}  // namespace

std::string reproduction_markdown(const Json& reproduction) {
  std::string out = introduction(reproduction);
  if (const Json& means = reproduction.at("means"); !means.is_null())
    out += "## " + means_title(means) + "\n\n" + markdown_list(means_lines(means));
  for (const Json& scene : reproduction.at("scenes")) out += scene_section(scene);
  return out;
}

report::PaperPart paper_part(const Json& reproduction) {
  report::PaperPart out;
  out.overview = overview(reproduction.at("scenes"));
  out.readings = reading_lines();
  if (const Json& means = reproduction.at("means"); !means.is_null()) {
    out.means_title = means_title(means);
    out.means = means_lines(means);
  }
  for (const Json& scene : reproduction.at("scenes")) out.scenes.push_back(scene_part(scene));
  out.own_numbers = own_numbers(reproduction.at("paper"));
  out.checks = checks_table(reproduction.at("paper"));
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
        out += fmt::format("  {:<10} {:<22} {:>8.3f}x {:>24} {:>24}  {}\n", text(scene.at("scene")),
                           part == std::string("test") ? "collision test" : "frames per second",
                           row.at("paper_reports").at(part).get<double>(),
                           report::format_ratio_range(ratio(row.at("safe").at(part))),
                           row.at("paper").is_null()
                               ? "-"
                               : report::format_ratio_range(ratio(row.at("paper").at(part))),
                           row.at("safe").at("same_contacts").get<bool>() ? "yes" : "no");
    }
  return out;
}

}  // namespace contactcheck::reproduce
