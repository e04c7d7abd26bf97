#include "reference/report/pictures/speed_error_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "reference/report/pictures/label_layout.h"
#include "reference/report/pictures/plot_axis.h"
#include "reference/report/pictures/svg.h"
#include "reference/report/tables/detector_group.h"
#include "reference/report/tables/format.h"
#include "reference/report/tables/origin.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;
using Points = std::vector<SpeedErrorPoint>;

constexpr double kWidth = 900, kPlotLeft = 76, kRight = 24, kBottom = 108, kPlotHeight = 400;
constexpr double kLegendLine = 20, kPlotMargin = 20, kInset = 14;  // room below an error of 0
constexpr double kRadius = 5.5;
// Names stand in a font whose letters are all as wide, so that they are known not to overlap.
constexpr double kNameLetter = 6.7, kNameHeight = 12, kLegendLetter = 6.7;

constexpr QuestionShape kShapes[] = {
    {Question::kTriangles, "M5 0A5 5 0 1 1-5 0A5 5 0 1 1 5 0Z", "timed: all pairs of triangles"},
    {Question::kBody, "M-4.5-4.5h9v9h-9Z", "timed: which bodies touch"},
    {Question::kCells, "M0-5.5L5.5 4.5h-11Z", "timed: all pairs of cells"},
    {Question::kContacts, "M0-6L4 0L0 6L-4 0Z", "timed: contacts with depth and normal"},
    {Question::kSelf, "M0 5.5L5.5-4.5h-11Z", "timed: contacts of bodies with themselves"},
    {Question::kImpacts, "M-5-2H-2V-5H2V-2H5V2H2V5H-2V2H-5Z", "timed: contacts between frames"},
    {Question::kSelfImpacts, "M-5-4L-4-5L0-1L4-5L5-4L1 0L5 4L4 5L0 1L-4 5L-5 4L-1 0Z",
     "timed: contacts of bodies with themselves between frames"}};

static_assert(std::size(kShapes) == kQuestions.size(), "each question has a shape");

const QuestionShape& shape_of(Question question) {
  return *std::find_if(std::begin(kShapes), std::end(kShapes),
                       [&](const QuestionShape& shape) { return shape.question == question; });
}

std::string class_of(std::size_t group) { return fmt::format("dot g{}", group); }

std::string plot_style() {
  std::string light =
      ".grid{stroke:#d1d9e0}.front{fill:none;stroke:#59636e;stroke-width:1.5;stroke-dasharray:5 "
      "3}\n"
      ".leader{stroke:#59636e;stroke-width:.8}.faint{fill:#59636e}\n"
      ".name{font:11px ui-monospace,Menlo,\"DejaVu Sans "
      "Mono\",monospace;fill:#1f2328;stroke:#fff;\n"
      "stroke-width:3;paint-order:stroke}\n.dot{stroke:#fff;stroke-width:1}.key{fill:#59636e}"
      "\n";
  std::string dark =
      ".grid{stroke:#3a424c}.front,.leader{stroke:#9aa5b1}.faint,.key{fill:#9aa5b1}\n"
      ".name{fill:#e6edf3;stroke:#0d1117}.dot{stroke:#0d1117}\n";
  for (std::size_t g = 0; g < kDetectorGroups; ++g) {
    light += fmt::format(".g{}{{fill:{}}}", g, detector_group(g).light);
    dark += fmt::format(".g{}{{fill:{}}}", g, detector_group(g).dark);
  }
  return light + "\n@media(prefers-color-scheme:dark){\n" + dark + "}\n";
}

struct LegendEntry {
  std::string outline, css_class, words;
  double x = 0.0;
  std::size_t line = 0;
};

// Entries for the groups and questions that have a point, in as many lines as they need.
std::vector<LegendEntry> legend_of(const Points& points) {
  std::set<std::size_t> groups;
  std::set<Question> questions;
  for (const SpeedErrorPoint& point : points) {
    groups.insert(group_of(point.detector));
    questions.insert(point.question);
  }
  std::vector<LegendEntry> entries;
  for (const std::size_t g : groups)
    entries.push_back({"M-5-5h10v10h-10Z", class_of(g), detector_group(g).name});
  for (const QuestionShape& shape : kShapes)
    if (questions.count(shape.question) > 0) entries.push_back({shape.outline, "key", shape.means});
  double x = kPlotMargin;
  std::size_t line = 0;
  for (LegendEntry& entry : entries) {
    const double width = 16 + kLegendLetter * static_cast<double>(entry.words.size()) + 12;
    if (x > kPlotMargin && x + width > kWidth - kRight) {
      x = kPlotMargin;
      ++line;
    }
    entry.x = x;
    entry.line = line;
    x += width;
  }
  return entries;
}

// The points that no other of the same question beats, fast before slow.
Points front_of(const Points& points, Question question) {
  Points front;
  for (const SpeedErrorPoint& p : points)
    if (p.on_front && p.question == question) front.push_back(p);
  std::sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.ms < b.ms; });
  return front;
}

}  // namespace

std::span<const QuestionShape> question_shapes() { return kShapes; }

