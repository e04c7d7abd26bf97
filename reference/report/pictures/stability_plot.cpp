#include "reference/report/pictures/stability_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reference/report/pictures/svg.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;

constexpr double kSquare = 22, kSquareGap = 2, kCaptionLetter = 7.2, kEdge = 16;
constexpr double kHeadHeight = 50;  // title and legend
constexpr double kFaintest = 0.3;   // one wrong contact of many must still be seen

// Blue and orange are told apart by every kind of eye. What is unknown can be clicked like the
// rest.
std::string css() {
  return ".unknown{fill:none;stroke-dasharray:2 2;pointer-events:all}.cross{stroke-width:2}\n" +
         themed_css({{"missed", "fill", "missed", "#0b62c4", "#58a6ff"},
                     {"spurious", "fill", "spurious", "#d9730d", "#f0883e"},
                     {"right", "fill", "right", "#e6eaee", "#2d333b"},
                     {"error", "fill", "ink", "#1f2328", "#e6edf3"},
                     {"unknown", "stroke", "grey", "#8c959f", "#8c959f"},
                     {"cross", "stroke", "surface", "#fff", "#0d1117"},
                     {"mark", "fill", "surface", "#fff", "#0d1117"}});
}

// Not by colour alone: missed points down, as what sinks in, spurious up.
constexpr const char *kDown = "M-3.5 -2.5h7l-3.5 5Z", *kUp = "M-3.5 2.5h7l-3.5 -5Z";

double share_of(std::int64_t part, std::int64_t whole) {
  return whole <= 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::string stability_plot(const results::Scene& scene, const std::vector<FamilyResult>& results) {
  std::vector<FamilyResult> rows;
  for (const FamilyResult& result : results)
    if (&result.scene == &scene && result.goes_wrong()) rows.push_back(result);
  if (rows.empty()) return "";

  const auto words_width = [](std::size_t letters) {
    return kCaptionLetter * static_cast<double>(letters);
  };
  const auto squares = [](std::size_t n) {
    return static_cast<double>(n) * (kSquare + kSquareGap);
  };
  const std::size_t cases = rows[0].cases();
  std::size_t longest_name = 0, longest_value = 0;
  for (const FamilyResult& row : rows) longest_name = std::max(longest_name, row.detector().size());
  for (std::size_t c = 0; c < cases; ++c)
    longest_value = std::max(longest_value, rows[0].value(c).size());
  const double names = words_width(longest_name) + 8, left = kEdge + names;
  const double bottom = kHeadHeight + squares(rows.size());
  // Values are turned below the squares, the parameter's name is below them.
  const double height = bottom + (40 + 0.9 * kCaptionLetter * static_cast<double>(longest_value));
  const double title = words_width(scene.title.size()) + kEdge;
  Svg svg(std::max({left + squares(cases), title, 420.0}) + kEdge, height);

  svg.text(kEdge, 18, scene.title, Anchor::kStart, "title");
  double legend_x = kEdge;
  const auto legend_entry = [&](const char* css_class, const std::string& words,
                                const char* mark = nullptr) {
    svg.rectangle(legend_x, 27, 11, 11, css_class);
    if (mark != nullptr) svg.path(legend_x + 5.5, 32.5, mark, "mark");
    svg.text(legend_x + 16, 37, words);
    legend_x += 16 + words_width(words.size()) + 10;
  };
  legend_entry("missed", "share missed", kDown);
  legend_entry("spurious", "share spurious", kUp);
  legend_entry("right", "right");
  legend_entry("error", "error");

  const auto draw_half = [&](double x, double y, const char* css_class, double share,
                             const char* mark) {
    svg.rectangle(x, y, kSquare, kSquare / 2, "right");
    if (share <= 0.0) return;
    svg.rectangle(x, y, kSquare, kSquare / 2, css_class,
                  kFaintest + (1.0 - kFaintest) * std::min(share, 1.0));
    svg.path(x + kSquare / 2, y + kSquare / 4, mark, "mark");
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const FamilyResult& row = rows[r];
    const double y = kHeadHeight + squares(r);
    svg.text(left - 8, y + kSquare / 2 + 4, row.detector(), Anchor::kEnd);
    for (std::size_t c = 0; c < cases; ++c) {
      const double x = left + squares(c);
      const auto begin_square = [&](const std::string& words) {
        svg.begin_group(fmt::format("{} at {}: {}", row.detector(), row.value(c), words),
                        {{"detector", row.detector()}, {"frame", std::to_string(c)}});
      };
      if (row.failed()) {
        // Without answers nothing is known about the other cases.
        const bool here = row.failed_frame() == c;
        begin_square(here ? row.run.message : "no answer");
        svg.rectangle(x, y, kSquare, kSquare, here ? "error" : "unknown");
        if (here) {
          svg.line(x + 6, y + 6, x + kSquare - 6, y + kSquare - 6, "cross");
          svg.line(x + 6, y + kSquare - 6, x + kSquare - 6, y + 6, "cross");
        }
      } else {
        const std::int64_t truth = row.at(&results::PerFrame::truth, c),
                           missed = row.at(&results::PerFrame::missed, c),
                           spurious = row.at(&results::PerFrame::spurious, c);
        begin_square(fmt::format("{} missed of {}, {} spurious", missed, truth, spurious));
        draw_half(x, y, "missed", share_of(missed, truth), kDown);
        draw_half(x, y + kSquare / 2, "spurious", share_of(spurious, truth - missed + spurious),
                  kUp);
      }
      svg.end_group();
    }
  }

  for (std::size_t c = 0; c < cases; ++c)
    svg.text(left + squares(c) + kSquare / 2 + 4, bottom + 10, rows[0].value(c), Anchor::kEnd,
             "ink", -60);
  svg.text(left, height - 8, scene.family->parameter, Anchor::kStart);
  return svg.document(scene.title, css());
}

}  // namespace contactcheck::report
