#include "reference/report/formats/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "reference/report/tables/error_counts.h"
#include "reference/report/tables/hard_cases.h"
#include "reference/report/tables/headline.h"
#include "reference/report/tables/lattice_fits.h"
#include "reference/report/tables/origin.h"
#include "reference/report/tables/random_pairs.h"
#include "reference/report/tables/run_row.h"
#include "reference/report/tables/scene_choice.h"
#include "reference/report/tables/section.h"

namespace contactcheck::report {
namespace {
using Line = std::vector<std::string>;

constexpr const char* kRed = "\x1b[31m";
constexpr const char* kBold = "\x1b[1m";
constexpr const char* kReset = "\x1b[0m";
constexpr std::size_t kStatus = 1, kMessage = 2;
constexpr std::size_t kWidest = 100;  // characters of a line
constexpr std::ptrdiff_t kFewestJoined = 3;

std::vector<std::size_t> widths_of(const std::vector<Column>& columns,
                                   const std::vector<Line>& lines) {
  std::vector<std::size_t> widths;
  for (const Column& c : columns) widths.push_back(std::string(c.title).size());
  for (const Line& line : lines) {
    widths[0] = std::max(widths[0], line[0].size());
    for (std::size_t i = 1; !is_message(line) && i < line.size(); ++i)
      widths[i] = std::max(widths[i], line[i].size());
  }
  return widths;
}

std::string aligned(const std::string& text, std::size_t width, bool left) {
  return left ? fmt::format("{:<{}}", text, width) : fmt::format("{:>{}}", text, width);
}

std::string paint(const std::string& text, const char* code, bool color) {
  return color ? code + text + kReset : text;
}

bool is_error(const Column& column, const std::string& cell) {
  return column.role == Role::kErrors && cell != "0" && cell != "-";
}

std::string line_text(const std::vector<Column>& columns, const Line& line,
                      const std::vector<std::size_t>& widths, bool color) {
  std::string out = "  " + aligned(line[0], widths[0], true);
  if (is_message(line))
    return out + "  " + paint(line[kStatus], kRed, color) + "  " + line[kMessage] + "\n";
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::string cell = aligned(line[i], widths[i], columns[i].left);
    out += "  " + (is_error(columns[i], line[i]) ? paint(cell, kRed, color) : cell);
  }
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

bool has_value(const TitledTable& of, std::size_t column) {
  return std::any_of(of.rows.begin(), of.rows.end(),
                     [&](const Line& line) { return !is_message(line) && line[column] != "-"; });
}

std::size_t width_of(const TitledTable& of) {
  std::size_t width = 0;
  for (const std::size_t column : widths_of(of.columns, of.rows)) width += 2 + column;
  return width;
}

// Times of different questions do not compare: the column that tells them apart is then needed.
void keep_if_different_questions(TitledTable& of) {
  for (std::size_t i = 0; i < of.columns.size(); ++i) {
    if (of.columns[i].title != "question") continue;
    std::set<std::string> words;
    for (const Line& line : of.rows)
      if (!is_message(line)) words.insert(line[i]);
    if (words.size() > 1) of.columns[i].spare = 0;
  }
}

// Leaves out what has no value, and what the widest line has no room for.
void fit(TitledTable& of) {
  leave_out_untimed(of);
  keep_if_different_questions(of);
  const bool any_row =
      std::any_of(of.rows.begin(), of.rows.end(), [](const Line& l) { return !is_message(l); });
  for (std::size_t i = of.columns.size(); any_row && i-- > 0;)
    if (!has_value(of, i)) erase_column(i, of);
  while (width_of(of) > kWidest) {
    const auto most = std::ranges::max_element(of.columns, {}, &Column::spare);
    if (most->spare == 0) break;
    erase_column(static_cast<std::size_t>(most - of.columns.begin()), of);
  }
}

// A sentence that many rows share, once.
void join_messages(std::vector<Line>& rows) {
  const auto same = [](const Line& a, const Line& b) {
    return is_message(a) && is_message(b) && a[kStatus] == b[kStatus] && a[kMessage] == b[kMessage];
  };
  std::vector<Line> out;
  for (const Line& line : rows) {
    const auto equal = [&](const Line& other) { return same(line, other); };
    const auto count = std::count_if(rows.begin(), rows.end(), equal);
    if (count < kFewestJoined) {
      out.push_back(line);
    } else if (std::find_if(rows.begin(), rows.end(), equal)->front() == line.front()) {
      out.push_back(line);
      out.back().front() = fmt::format("{} detectors", count);
    }
  }
  rows = std::move(out);
}

std::string text_of(const TitledTable& of, bool color) {
  const std::vector<std::size_t> widths = widths_of(of.columns, of.rows);
  Line titles;
  for (const Column& c : of.columns) titles.emplace_back(c.title);
  std::string out = line_text(of.columns, titles, widths, false);
  for (const Line& line : of.rows) out += line_text(of.columns, line, widths, color);
  return out + "\n";
}

// "containment, vertex not judged: open (...)"; empty where they are judged.
std::string open_line(const results::Scene& scene) {
  std::string levels, why;
  for (const Level level : {Level::kContainment, Level::kVertex}) {
    const auto found = scene.truth.find(level);
    const auto* text =
        found == scene.truth.end() ? nullptr : std::get_if<std::string>(&found->second);
    if (text == nullptr) continue;
    levels += (levels.empty() ? "" : ", ") + std::string(name_of(level));
    why = *text;
  }
  return why.empty() ? "" : levels + " " + why;
}

std::string scene_head(const results::Scene& scene, bool color) {
  std::size_t triangles = 0;
  for (const results::SceneBody& body : scene.bodies) triangles += body.triangles;
  std::string more;
  for (const std::string& line : {pairs_line(scene), fits_line(scene), open_line(scene)})
    if (!line.empty()) more += "  " + line + "\n";
  const auto count = [](std::size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  return fmt::format("{}  {}\n  {}, {}, {}, {} with contact\n{}", paint(scene.id, kBold, color),
                     scene.title, count(scene.bodies.size(), "body", "bodies"),
                     count(triangles, "triangle", "triangles"),
                     count(scene.frames, "frame", "frames"), scene.contact_frames, more);
}

// The table shows the finest level. Where that is right and another is not, the verdict on the
// first line would seem to contradict it.
std::string errors_elsewhere(const results::Scene& scene, const results::Index& index) {
  std::string out;
  for (const results::Run* run : index.runs_of(scene.id)) {
    ErrorCounts finest;
    if (!run->ok() || !finest.add(*run, run->per_frame.level) || finest.missed > 0 ||
        finest.spurious > 0)
      continue;
    for (const auto& [level, counts] : run->levels)
      if (!counts.informative && counts.missed + counts.spurious > 0)
        out += fmt::format("  {} at level {}: {} missed, {} spurious\n", run->detector,
                           name_of(level), counts.missed, counts.spurious);
  }
  return out.empty() ? "" : out + "\n";
}

// What was noted about detectors from outside: their makers read the terminal.
std::string own_notes(const results::Results& results, const results::Scene& scene,
                      const results::Index& index) {
  std::string out;
  for (const results::Run* run : index.runs_of(scene.id))
    if (results.plugin_of(run->detector) != nullptr)
      for (const std::string& note : run->notes)
        out += fmt::format("  {}: {}\n", run->detector, note);
  return out.empty() ? "" : out + "\n";
}

}  // namespace

namespace {

std::string legend(const std::vector<Column>& columns) {
  std::size_t width = 0;
  for (const Column& column : columns) width = std::max(width, column.title.size());
  std::string out;
  for (const Column& column : columns)
    out += fmt::format("  {:<{}}  {}\n", column.title, width, column.meaning);
  return out;
}

}  // namespace

std::string column_legend() {
  ColumnMeanings meanings;
  meanings.add(result_columns());
  const results::Results none;
  meanings.add(hard_sums(results::Index(none)).columns);
  return legend(meanings.all());
}

std::string terminal_tables(const results::Results& results, bool color, bool explain) {
  const Headline headline = headline_of(results);
  std::string out = paint(headline.title, kBold, color) + "\n\n";
  const results::Index index(results);
  ColumnMeanings shown;
  const auto table = [&](TitledTable of) {
    join_messages(of.rows);
    fit(of);
    shown.add(of.columns);
    return text_of(of, color);
  };
  for (const results::Scene* scene : shown_scenes(results)) {
    if (scene->family) continue;
    TitledTable rows{"", "", result_columns(), {}};
    for (const results::Run* run : index.runs_of(scene->id))
      rows.rows.push_back(result_cells(*run));
    out += scene_head(*scene, color) + table(std::move(rows)) + errors_elsewhere(*scene, index) +
           own_notes(results, *scene, index);
    if (scene->sweep) out += "  time and errors against separation: report.md and report.html\n\n";
  }
  for (const Section* section : sections()) {
    if (section->terminal == nullptr) continue;
    for (TerminalPart& part : section->terminal(index)) {
      if (part.lines.empty() && part.table.rows.empty()) continue;
      out += paint(part.title, kBold, color) + (part.aside.empty() ? "" : "  " + part.aside) +
             "\n" + part.lines;
      out += part.table.rows.empty() ? "\n" : table(std::move(part.table));
    }
  }
  if (!headline.cheapest.empty())
    out += paint("cheapest without errors: " + headline.cheapest, kBold, color) + "\n\n";
  if (!explain) return out + "  report.md has all columns; --explain says what they mean\n";
  for (const std::string& line : {timing_line(results), steadiness_line(results)})
    if (!line.empty()) out += "  " + line + "\n\n";
  return out + legend(shown.all());
}

}  // namespace contactcheck::report
