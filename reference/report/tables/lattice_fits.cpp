#include "reference/report/tables/lattice_fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/report/tables/format.h"

namespace contactcheck::report {
namespace {

// Every frame has as many vertices: the mean of the squares is that of all of them.
double overall_rms(const std::vector<double>& frames) {
  const double largest = *std::max_element(frames.begin(), frames.end());
  if (!(largest > 0.0)) return 0.0;
  double sum = 0.0;
  for (const double rms : frames) sum += rms / largest * (rms / largest);
  return largest * std::sqrt(sum / static_cast<double>(frames.size()));
}

struct BodyFit {
  std::string body;
  double rms = 0.0, max = 0.0;  ///< metres, over all frames
  std::ptrdiff_t frame = 0;     ///< where max is
};

// Bodies without a frame have no error to tell.
std::vector<BodyFit> fits_of(const results::Scene& scene) {
  std::vector<BodyFit> out;
  for (const auto& [body, rms, max] : scene.fits) {
    if (rms.empty() || max.empty()) continue;
    const auto worst = std::max_element(max.begin(), max.end());
    out.push_back({body, overall_rms(rms), *worst, worst - max.begin()});
  }
  return out;
}

}  // namespace

std::string fits_line(const results::Scene& scene) {
  const std::vector<BodyFit> fits = fits_of(scene);
  if (fits.empty()) return "";
  const BodyFit& worst = *std::max_element(
      fits.begin(), fits.end(), [](const BodyFit& a, const BodyFit& b) { return a.max < b.max; });
  return fmt::format(
      "judged with lattices fitted to recordings: vertices at most {} mm off (body {}, frame {})",
      format_millimetres(worst.max), worst.body, worst.frame);
}

TitledTable fits_table(const results::Scene& scene) {
  TitledTable out{
      "Lattices fitted to recordings: all detectors were given the fitted surface, whose vertices "
      "lie so far from the recorded ones (mm)",
      "",
      {{"body", true, ""}, {"RMS", false, ""}, {"max", false, ""}, {"in frame", false, ""}},
      {}};
  for (const BodyFit& fit : fits_of(scene))
    out.rows.push_back({fit.body, format_millimetres(fit.rms), format_millimetres(fit.max),
                        format_count(fit.frame)});
  return out;
}

}  // namespace contactcheck::report
