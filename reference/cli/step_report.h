// What `check --between` says of the steps from frame to frame, to a person or to a program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reference/judge/frame_check.h"
#include "reference/judge/step_check.h"
#include "reference/results/results.h"
#include "reference/scene/scene.h"

namespace contactcheck::cli {

/// The most frames, and the most steps, that a terminal shows.
inline constexpr std::size_t kMostShown = 10;

/// What --allow names.
struct Allowed : judge::AllowedContact {
  bool impact = false;

  /// Contact that a frame shows is judged by its depth there.
  bool in_step(const judge::StepContact& c) const {
    return c.starts_in_contact() || (depth && !c.own() && !c.apart_at_both());
  }
};

/// Frames by number and file.
struct FrameNames {
  std::vector<std::string> labels;  ///< may be empty

  std::string place(std::size_t frame) const;
  std::string step(std::size_t step) const { return place(step) + " to " + place(step + 1); }
  nlohmann::ordered_json file(std::size_t frame) const;  ///< null without labels
};

void print_event(const nlohmann::ordered_json& event);

class StepReport {
 public:
  /// @pre scene and frames outlive it
  StepReport(const scene::Scene& scene, const FrameNames& frames, const Allowed& allowed, bool json)
      : scene_(scene), frames_(frames), allowed_(allowed), json_(json) {}

  void step(std::size_t step, const std::vector<judge::StepContact>& contacts);

  bool printed() const { return !json_ && !found_.empty(); }
  bool is_bad() const { return !found_.empty() && !allowed_.impact; }
  std::size_t first() const { return found_.front(); }  ///< @pre is_bad()
  bool first_has_own() const { return first_has_own_; }
  /// For the page, with all steps that are not allowed. @pre is_bad()
  results::Finding finding() const;

  void print_end(const judge::StepChecker& checker) const;
  nlohmann::ordered_json end_json(const judge::StepChecker& checker) const;

 private:
  const std::string& name(std::uint32_t body) const { return scene_.bodies[body].name; }
  std::uint32_t number(std::uint32_t body, std::uint32_t vertex) const {
    return scene_.bodies[body].shape->given.number_of(vertex);
  }
  std::string count_text() const;
  std::string elements_text(const judge::ElementImpact& impact, bool own) const;
  std::string first_text(const judge::StepContact& c) const;
  std::string sentence(std::size_t step, const judge::StepContact& c) const;
  nlohmann::ordered_json elements_json(const judge::ElementImpact& impact) const;
  nlohmann::ordered_json json_of(std::size_t step,
                                 const std::vector<judge::StepContact>& contacts) const;

  const scene::Scene& scene_;
  const FrameNames& frames_;
  Allowed allowed_;
  bool json_;
  std::vector<std::size_t> found_;  // steps with a contact of its own
  std::string first_words_;
  bool first_has_own_ = false;
  std::size_t unseen_ = 0, starting_ = 0, passing_ = 0;
};

}  // namespace contactcheck::cli
