// How a detector's errors change the motion that it drives: the scene is simulated again with this
// detector in the loop, and the oracle judges the frames of that motion.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/detect/detector.h"
#include "reference/process/shared_progress.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// `make` returns a new detector; it is called for the driver and for the one that is judged. A
/// motion that diverges is a result (ClosedLoop::error). Exceptions of the detector pass through.
/// @pre the scene is simulated; the detector can drive (see why_no_driver)
results::ClosedLoop run_closed_loop(const scene::Scene& scene, std::uint32_t position,
                                    const std::function<std::unique_ptr<Detector>()>& make,
                                    process::ProgressWriter& progress);

}  // namespace contactcheck::judge
