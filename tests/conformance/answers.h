// What a detector says about one frame or step, to all questions about it that it claims, and the
// checks that need no truth.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "tests/conformance/cases.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// By question, each canonical.
using Answers = std::map<Question, ContactSet>;

/// Without update: about the frame, or step, of the last one.
Answers ask_again(Detector& detector, Moment of = Moment::kFrame);
/// Update and all questions of frames. Vertices are handed over only to detectors that say they
/// need them, as a run does.
Answers ask(Detector& detector, const FrameData& data, std::size_t index = 0);
/// The same about a frame of a case, or the step that begins with it.
Answers ask(Detector& detector, const Case& scene, Moment of, std::size_t index);
/// From this frame to the next, as the detector is given it: it points into the case.
Step step_of(const Case& scene, std::size_t index, const Detector& detector);

/// The same sets, and contacts of the same depths and normals, and impacts of the same times, to
/// the bit.
bool same(const Answers& a, const Answers& b);
/// The same, for bodies in the opposite order. Depths and times may differ by rounding, and normals
/// where several ways out are about as short: of contacts only the pieces and vertices are
/// compared, of impacts only the bodies and elements.
bool mirrored(const Answers& a, const Answers& b, std::size_t bodies);
/// "triangles: 1 pair of bodies, 16 of triangles; body: ...".
std::string text(const Answers& answers);

/// Names of bodies, cells, triangles, vertices and edges that the scene does not have, and pairs of
/// a body with itself.
std::uint64_t invalid_ids(const ContactSet& set, const std::vector<Body>& bodies);
/// Contacts whose depth is negative or not finite, or whose normal is not of unit length.
std::uint64_t unusable_contacts(const ContactSet& set);
/// Times of impacts that are not in [0, 1].
std::uint64_t unusable_times(const ContactSet& set);
/// Lists that hold something and do not answer the question.
std::uint64_t lists_of_other_questions(const ContactSet& set, Question question);
/// Questions of frames whose answer contradicts the detector's own question: other bodies, other
/// elements, contacts of pairs that it did not report.
/// @pre the answers are about a frame
std::uint64_t contradictions(const Answers& answers, const Semantics& semantics);

}  // namespace contactcheck::test
