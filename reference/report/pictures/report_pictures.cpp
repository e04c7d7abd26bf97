#include "reference/report/pictures/report_pictures.h"

#include <utility>
#include <vector>

#include "reference/report/pictures/loss_charts.h"
#include "reference/report/pictures/speed_error_plot.h"
#include "reference/report/pictures/stability_plot.h"
#include "reference/report/pictures/tunnelling_plot.h"
#include "reference/report/tables/between_frames.h"
#include "reference/report/tables/family_result.h"
#include "reference/report/tables/speed_error.h"

namespace contactcheck::report {

std::map<std::string, std::string> report_pictures(const results::Index& index) {
  std::map<std::string, std::string> out;
  const auto add = [&](const std::string& file, std::string picture) {
    if (!picture.empty()) out[file] = std::move(picture);
  };
  add(kSpeedErrorFile, speed_error_picture(index));
  add(kErrorsFile, errors_picture(index.results()));
  add(kStagesFile, stages_picture(index.results()));
  add(kTunnellingFile, tunnelling_plot(tunnelling(index)));
  const std::vector<FamilyResult> families = family_results(index);
  for (const results::Scene& scene : index.results().scenes)
    if (scene.family) add(stability_plot_file(scene), stability_plot(scene, families));
  return out;
}

}  // namespace contactcheck::report
