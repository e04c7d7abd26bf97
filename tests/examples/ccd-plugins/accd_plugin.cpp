// Additive continuous collision detection (Li et al. 2021) of the IPC Toolkit as a detector that
// contactcheck loads:
//
//     contactcheck queries vf.csv --detector ./libaccd_plugin.so:conservative_rescaling=0.9
//
// Written for the IPC Toolkit's commit b40e9c078639 of June 2026, 52 commits after 1.5.0.
//
// The method advances by safe steps, each the rescaling times the distance over the largest speed.
// It reports contact once the distance is less than 1 - rescaling times the distance at the start.
// That is the tolerance that is declared; rounding is not part of it, and the library says itself
// that rounding may hide contacts.
#include <ipc/ccd/additive_ccd.hpp>
#include <ipc/utils/logger.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>

#include "contactcheck_plugin.h"

namespace {

int32_t fail(char* message, const char* text) {
  std::snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "%s", text);
  return CONTACTCHECK_ERROR;
}

int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
               char* message) {
  if (count != 2) return fail(message, "not two settings");
  // The library warns on the standard output, which is not the plug-in's.
  ipc::logger().set_level(spdlog::level::off);
  const double rescaling = std::strtod(settings[0].value, nullptr);
  // Numbers come in their shortest form: a million as 1e+06.
  const long iterations = std::lround(std::strtod(settings[1].value, nullptr));
  *detector = new (std::nothrow) ipc::AdditiveCCD(
      iterations == 0 ? ipc::AdditiveCCD::UNLIMITTED_ITERATIONS : iterations, rescaling);
  return *detector == nullptr ? fail(message, "out of memory") : CONTACTCHECK_OK;
}

void destroy(void* detector) { delete static_cast<ipc::AdditiveCCD*>(detector); }

int32_t declare_impacts(void* detector, contactcheck_impact_semantics* semantics,
                        char* /*message*/) {
  semantics->kinds = CONTACTCHECK_VERTEX_FACE | CONTACTCHECK_EDGE_EDGE;
  semantics->precision = CONTACTCHECK_DOUBLE;
  semantics->tolerance_of_start =
      1 - static_cast<const ipc::AdditiveCCD*>(detector)->conservative_rescaling;
  return CONTACTCHECK_OK;
}

int32_t impact(void* handle, const contactcheck_impact_query* query, contactcheck_impact* impact,
               char* message) {
  const auto& detector = *static_cast<const ipc::AdditiveCCD*>(handle);
  Eigen::Vector3d start[4], end[4];
  for (int i = 0; i < 4; ++i) {
    start[i] =
        Eigen::Vector3d(query->start[3 * i], query->start[3 * i + 1], query->start[3 * i + 2]);
    end[i] = Eigen::Vector3d(query->end[3 * i], query->end[3 * i + 1], query->end[3 * i + 2]);
  }
  const auto call = query->kind == CONTACTCHECK_VERTEX_FACE ? &ipc::AdditiveCCD::point_triangle_ccd
                                                            : &ipc::AdditiveCCD::edge_edge_ccd;
  try {
    double time = 0;
    const double min_distance = 0, t_max = 1;
    if (!(detector.*call)(start[0], start[1], start[2], start[3], end[0], end[1], end[2], end[3],
                          time, min_distance, t_max))
      return CONTACTCHECK_OK;
    impact->contact = 1;
    impact->has = CONTACTCHECK_HAS_TIME;
    impact->time = time;
    return CONTACTCHECK_OK;
  } catch (const std::exception& e) {
    return fail(message, e.what());
  }
}

constexpr contactcheck_option kOptions[] = {
    {"conservative_rescaling", "0.9", "share of a safe step that is taken", nullptr, 1e-6, 1, 0, 0},
    {"max_iterations", "0", "steps that a query may take; 0: no limit", nullptr, 0, 2e9, 1, 0}};

constexpr contactcheck_plugin kPlugin = {
    .abi_version = CONTACTCHECK_PLUGIN_ABI,
    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
    .id = "accd",
    .summary = "additive CCD of the IPC Toolkit: safe steps, with a tolerance",
    .version = IPC_TOOLKIT_VERSION_TEXT,
    .options = kOptions,
    .option_count = 2,
    .create = create,
    .destroy = destroy,
    .impact_sizes = CONTACTCHECK_IMPACT_SIZES,
    .declare_impacts = declare_impacts,
    .impact = impact,
};

}  // namespace

const contactcheck_plugin* contactcheck_plugin_entry() { return &kPlugin; }
