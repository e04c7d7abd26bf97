#include "tests/metamorphic/calls.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contactcheck::test {
namespace {

// What came before the frame: only that it was worked on, not what was said.
void look_at(Detector& detector, const FrameData& data) {
  Frame frame = data.frame();
  if (!detector.needs_vertices())
    for (BodyState& body : frame.bodies) body.vertices = {};
  detector.update(frame);
  ContactSet ignored;
  detector.query(detector.semantics().questions.front(), ignored);
}

// The frame that is half of all frames away.
std::size_t other_frame(const Asked& asked, std::size_t frame) {
  const std::size_t frames = asked.variant.frames.size();
  return (frame + (frames + 1) / 2) % frames;
}

Answers ask_frame(Detector& detector, const Asked& asked, std::size_t frame) {
  return ask(detector, *asked.variant.frames[frame], frame);
}

// Nothing where that would not be finite.
std::optional<FrameData> far_frame(const std::vector<Body>& bodies, const FrameData& frame) {
  double size = 0.0;
  for (const auto& body : frame.nodes)
    for (const Vec3& n : body) size = std::max(size, n.cwiseAbs().maxCoeff());
  if (!std::isfinite(size * 0x1p24)) return std::nullopt;
  auto nodes = frame.nodes;
  for (auto& body : nodes)
    for (Vec3& n : body) n = 1024.0 * n + size * Vec3(0x1p20, 0, -0x1p18);
  return make_frame(bodies, std::move(nodes));
}

}  // namespace

std::vector<Answers> ask_in_order(const Asked& asked, std::size_t frame) {
  return {ask_frame(asked.detector, asked, frame)};
}

std::vector<Answers> ask_repeatedly(const Asked& asked, std::size_t frame) {
  std::vector<Answers> out = {ask_frame(asked.detector, asked, frame)};
  asked.detector.trace();
  asked.detector.notes();
  for (int i = 0; i < 2; ++i) out.push_back(ask_again(asked.detector));
  return out;
}

std::vector<Answers> update_repeatedly(const Asked& asked, std::size_t frame) {
  std::vector<Answers> out;
  for (int i = 0; i < 3; ++i) out.push_back(ask_frame(asked.detector, asked, frame));
  return out;
}

std::vector<Answers> ask_fresh_detector(const Asked& asked, std::size_t frame) {
  const auto detector = asked.make();
  detector->prepare(asked.variant.bodies);
  return {ask_frame(*detector, asked, frame)};
}

std::vector<Answers> ask_after_other_frame(const Asked& asked, std::size_t frame) {
  if (const auto& other = asked.variant.frames[other_frame(asked, frame)])
    look_at(asked.detector, *other);
  return {ask_frame(asked.detector, asked, frame)};
}

std::vector<Answers> ask_after_far_frame(const Asked& asked, std::size_t frame) {
  if (const auto far = far_frame(asked.variant.bodies, *asked.variant.frames[frame]))
    look_at(asked.detector, *far);
  return {ask_frame(asked.detector, asked, frame)};
}

std::vector<Question> questions_of_frames(const Semantics& semantics) {
  std::vector<Question> out = semantics.questions;
  std::erase_if(out, is_of_steps);
  return out;
}

std::vector<Answers> ask_with_contacts(const Asked& asked, std::size_t frame) {
  ask_frame(asked.detector, asked, frame);
  const std::vector<Question> questions = questions_of_frames(asked.detector.semantics());
  Answers backwards;
  for (auto q = questions.rbegin(); q != questions.rend(); ++q) {
    asked.detector.query(*q, backwards[*q]);
    backwards[*q].canonicalize();
  }
  std::vector<Answers> out = {backwards};
  const auto with_contacts = backwards.find(Question::kContacts);
  if (with_contacts == backwards.end()) return out;
  backwards[questions.front()] = with_contacts->second;
  out.push_back(std::move(backwards));
  return out;
}

std::vector<Answers> ask_after_all(const Asked& asked, std::size_t frame) {
  if (const auto& other = asked.variant.frames[other_frame(asked, frame)])
    look_at(asked.detector, *other);
  std::vector<Answers> out = ask_after_far_frame(asked, frame);
  out.push_back(ask_again(asked.detector));
  for (Answers& answers : ask_with_contacts(asked, frame)) out.push_back(std::move(answers));
  return out;
}

}  // namespace contactcheck::test
