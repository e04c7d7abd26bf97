#include "reference/report/report_files.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "reference/report/loss_charts.h"
#include "reference/report/markdown.h"
#include "reference/report/speed_error_plot.h"
#include "reference/report/speed_error_section.h"
#include "reference/report/stability_plot.h"

namespace contactcheck {

std::map<std::string, std::string> report_files(const nlohmann::ordered_json& results) {
  std::map<std::string, std::string> files = {{"report.md", markdown_report(results)}};
  const auto add_picture = [&](const char* file, std::string picture) {
    if (!picture.empty()) files[file] = std::move(picture);
  };
  add_picture(kSpeedErrorFile, speed_error_picture(results));
  add_picture(kErrorsFile, errors_picture(results));
  add_picture(kStagesFile, stages_picture(results));
  const std::vector<FamilyResult> families = family_results(results);
  for (const auto& scene : results.at("scenes")) {
    if (!scene.contains("family")) continue;
    const std::string plot = stability_plot(scene, families);
    if (!plot.empty()) files[stability_plot_file(scene)] = plot;
  }
  return files;
}

}  // namespace contactcheck
