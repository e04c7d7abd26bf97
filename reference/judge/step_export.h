// A scene as a folder that proves what meets between its frames, on straight paths: the surfaces of
// every frame, a certificate for every pair of bodies in every step, and the script that checks
// them (check.py, which documents the files).
//
// What is proved of a pair that does not meet is what step_certificate.h says; of a pair that does,
// one contact. Nothing is said of other paths, of containment, nor of neighbouring triangles that
// meet in more than the vertices they share and have no elements that meet.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "core/types/contact_set.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// Two bodies, or a body with itself, that meet within a step.
struct ExportedContact {
  std::size_t step = 0;
  BodyPair bodies;        ///< equal: with itself
  double earliest = 0.0;  ///< fraction of the step; 0 if the step starts in contact
};

/// Sums over the exported steps.
struct StepExportSummary {
  std::size_t steps = 0;
  std::size_t apart = 0;  ///< pairs of bodies that do not meet, with themselves if that is asked
  std::vector<ExportedContact> contacts;  ///< pairs that do, ascending by step
  std::size_t unproved = 0;               ///< pairs of either kind that have no proof
};

/// @throws InputError, one sentence, if a scene has no steps
void require_steps(const scene::Scene& scene);

/// Writes all steps into an empty folder; steps.json comes last, and a folder without it is not an
/// export. Calls `before_step` before each step. Bodies are judged with themselves if a level of
/// the scene asks for that, in frames or between them.
/// @pre require_steps(scene); a simulated scene has been simulated
/// @throws InputError, one sentence, if a vertex is not finite, welded ones come apart or a file
/// cannot be written
StepExportSummary export_steps(const scene::Scene& scene, const std::filesystem::path& folder,
                               const std::function<void()>& before_step);

}  // namespace contactcheck::judge
