// The true distance of two bodies when a detector first reports them in contact.
#pragma once

#include <cstdint>

#include "core/detect/detector.h"
#include "reference/judge/rounded_scene.h"
#include "reference/process/shared_progress.h"
#include "reference/results/results.h"

namespace contactcheck::judge {

/// Sets the hover gaps of the run's episodes and their maximum. Scripted scenes bisect time between
/// frames; other scenes, drawn ones included, take the distance at the first reported frame.
void measure_hover_gaps(JudgingTools& tools, std::uint32_t position, Detector& detector,
                        process::ProgressWriter& progress, results::Run& run);

}  // namespace contactcheck::judge
