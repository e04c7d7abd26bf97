// What a detector's errors do to the motion that it drives: the scene is simulated again with this
// detector in the loop, and the oracle judges the frames of that very motion.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/detect/detector.h"
#include "reference/process/shared_progress.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// `make` gives a fresh detector: one drives, another is judged on the frames.
/// A motion that diverges is a result (ClosedLoop::error). What the detector throws passes through.
/// @pre the scene is simulated; the detector can drive (see why_no_driver)
results::ClosedLoop run_closed_loop(const scene::Scene& scene, std::uint32_t position,
                                    const std::function<std::unique_ptr<Detector>()>& make,
                                    process::ProgressWriter& progress);

}  // namespace contactcheck::judge
