// The chart of speed against error as a picture.
#pragma once

#include <span>
#include <string>

#include "reference/report/tables/speed_error.h"
#include "reference/results/results.h"

namespace contactcheck::report {

/// How a question's points are drawn, here and on the page.
struct QuestionShape {
  Question question;
  const char* outline;  ///< an SVG path about (0, 0): a polygon by M, L and h, v, or the circle
  const char* means;    ///< in the legend
};
std::span<const QuestionShape> question_shapes();

/// An SVG document: time per frame to the right, share of errors upwards, every detector a point
/// with its name where there is room, the Pareto fronts as dashed steps. Beneath stands which
/// scenes, which times and which errors; `machine` is what they were measured on. Empty without
/// points.
std::string speed_error_plot(const SpeedError& chart, const std::string& machine);

/// The chart that is shown first.
std::string speed_error_picture(const results::Index& index);

}  // namespace contactcheck::report
