#include "reference/report/speed_error_section.h"

#include <fmt/format.h>

#include <vector>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/report/speed_error.h"
#include "reference/report/speed_error_plot.h"

namespace contactcheck::report {

const std::vector<Column>& speed_error_columns() {
  static const std::vector<Column> columns = {
      {"detector", true, ""}, {"question timed", true, ""}, {"ms/frame", false, ""},
      {"passes", false, ""},  {"level", true, ""},          {"truth", false, ""},
      {"missed", false, ""},  {"reported", false, ""},      {"spurious", false, ""},
      {"error", false, ""},   {"on the front", true, ""}};
  return columns;
}

std::vector<std::string> speed_error_cells(const SpeedErrorPoint& p) {
  return {p.detector,
          name_of(p.question),
          format_number(p.ms) + p.timed.cut_text(),
          format_counts(p.timed.passes),
          name_of(p.level),
          format_count(p.truth),
          format_count(p.missed),
          format_count(p.reported),
          format_count(p.spurious),
          format_error_rate(p.error),
          p.on_front ? "yes" : ""};
}

std::string speed_error_markdown(const results::Results& results) {
  const SpeedError chart = speed_error(results);
  if (chart.points.empty()) return "";
  std::string left_out = left_out_sentence(chart);
  if (!left_out.empty()) left_out += "\n\n";
  TitledTable table{"", "", speed_error_columns(), {}};
  for (const SpeedErrorPoint& point : chart.points) table.rows.push_back(speed_error_cells(point));
  return fmt::format(
             "## Speed against error\n\n![Every detector as a point: time per frame against share "
             "of errors]({})\n\nOver {}. A time is that of mapping, update and query in "
             "playback, the mean over all frames but the first. An error is the share of contacts "
             "missed or of "
             "reports spurious, whichever is worse, at the finest level judged in every scene. "
             "On the front: no other that answers the same question is faster without being "
             "worse.\n\n",
             kSpeedErrorFile, chart.scenes) +
         markdown_of(table) + left_out;
}

std::string speed_error_picture(const results::Results& results) {
  return speed_error_plot(speed_error(results), results.machine.cpu + ", " + results.machine.isa);
}

}  // namespace contactcheck::report
