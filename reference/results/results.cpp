#include "reference/results/results.h"

#include <algorithm>

namespace contactcheck::results {

const char* name_of(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kError:
      return "error";
    case Status::kAbsent:
      return "absent";
    case Status::kRefused:
      return "refused";
  }
  return "unknown";
}

const Scene* Results::scene(const std::string& id) const {
  for (const Scene& scene : scenes)
    if (scene.id == id) return &scene;
  return nullptr;
}

bool Results::has_runs_of(const std::string& scene) const {
  return std::any_of(runs.begin(), runs.end(), [&](const Run& run) { return run.scene == scene; });
}

const Run* Results::run(const std::string& scene, const std::string& detector) const {
  for (const Run& run : runs)
    if (run.scene == scene && run.detector == detector) return &run;
  return nullptr;
}

NamedErrors errors_of(const Geometry& g) {
  return {{"covered_length_fraction", g.covered_length_fraction},
          {"depth_error_max", g.depth_error_max},
          {"depth_error_mean", g.depth_error_mean},
          {"depth_error_p95", g.depth_error_p95},
          {"hover_gap_max", g.hover_gap_max},
          {"late_frames", g.late_frames},
          {"missed_length", g.missed_length},
          {"normal_error_deg_max", g.normal_error_deg_max},
          {"normal_error_deg_mean", g.normal_error_deg_mean},
          {"normal_error_deg_p95", g.normal_error_deg_p95},
          {"spurious_distance_max", g.spurious_distance_max}};
}

}  // namespace contactcheck::results
