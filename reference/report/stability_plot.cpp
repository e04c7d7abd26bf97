#include "reference/report/stability_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "reference/report/svg.h"

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

double opacity_of(double share) { return kFaintest + (1.0 - kFaintest) * std::min(share, 1.0); }

class StabilityPlot {
 public:
  StabilityPlot(const results::Scene& scene, std::vector<FamilyResult> rows)
      : scene_(scene),
        rows_(std::move(rows)),
        left_(kEdge + label_width()),
        svg_(width(), kHeadHeight + height_of_rows() + foot()) {}

  std::string draw() {
    draw_head();
    for (std::size_t row = 0; row < rows_.size(); ++row) draw_row(row);
    for (std::size_t c = 0; c < cases(); ++c)
      svg_.text(x_of(c) + kSquare / 2 + 4, y_of(rows_.size()) + 10, rows_[0].value(c), Anchor::kEnd,
                "ink", -60);
    svg_.text(left_, svg_bottom() - 8, parameter(), Anchor::kStart);
    return svg_.document(title(), css());
  }

 private:
  std::size_t cases() const { return rows_[0].cases(); }
  const std::string& parameter() const { return scene_.family->parameter; }
  const std::string& title() const { return scene_.title; }

  double label_width() const {
    std::size_t longest = 0;
    for (const FamilyResult& row : rows_) longest = std::max(longest, row.detector().size());
    return kCaptionLetter * static_cast<double>(longest) + 8;
  }
  double width() const {
    const double squares = static_cast<double>(cases()) * (kSquare + kSquareGap);
    const double words = kCaptionLetter * static_cast<double>(title().size());
    return std::max({left_ + squares, words + kEdge, 420.0}) + kEdge;
  }
  double height_of_rows() const {
    return static_cast<double>(rows_.size()) * (kSquare + kSquareGap);
  }
  // Values stand on their heads below the squares, the parameter below them.
  double foot() const {
    std::size_t longest = 0;
    for (std::size_t c = 0; c < cases(); ++c) longest = std::max(longest, rows_[0].value(c).size());
    return 40 + 0.9 * kCaptionLetter * static_cast<double>(longest);
  }
  double svg_bottom() const { return kHeadHeight + height_of_rows() + foot(); }
  double x_of(std::size_t c) const {
    return left_ + static_cast<double>(c) * (kSquare + kSquareGap);
  }
  double y_of(std::size_t row) const {
    return kHeadHeight + static_cast<double>(row) * (kSquare + kSquareGap);
  }

  void draw_head() {
    svg_.text(kEdge, 18, title(), Anchor::kStart, "title");
    double x = kEdge;
    const auto entry = [&](const char* css_class, const std::string& words,
                           const char* mark = nullptr) {
      svg_.rectangle(x, 27, 11, 11, css_class);
      if (mark != nullptr) svg_.path(x + 5.5, 32.5, mark, "mark");
      svg_.text(x + 16, 37, words);
      x += 16 + kCaptionLetter * static_cast<double>(words.size()) + 10;
    };
    entry("missed", "share missed", kDown);
    entry("spurious", "share spurious", kUp);
    entry("right", "right");
    entry("error", "error");
  }

  void draw_row(std::size_t row) {
    const FamilyResult& result = rows_[row];
    svg_.text(left_ - 8, y_of(row) + kSquare / 2 + 4, result.detector(), Anchor::kEnd);
    for (std::size_t c = 0; c < cases(); ++c)
      result.failed() ? draw_failed(row, c) : draw_judged(row, c);
  }

  void draw_judged(std::size_t row, std::size_t c) {
    const FamilyResult& result = rows_[row];
    const std::int64_t truth = result.at(&results::PerFrame::truth, c),
                       missed = result.at(&results::PerFrame::missed, c),
                       spurious = result.at(&results::PerFrame::spurious, c);
    begin_square(row, c, fmt::format("{} missed of {}, {} spurious", missed, truth, spurious));
    half(x_of(c), y_of(row), "missed", share_of(missed, truth), kDown);
    half(x_of(c), y_of(row) + kSquare / 2, "spurious",
         share_of(spurious, truth - missed + spurious), kUp);
    svg_.end_group();
  }

  void begin_square(std::size_t row, std::size_t c, const std::string& words) {
    const FamilyResult& result = rows_[row];
    svg_.begin_group(fmt::format("{} at {}: {}", result.detector(), result.value(c), words),
                     {{"detector", result.detector()}, {"frame", std::to_string(c)}});
  }

  void half(double x, double y, const char* css_class, double share, const char* mark) {
    svg_.rectangle(x, y, kSquare, kSquare / 2, "right");
    if (share <= 0.0) return;
    svg_.rectangle(x, y, kSquare, kSquare / 2, css_class, opacity_of(share));
    svg_.path(x + kSquare / 2, y + kSquare / 4, mark, "mark");
  }

  // Without answers nobody knows about the other cases.
  void draw_failed(std::size_t row, std::size_t c) {
    const FamilyResult& result = rows_[row];
    const double x = x_of(c), y = y_of(row);
    const bool here = result.failed_frame() == c;
    begin_square(row, c, here ? result.run.message : "no answer");
    svg_.rectangle(x, y, kSquare, kSquare, here ? "error" : "unknown");
    if (here) {
      svg_.line(x + 6, y + 6, x + kSquare - 6, y + kSquare - 6, "cross");
      svg_.line(x + 6, y + kSquare - 6, x + kSquare - 6, y + 6, "cross");
    }
    svg_.end_group();
  }

  const results::Scene& scene_;
  std::vector<FamilyResult> rows_;
  double left_;
  Svg svg_;
};

}  // namespace

// Results may come from anywhere: an id must not lead out of the folder.
std::string stability_plot_file(const results::Scene& scene) {
  std::string name = scene.id;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return "plots/" + name + ".svg";
}

std::string stability_plot(const results::Scene& scene, const std::vector<FamilyResult>& results) {
  std::vector<FamilyResult> rows;
  for (const FamilyResult& result : results)
    if (&result.scene == &scene && result.goes_wrong()) rows.push_back(result);
  return rows.empty() ? "" : StabilityPlot(scene, std::move(rows)).draw();
}

}  // namespace contactcheck::report
