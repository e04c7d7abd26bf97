// The same frame asked about in other ways: what came before it, and how often, must not matter.
#pragma once

#include <functional>
#include <vector>

#include "tests/conformance/answers.h"
#include "tests/conformance/observation.h"
#include "tests/metamorphic/subject.h"

namespace contactcheck::test {

/// A detector prepared for the bodies of a variant, and how more of its kind are made.
struct Asked {
  const Maker& make;
  Detector& detector;
  const Variant& variant;
};

/// Those of its questions that are about frames, in order.
std::vector<Question> questions_of_frames(const Semantics& semantics);

/// All answers that are given about the frame. @pre the variant has this frame
using Calls = std::function<std::vector<Answers>(const Asked& asked, std::size_t frame)>;

/// Update and every question, frame after frame on one detector.
std::vector<Answers> ask_in_order(const Asked& asked, std::size_t frame);
/// All questions three times, with the trace in between.
std::vector<Answers> ask_repeatedly(const Asked& asked, std::size_t frame);
/// Three updates with the same frame, and the questions after each.
std::vector<Answers> update_repeatedly(const Asked& asked, std::size_t frame);
/// A detector of its own for every frame.
std::vector<Answers> ask_fresh_detector(const Asked& asked, std::size_t frame);
/// After the frame that is half of all frames away.
std::vector<Answers> ask_after_other_frame(const Asked& asked, std::size_t frame);
/// After a frame in which everything is a thousand times as large and a million sizes away.
std::vector<Answers> ask_after_far_frame(const Asked& asked, std::size_t frame);
/// Questions in the opposite order; and what comes with contacts stands for the answer without. A
/// detector without the question `contacts` gives the first of the two alone.
std::vector<Answers> ask_with_contacts(const Asked& asked, std::size_t frame);

/// All of these but for the detector of its own, in fewer calls: for large scenes.
std::vector<Answers> ask_after_all(const Asked& asked, std::size_t frame);

}  // namespace contactcheck::test
