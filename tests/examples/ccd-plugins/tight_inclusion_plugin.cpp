// Tight-Inclusion (Wang et al. 2021) as a detector that contactcheck loads:
//
//     contactcheck queries vf.csv --detector ./libtight_inclusion_plugin.so:tolerance=1e-6
//
// Written for Tight-Inclusion 1.0.6 (commit ca9a8c24fe91 of January 2026).
//
// The library searches boxes of (t, u, v), where u and v are parameters on the elements. It
// evaluates the difference of the two points at the box's eight corners. It reports contact when
// a box remains whose image meets [-err, err] on every axis, and which is not wider than
// `tolerance` on any. When `max_itr` boxes did not suffice, it reports the first box that remains
// on the current level, and `output_tolerance` is the width of its image.
//
// What that means in metres: every box has a corner that is a place on both elements. On each
// axis the difference there is at most err + output_tolerance, so the two points are at most
// sqrt(3) times as far apart. The paper and README name err + tolerance alone, which is a distance
// in the largest norm.
#include <spdlog/spdlog.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <tight_inclusion/ccd.hpp>
#include <tight_inclusion/logger.hpp>

#include "contactcheck_plugin.h"

namespace {

struct Detector {
  double tolerance = 0;
  long max_itr = 0;
  bool no_zero_toi = false;
};

struct Answer {
  bool contact = false;
  double time = 0;
  double output_tolerance = 0;
};

int32_t fail(char* message, const char* text) {
  std::snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "%s", text);
  return CONTACTCHECK_ERROR;
}

int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
               char* message) {
  auto* const made = new (std::nothrow) Detector;
  if (made == nullptr || count != 3) {
    delete made;
    return fail(message, "out of memory, or not three settings");
  }
  made->tolerance = std::strtod(settings[0].value, nullptr);
  // Numbers come in their shortest form: a million as 1e+06.
  made->max_itr = std::lround(std::strtod(settings[1].value, nullptr));
  made->no_zero_toi = settings[2].value[0] == 'y';
  // The library writes errors to the standard output, which is not the plug-in's.
  ticcd::logger().set_level(spdlog::level::off);
  *detector = made;
  return CONTACTCHECK_OK;
}

void destroy(void* detector) { delete static_cast<Detector*>(detector); }

// Rounding adds to the distance what the library computes wrongly: a dozen operations on numbers
// no larger than four times the largest coordinate.
double metres(double output_tolerance, double largest) {
  constexpr double kSqrt3 = 1.7320508075688774;
  return kSqrt3 * (output_tolerance + 1e-14 * std::max(largest, 1.0));
}

Answer ask(const Detector& detector, const contactcheck_impact_query& query, bool no_zero_toi) {
  using Vector = Eigen::Vector3d;
  Vector start[4], end[4];
  for (int i = 0; i < 4; ++i) {
    start[i] = Vector(query.start[3 * i], query.start[3 * i + 1], query.start[3 * i + 2]);
    end[i] = Vector(query.end[3 * i], query.end[3 * i + 1], query.end[3 * i + 2]);
  }
  // Below 0: the library takes its own bounds of rounding errors, from the query's coordinates.
  const Eigen::Array3d err(-1, -1, -1);
  const double separation = 0, t_max = 1;
  Answer answer;
  const auto call =
      query.kind == CONTACTCHECK_VERTEX_FACE ? ticcd::vertexFaceCCD : ticcd::edgeEdgeCCD;
  answer.contact =
      call(start[0], start[1], start[2], start[3], end[0], end[1], end[2], end[3], err, separation,
           answer.time, detector.tolerance, t_max, detector.max_itr, answer.output_tolerance,
           no_zero_toi, ticcd::CCDRootFindingMethod::BREADTH_FIRST_SEARCH);
  return answer;
}

int32_t declare_impacts(void* detector, contactcheck_impact_semantics* semantics,
                        char* /*message*/) {
  semantics->kinds = CONTACTCHECK_VERTEX_FACE | CONTACTCHECK_EDGE_EDGE;
  semantics->precision = CONTACTCHECK_DOUBLE;
  semantics->tolerance = metres(static_cast<const Detector*>(detector)->tolerance, 1);
  return CONTACTCHECK_OK;
}

int32_t impact(void* handle, const contactcheck_impact_query* query, contactcheck_impact* impact,
               char* message) {
  const auto& detector = *static_cast<const Detector*>(handle);
  try {
    Answer answer = ask(detector, *query, false);
    // Later rounds of no_zero_toi may be of a part of the step, and their tolerance is less than
    // that of the round that found the contact: the tolerance stays that of the first.
    if (detector.no_zero_toi && answer.contact && answer.time == 0) {
      const Answer refined = ask(detector, *query, true);
      answer.contact = refined.contact;
      answer.time = refined.time;
    }
    if (!answer.contact) return CONTACTCHECK_OK;
    double largest = 0;
    for (int i = 0; i < 12; ++i)
      largest = std::max({largest, std::abs(query->start[i]), std::abs(query->end[i])});
    impact->contact = 1;
    impact->has = CONTACTCHECK_HAS_TIME | CONTACTCHECK_HAS_TOLERANCE;
    impact->time = answer.time;
    impact->tolerance = metres(answer.output_tolerance, largest);
    return CONTACTCHECK_OK;
  } catch (const std::exception& e) {
    return fail(message, e.what());
  }
}

constexpr const char* kYesNo[] = {"no", "yes", nullptr};
constexpr contactcheck_option kOptions[] = {
    {"tolerance", "1e-6", "largest width of a box's image, in metres", nullptr, 1e-300, 1e300, 0,
     0},
    {"max_itr", "1000000", "boxes that a query may take; 0: no limit", nullptr, 0, 2e9, 1, 0},
    {"no_zero_toi", "no", "refine a time of 0; endless where elements start in contact", kYesNo, 0,
     0, 0, 0}};

constexpr contactcheck_plugin kPlugin = {
    .abi_version = CONTACTCHECK_PLUGIN_ABI,
    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
    .id = "tight-inclusion",
    .summary = "Tight-Inclusion: bisection of time and parameters, with a tolerance",
    .version = TIGHT_INCLUSION_VERSION_TEXT,
    .options = kOptions,
    .option_count = 3,
    .create = create,
    .destroy = destroy,
    .impact_sizes = CONTACTCHECK_IMPACT_SIZES,
    .declare_impacts = declare_impacts,
    .impact = impact,
};

}  // namespace

const contactcheck_plugin* contactcheck_plugin_entry() { return &kPlugin; }
