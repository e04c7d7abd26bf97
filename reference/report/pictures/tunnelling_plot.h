// Which share of the contacts between frames passes unseen, against motion, as a picture.
#pragma once

#include <string>
#include <vector>

#include "reference/report/tables/between_frames.h"

namespace contactcheck::report {

/// An SVG document; empty without lines.
std::string tunnelling_plot(const std::vector<TunnellingLine>& lines);

}  // namespace contactcheck::report
