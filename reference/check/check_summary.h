// All frames that were checked, summed up for a person and for a program.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/check/checked_frame.h"
#include "reference/check/frame_words.h"
#include "reference/report/tables/headline.h"
#include "reference/scene/scene.h"

namespace contactcheck::check {

/// The most frames, and the most steps, that a terminal shows.
inline constexpr std::size_t kMostShown = 10;

class CheckSummary {
 public:
  /// @pre scene and words outlive it. `between`: steps are checked, too.
  CheckSummary(const scene::Scene& scene, const FrameWords& words, const Allowed& allowed,
               bool between)
      : scene_(scene), words_(words), allowed_(allowed), between_(between) {}

  /// In ascending order of frames.
  void add(CheckedFrame frame);

  bool bad() const { return bad_frames_ > 0 || bad_steps(); }
  std::size_t bad_frames() const { return bad_frames_; }
  /// Steps with a contact that no frame's rule allows.
  std::size_t found_steps() const { return found_steps_; }
  /// Those with contacts in them, or in the step that leads to them.
  const std::vector<CheckedFrame>& listed() const { return listed_; }
  /// The frame of the deepest contact of known depth above 0.
  std::optional<std::size_t> deepest() const { return deepest_; }
  /// The first frame with a contact that is not allowed, else that to which the first such step
  /// leads; null: none.
  const CheckedFrame* first_bad() const;

  /// "3 of 60 frames have a contact that is not allowed"
  std::string title() const;
  std::vector<report::HeadlineFinding> findings() const;
  /// The lines behind what was printed frame by frame.
  std::string text() const;
  /// The event `end`, without `out` and exit code.
  Json event() const;

 private:
  void add_contacts(const CheckedFrame& frame);
  void add_step(const CheckedFrame& frame);
  bool bad_steps() const { return found_steps_ > 0 && !allowed_.impact; }
  std::string frames_text() const;
  std::string steps_text() const;
  std::string deepest_text() const;
  std::string motion_text() const;
  std::string steps_lines() const;
  Json between_json() const;

  const scene::Scene& scene_;
  const FrameWords& words_;
  Allowed allowed_;
  bool between_;
  std::vector<CheckedFrame> listed_;
  std::size_t bad_frames_ = 0, found_steps_ = 0;
  std::optional<std::size_t> first_frame_, first_step_, deepest_;
  double depth_ = 0.0;  // metres, of the deepest
  std::string deepest_words_;
  bool unknown_depth_ = false;  // of any pair
  // Steps that start in contact, and those with a contact that neither frame shows; pairs of
  // elements that meet in the former and are apart at both frames.
  std::size_t starting_ = 0, unseen_ = 0, passing_ = 0;
  judge::OpenBodies open_;
  judge::StepTotals totals_;
};

}  // namespace contactcheck::check
