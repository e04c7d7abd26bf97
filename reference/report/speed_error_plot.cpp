#include "reference/report/speed_error_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "reference/report/detector_group.h"
#include "reference/report/format.h"
#include "reference/report/label_layout.h"
#include "reference/report/plot_axis.h"
#include "reference/report/svg.h"

namespace contactcheck::report {
namespace {
using Anchor = Svg::Anchor;
using Points = std::vector<SpeedErrorPoint>;

constexpr double kWidth = 900, kPlotLeft = 76, kRight = 24, kBottom = 108, kPlotHeight = 400;
constexpr double kLegendLine = 20, kPlotMargin = 20, kInset = 14;  // room below an error of 0
constexpr double kRadius = 5.5;
// Names stand in a font whose letters are all as wide, so that they are known not to overlap.
constexpr double kNameLetter = 6.7, kNameHeight = 12, kLegendLetter = 6.7;

struct Shape {
  Question question;
  const char* outline;
  const char* means;
};
constexpr Shape kShapes[] = {
    {Question::kTriangles, "M5 0A5 5 0 1 1-5 0A5 5 0 1 1 5 0Z", "timed: all pairs of triangles"},
    {Question::kBody, "M-4.5-4.5h9v9h-9Z", "timed: which bodies touch"},
    {Question::kCells, "M0-5.5L5.5 4.5h-11Z", "timed: all pairs of cells"},
    {Question::kContacts, "M0-6L4 0L0 6L-4 0Z", "timed: contacts with depth and normal"}};

const Shape& shape_of(Question question) {
  return *std::find_if(std::begin(kShapes), std::end(kShapes),
                       [&](const Shape& shape) { return shape.question == question; });
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
};

// Of groups and questions that have a point.
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
  for (const Shape& shape : kShapes)
    if (questions.count(shape.question) > 0) entries.push_back({shape.outline, "key", shape.means});
  return entries;
}

LogAxis time_axis(const Points& points) {
  const auto [least, most] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ms < b.ms; });
  return {least->ms, most->ms};
}

double highest_error(const Points& points) {
  double highest = 0.0;
  for (const SpeedErrorPoint& point : points) highest = std::max(highest, point.error);
  return highest;
}

std::string sentence_of(const SpeedErrorPoint& p) {
  return fmt::format(
      "{}: {} ms per frame (question {}), missed {} of {}, spurious {} of {} (level {})",
      p.detector, format_number(p.ms), name_of(p.question), p.missed, p.truth, p.spurious,
      p.reported, name_of(p.level));
}

class SpeedErrorPlot {
 public:
  SpeedErrorPlot(const SpeedError& chart, const std::string& machine)
      : chart_(chart),
        machine_(machine),
        points_(chart.points),
        time_(time_axis(points_)),
        error_(highest_error(points_)),
        legend_(legend_of(points_)),
        top_(44 + kLegendLine * static_cast<double>(legend_lines())),
        svg_(kWidth, top_ + kPlotHeight + kBottom) {}

  std::string draw() {
    draw_head();
    draw_axes();
    for (const Shape& shape : kShapes) draw_front(shape.question);
    const std::size_t nameless = draw_names();
    draw_points();
    draw_foot(nameless);
    return svg_.document("Speed against error, " + chart_.scenes, plot_style());
  }

 private:
  double x_of(double ms) const {
    return kPlotLeft + (kWidth - kPlotLeft - kRight) * time_.place(ms);
  }
  double y_of(double error) const { return base() - (kPlotHeight - kInset) * error_.place(error); }
  double base() const { return top_ + kPlotHeight - kInset; }
  double bottom() const { return top_ + kPlotHeight; }

  static double width_of(const LegendEntry& entry) {
    return 16 + kLegendLetter * static_cast<double>(entry.words.size()) + 12;
  }
  // Calls `use(entry, x, line)` for every entry; returns the number of lines.
  template <typename Use>
  std::size_t for_each_entry(Use&& use) const {
    double x = kPlotMargin;
    std::size_t line = 0;
    for (const LegendEntry& entry : legend_) {
      if (x > kPlotMargin && x + width_of(entry) > kWidth - kRight) {
        x = kPlotMargin;
        ++line;
      }
      use(entry, x, line);
      x += width_of(entry);
    }
    return line + 1;
  }
  std::size_t legend_lines() const {
    return for_each_entry([](const LegendEntry&, double, std::size_t) {});
  }

