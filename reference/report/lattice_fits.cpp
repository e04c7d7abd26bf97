#include "reference/report/lattice_fits.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "reference/report/format.h"
#include "reference/report/markdown_table.h"

namespace contactcheck {
namespace {

using Json = nlohmann::ordered_json;

// Every frame has as many vertices: the mean of the squares is that of all of them.
double overall_rms(const std::vector<double>& frames) {
  const double largest = *std::max_element(frames.begin(), frames.end());
  if (!(largest > 0.0)) return 0.0;
  double sum = 0.0;
  for (const double rms : frames) sum += rms / largest * (rms / largest);
  return largest * std::sqrt(sum / static_cast<double>(frames.size()));
}

std::string row(const Json& fit) {
  const auto rms = fit.at("rms").get<std::vector<double>>();
  const auto max = fit.at("max").get<std::vector<double>>();
  if (rms.empty() || max.empty()) return "";
  const auto worst = std::max_element(max.begin(), max.end());
  return table_line({fit.at("body").get<std::string>(), format_millimetres(overall_rms(rms)),
                     format_millimetres(*worst), format_count(worst - max.begin())});
}

}  // namespace

std::string fits_markdown(const Json& scene) {
  std::string rows;
  for (const Json& fit : scene.value("fits", Json::array())) rows += row(fit);
  return titled_table(
      "Lattices fitted to recordings: all detectors were given the fitted surface, whose vertices "
      "lie so far from the recorded ones (mm):",
      {{"body", true, ""}, {"RMS", false, ""}, {"max", false, ""}, {"in frame", false, ""}}, rows);
}

}  // namespace contactcheck