std::string speed_error_plot(const SpeedError& chart, const std::string& machine) {
  const Points& points = chart.points;
  if (points.empty()) return "";

  const auto [fastest, slowest] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ms < b.ms; });
  const LogAxis time(fastest->ms, slowest->ms);
  double highest = 0.0;
  for (const SpeedErrorPoint& point : points) highest = std::max(highest, point.error);
  const ErrorAxis error(highest);
  const std::vector<LegendEntry> legend = legend_of(points);
  const double top = 44 + kLegendLine * static_cast<double>(legend.back().line + 1),
               bottom = top + kPlotHeight, right = kWidth - kRight;
  const auto x_of = [&](double ms) {
    return kPlotLeft + (kWidth - kPlotLeft - kRight) * time.place(ms);
  };
  const auto y_of = [&](double share) {
    return bottom - kInset - (kPlotHeight - kInset) * error.place(share);
  };
  const std::string title = "Speed against error, " + chart.scenes;
  Svg svg(kWidth, bottom + kBottom);

  svg.text(kPlotMargin, 22, title, Anchor::kStart, "title");
  for (const LegendEntry& entry : legend) {
    const double y = 40 + kLegendLine * static_cast<double>(entry.line);
    svg.path(entry.x + 5, y, entry.outline, entry.css_class);
    svg.text(entry.x + 16, y + 4, entry.words);
  }

  for (const Tick& tick : error.ticks()) {
    svg.line(kPlotLeft, y_of(tick.value), right, y_of(tick.value), "grid");
    svg.text(kPlotLeft - 8, y_of(tick.value) + 4, tick.name, Anchor::kEnd);
  }
  for (const Tick& tick : time.ticks()) {
    svg.line(x_of(tick.value), top, x_of(tick.value), bottom, "grid");
    svg.text(x_of(tick.value), bottom + 16, tick.name, Anchor::kMiddle);
  }
  svg.text(right, bottom + 36, "time per frame, ms (left is faster)", Anchor::kEnd);
  svg.text(20, top + kPlotHeight / 2, "share of errors (down is better)", Anchor::kMiddle, "ink",
           -90);

  // A front is drawn as steps: what lies to the right of them or above is beaten.
  std::vector<PictureSegment> fronts;
  for (const QuestionShape& shape : kShapes) {
    const Points front = front_of(points, shape.question);
    if (front.empty()) continue;
    PicturePoint at{x_of(front[0].ms), top};
    std::string steps = fmt::format("M{:.1f} {:.1f}", at.x, at.y);
    const auto step_to = [&](double x, double y) {
      fronts.push_back({at, {x, at.y}});
      fronts.push_back({{x, at.y}, {x, y}});
      at = {x, y};
      steps += fmt::format("H{:.1f}V{:.1f}", x, y);
    };
    for (const SpeedErrorPoint& p : front) step_to(x_of(p.ms), y_of(p.error));
    step_to(right, at.y);
    svg.path(0, 0, steps, "front");
  }

  std::vector<LabelledPoint> labels;
  for (const SpeedErrorPoint& p : points)
    labels.push_back({x_of(p.ms), y_of(p.error),
                      kNameLetter * static_cast<double>(p.detector.size()), kNameHeight});
  const auto places = place_labels(
      labels, {kPlotLeft, top, kWidth - kPlotLeft - kRight, kPlotHeight}, kRadius, fronts);
  std::size_t nameless = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) {
      ++nameless;
      continue;
    }
    const auto& [box, leader] = *places[i];
    if (leader) svg.line(labels[i].x, labels[i].y, leader->x, leader->y, "leader");
    svg.text(box.x, box.bottom() - 2.5, points[i].detector, Anchor::kStart, "name");
  }

  for (const SpeedErrorPoint& p : points) {
    svg.begin_group(fmt::format(
        "{}: {} ms per frame (question {}), missed {} of {}, spurious {} of {} (level {})",
        p.detector, format_number(p.ms), name_of(p.question), p.missed, p.truth, p.spurious,
        p.reported, name_of(p.level)));
    svg.path(x_of(p.ms), y_of(p.error), shape_of(p.question).outline,
             class_of(group_of(p.detector)));
    svg.end_group();
  }

  const auto foot_line = [&](double y, const std::string& words) {
    svg.text(kPlotMargin, bottom + y, words, Anchor::kStart, "faint");
  };
  foot_line(58,
            "Time: mapping, update and query in playback, mean over frames. Errors: share of "
            "contacts missed or of reports spurious (the worse),");
  foot_line(76,
            "at the finest level judged in every scene. Dashed: the Pareto front of each question; "
            "no other is faster without being worse.");
  foot_line(94, "Measured on " + machine + "." +
                    (nameless == 0 ? ""
                                   : fmt::format(" No room for the names of {} of {} points.",
                                                 nameless, points.size())));
  return svg.document(title, plot_style());
}

std::string speed_error_picture(const results::Index& index) {
  const results::Machine& machine = index.results().machine;
  return speed_error_plot(speed_error(index), machine.cpu + ", " + instruction_set(machine.isa));
}

}  // namespace contactcheck::report