  void draw_head() {
    svg_.text(kPlotMargin, 22, "Speed against error, " + chart_.scenes, Anchor::kStart, "title");
    for_each_entry([&](const LegendEntry& entry, double x, std::size_t line) {
      const double y = 40 + kLegendLine * static_cast<double>(line);
      svg_.path(x + 5, y, entry.outline, entry.css_class);
      svg_.text(x + 16, y + 4, entry.words);
    });
  }

  void draw_axes() {
    for (const Tick& tick : error_.ticks()) {
      svg_.line(kPlotLeft, y_of(tick.value), kWidth - kRight, y_of(tick.value), "grid");
      svg_.text(kPlotLeft - 8, y_of(tick.value) + 4, tick.name, Anchor::kEnd);
    }
    for (const Tick& tick : time_.ticks()) {
      svg_.line(x_of(tick.value), top_, x_of(tick.value), bottom(), "grid");
      svg_.text(x_of(tick.value), bottom() + 16, tick.name, Anchor::kMiddle);
    }
    svg_.text(kWidth - kRight, bottom() + 36, "time per frame, ms (left is faster)", Anchor::kEnd);
    svg_.text(20, top_ + kPlotHeight / 2, "share of errors (down is better)", Anchor::kMiddle,
              "ink", -90);
  }

  // Steps that part what is beaten, to the right and above, from what nothing does.
  void draw_front(Question question) {
    Points front;
    for (const SpeedErrorPoint& p : points_)
      if (p.on_front && p.question == question) front.push_back(p);
    if (front.empty()) return;
    std::sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.ms < b.ms; });
    PicturePoint at{x_of(front[0].ms), top_};
    std::string steps = fmt::format("M{:.1f} {:.1f}", at.x, at.y);
    const auto step_to = [&](double x, double y) {
      fronts_.push_back({at, {x, at.y}});
      fronts_.push_back({{x, at.y}, {x, y}});
      at = {x, y};
      steps += fmt::format("H{:.1f}V{:.1f}", x, y);
    };
    for (const SpeedErrorPoint& p : front) step_to(x_of(p.ms), y_of(p.error));
    step_to(kWidth - kRight, at.y);
    svg_.path(0, 0, steps, "front");
  }

  // Returns how many names found no place.
  std::size_t draw_names() {
    std::vector<LabelledPoint> wanted;
    for (const SpeedErrorPoint& p : points_)
      wanted.push_back({x_of(p.ms), y_of(p.error),
                        kNameLetter * static_cast<double>(p.detector.size()), kNameHeight});
    const Box area{kPlotLeft, top_, kWidth - kPlotLeft - kRight, kPlotHeight};
    const auto places = place_labels(wanted, area, kRadius, fronts_);
    std::size_t nameless = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] ? draw_name(points_[i].detector, wanted[i], *places[i]) : void(++nameless);
    return nameless;
  }

  void draw_name(const std::string& name, const LabelledPoint& point, const LabelPlace& place) {
    if (place.leader) svg_.line(point.x, point.y, place.leader->x, place.leader->y, "leader");
    svg_.text(place.box.x, place.box.bottom() - 2.5, name, Anchor::kStart, "name");
  }

  void draw_points() {
    for (const SpeedErrorPoint& p : points_) {
      svg_.begin_group(sentence_of(p));
      svg_.path(x_of(p.ms), y_of(p.error), shape_of(p.question).outline,
                class_of(group_of(p.detector)));
      svg_.end_group();
    }
  }

  void draw_foot(std::size_t nameless) {
    const auto line = [&](double y, const std::string& words) {
      svg_.text(kPlotMargin, bottom() + y, words, Anchor::kStart, "faint");
    };
    line(58,
         "Time: mapping, update and query in playback, mean over frames. Errors: share of "
         "contacts missed or of reports spurious (the worse),");
    line(76,
         "at the finest level judged in every scene. Dashed: the Pareto front of each question; no "
         "other is faster without being worse.");
    line(94, "Measured on " + machine_ + "." +
                 (nameless == 0 ? ""
                                : fmt::format(" No room for the names of {} of {} points.",
                                              nameless, points_.size())));
  }

  const SpeedError& chart_;
  const std::string& machine_;
  const Points& points_;
  LogAxis time_;
  ErrorAxis error_;
  std::vector<LegendEntry> legend_;
  std::vector<PictureSegment> fronts_;
  double top_;
  Svg svg_;
};

}  // namespace

std::string speed_error_plot(const SpeedError& chart, const std::string& machine) {
  return chart.points.empty() ? "" : SpeedErrorPlot(chart, machine).draw();
}

}  // namespace contactcheck::report
