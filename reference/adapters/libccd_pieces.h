// The two detectors made of libccd's calls: on pairs of triangles, and on pairs of mapped boxes.
#pragma once

#include <memory>

#include "core/detect/detector.h"
#include "reference/adapters/libccd_call.h"

namespace contactcheck {

/// Triangles whose boxes overlap, found by core's refitted trees, each a hull of three points.
std::unique_ptr<Detector> make_ccd_triangles(const CcdSettings& settings);

/// The mapped FFD-AABBs of kept cells whose bounding boxes overlap, each the hull of its eight
/// corners. prepare() throws RefusedInput for a body without a lattice.
std::unique_ptr<Detector> make_ccd_boxes(const CcdSettings& settings);

}  // namespace contactcheck
