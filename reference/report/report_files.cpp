#include "reference/report/report_files.h"

#include <utility>

#include "reference/report/loss_charts.h"
#include "reference/report/markdown.h"
#include "reference/report/speed_error_plot.h"
#include "reference/report/speed_error_section.h"
#include "reference/report/stability_plot.h"

namespace contactcheck::report {

std::map<std::string, std::string> report_files(const results::Results& results) {
  std::map<std::string, std::string> files = {{"report.md", markdown_report(results)}};
  const auto add_picture = [&](const std::string& file, std::string picture) {
    if (!picture.empty()) files[file] = std::move(picture);
  };
  add_picture(kSpeedErrorFile, speed_error_picture(results));
  add_picture(kErrorsFile, errors_picture(results));
  add_picture(kStagesFile, stages_picture(results));
  const std::vector<FamilyResult> families = family_results(results);
  for (const results::Scene& scene : results.scenes)
    if (scene.family) add_picture(stability_plot_file(scene), stability_plot(scene, families));
  return files;
}

}  // namespace contactcheck::report
