#include "reference/report/speed_error_section.h"

#include <fmt/format.h>

#include <vector>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"
#include "reference/report/speed_error.h"
#include "reference/report/speed_error_plot.h"

namespace contactcheck {
namespace {

const std::vector<Column>& columns() {
  static const std::vector<Column> columns = {{"detector", true, ""},  {"question timed", true, ""},
                                              {"ms/frame", false, ""}, {"level", true, ""},
                                              {"truth", false, ""},    {"missed", false, ""},
                                              {"reported", false, ""}, {"spurious", false, ""},
                                              {"error", false, ""},    {"on the front", true, ""}};
  return columns;
}

std::vector<std::string> cells_of(const SpeedErrorPoint& p) {
  return {p.detector,
          name_of(p.question),
          format_number(p.ms),
          name_of(p.level),
          format_count(p.truth),
          format_count(p.missed),
          format_count(p.reported),
          format_count(p.spurious),
          format_error_rate(p.error),
          p.on_front ? "yes" : ""};
}

}  // namespace

std::string speed_error_markdown(const results::Results& results) {
  const SpeedError chart = speed_error(results);
  if (chart.points.empty()) return "";
  std::string rows, left_out = left_out_sentence(chart);
  for (const SpeedErrorPoint& point : chart.points) rows += table_line(cells_of(point));
  if (!left_out.empty()) left_out += "\n\n";
  return fmt::format(
             "## Speed against error\n\n![Every detector as a point: time per frame against share "
             "of errors]({})\n\nOver {}. A time is that of mapping, update and query with cold "
             "caches, the mean over all frames. An error is the share of contacts missed or of "
             "reports spurious, whichever is worse, at the finest level judged in every scene. "
             "On the front: no other that answers the same question is faster without being "
             "worse.\n\n",
             kSpeedErrorFile, chart.scenes) +
         table_head(columns()) + rows + "\n" + left_out;
}

std::string speed_error_picture(const results::Results& results) {
  return speed_error_plot(speed_error(results), results.machine.cpu + ", " + results.machine.isa);
}

}  // namespace contactcheck
