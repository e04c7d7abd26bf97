// Answers are checked before any code looks up the elements that they name.
#pragma once

#include <cstddef>

#include "core/detect/detector.h"
#include "reference/scene/scene.h"

namespace contactcheck::judge {

/// Throws std::runtime_error for an answer that names a body or an element that does not exist, or
/// that contains a negative or non-finite depth or a non-finite normal.
/// @pre the set is canonical: element pairs then imply their body pair
void check_answer(const scene::Scene& scene, std::size_t frame, const ContactSet& contacts);

/// Asks a question about the frame of the last update. `out` becomes the answer, canonical and
/// checked; its capacity is reused.
void ask(Detector& detector, Question question, const scene::Scene& scene, std::size_t frame,
         ContactSet& out);

}  // namespace contactcheck::judge
