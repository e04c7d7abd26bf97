// Contacts of frames and of steps in words and as events, by the names of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/check/checked_frame.h"
#include "reference/judge/frame_check.h"
#include "reference/judge/step_check.h"
#include "reference/scene/scene.h"

namespace contactcheck::check {

/// What is said of every step: the frames may be joined by other paths.
inline constexpr const char* kPaths = "on straight paths between these frames";

/// What --allow names.
struct Allowed : judge::AllowedContact {
  bool impact = false;

  /// Contact that a frame shows is judged by its depth there.
  bool in_step(const judge::StepContact& c) const {
    return c.starts_in_contact() || (depth && !c.own() && !c.apart_at_both());
  }
};

class FrameWords {
 public:
  /// `labels`: the file of each frame; may be empty. @pre the scene outlives it
  FrameWords(const scene::Scene& scene, std::vector<std::string> labels, const Allowed& allowed);

  const std::string& name(std::uint32_t body) const { return scene_.bodies[body].name; }
  std::string place(std::size_t frame) const;  ///< "frame 3 (cloth_0003.obj)"
  std::string places(std::size_t step) const { return place(step) + " to " + place(step + 1); }
  Json file(std::size_t frame) const;  ///< null without labels

  FoundContacts of_frame(const judge::BadFrame& bad) const;
  /// @pre not empty
  FoundContacts of_step(std::size_t step, const std::vector<judge::StepContact>& contacts) const;

 private:
  std::uint32_t number(std::uint32_t body, std::uint32_t vertex) const;
  std::string depth_text(const oracle::SurfaceDepth& depth) const;
  std::string sentence(const judge::BadFrame::Pair& pair) const;
  std::string sentence(const judge::BadFrame::Self& self) const;
  std::string elements_text(const judge::ElementImpact& impact, bool own) const;
  std::string first_text(const judge::StepContact& c) const;
  std::string sentence(std::size_t step, const judge::StepContact& c) const;
  Json unknown_json(const oracle::SurfaceDepth& depth) const;
  Json elements_json(const judge::ElementImpact& impact) const;
  std::uint32_t triangle_of(const judge::ElementImpact& impact, std::size_t side) const;

  const scene::Scene& scene_;
  std::vector<std::string> labels_;
  Allowed allowed_;
};

}  // namespace contactcheck::check
