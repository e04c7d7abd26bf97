// How far apart two bodies truly are when a detector first reports them in contact.
#pragma once

#include <cstdint>

#include "core/detect/detector.h"
#include "reference/results/results.h"
#include "reference/run/rounded_scene.h"

namespace contactcheck {

/// Sets the hover gaps of the run's episodes and sums them up, bisecting time (scripted) or by
/// frames (recorded).
void measure_hover_gaps(JudgingTools& tools, std::uint32_t position, Detector& detector,
                        ProgressWriter& progress, results::Run& run);

}  // namespace contactcheck
