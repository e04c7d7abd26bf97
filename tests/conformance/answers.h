// What a detector says about one frame, to all questions that it claims, and the checks that need
// no truth.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/detect/detector.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {

/// By question, each canonical.
using Answers = std::map<Question, ContactSet>;

/// Without update: about the frame of the last one.
Answers ask_again(Detector& detector);
/// Update and all questions. Vertices are handed over only to detectors that say they need them, as
/// a run does.
Answers ask(Detector& detector, const FrameData& data, std::size_t index = 0);

/// The same sets, and contacts of the same depths and normals to the bit.
bool same(const Answers& a, const Answers& b);
/// The same, for bodies in the opposite order. Depths may differ by rounding, and normals where
/// several ways out are about as short: of contacts only the pieces and vertices are compared.
bool mirrored(const Answers& a, const Answers& b, std::size_t bodies);
/// "triangles: 1 pair of bodies, 16 of triangles; body: ...".
std::string text(const Answers& answers);

/// Names of bodies, cells, triangles and vertices that the scene does not have, and pairs of a body
/// with itself.
std::uint64_t invalid_ids(const ContactSet& set, const std::vector<Body>& bodies);
/// Contacts whose depth is negative or not finite, or whose normal is not of unit length.
std::uint64_t unusable_contacts(const ContactSet& set);
/// Questions whose answer contradicts the detector's own question: other bodies, other elements,
/// contacts of pairs that it did not report.
std::uint64_t contradictions(const Answers& answers, const Semantics& semantics);

}  // namespace contactcheck::test
