#include "reference/check/kept_recordings.h"

#include <algorithm>
#include <string>

#include "core/deform/recording.h"
#include "core/types/check.h"
#include "reference/text/file_text.h"
#include "reference/text/words.h"

namespace contactcheck::check {
namespace {

namespace fs = std::filesystem;

// A recording to judge detectors by. `own`: the step has contact within a body.
void keep(const std::vector<std::size_t>& frames, bool own, const scene::Scene& scene,
          const fs::path& out) {
  Recording recording;
  recording.scene = frames.size() == 1
                        ? "frame-" + std::to_string(frames[0])
                        : "frames-" + std::to_string(frames[0]) + "-" + std::to_string(frames[1]);
  recording.bodies = scene.bodies;
  recording.time_step = scene.time_step;
  recording.levels = scene.levels;
  const bool others = std::ranges::any_of(scene.levels, [](Level l) { return !is_self(l); });
  for (const Level level : kLevels)
    if (frames.size() > 1 && is_impact(level) && (is_self_impact(level) ? own : others))
      recording.levels.push_back(level);
  for (const std::size_t frame : frames) recording.frames.push_back(scene.nodes_of_frame(frame));
  write_recording(out / (recording.scene + ".ccr"), recording);
}

}  // namespace

std::vector<std::size_t> kept_frames(const std::string& word, std::size_t frames) {
  const std::size_t dash = word.find('-');
  const auto first = text::whole_number<std::size_t>(word.substr(0, dash));
  const auto last =
      dash == std::string::npos ? first : text::whole_number<std::size_t>(word.substr(dash + 1));
  if (!first || !last || *last >= frames || *last - *first > 1)
    throw InputError("--keep " + text::in_quotes(word) + " is neither a frame, from 0 to " +
                     std::to_string(frames - 1) + ", nor two that follow, as 3-4");
  return *first == *last ? std::vector{*first} : std::vector{*first, *last};
}

void write_recordings(const std::vector<std::vector<std::size_t>>& wanted,
                      const CheckSummary& summary, const scene::Scene& scene, const fs::path& out) {
  const auto has_own = [](const CheckedFrame& frame) {
    return !frame.step.empty() &&
           std::ranges::any_of(frame.step.event.at("contacts"), [](const Json& c) {
             return c.at("bodies").at(0) == c.at("bodies").at(1);
           });
  };
  for (const std::vector<std::size_t>& frames : wanted)
    keep(frames,
         std::ranges::any_of(summary.listed(),
                             [&](const CheckedFrame& frame) {
                               return frame.frame == frames.back() && has_own(frame);
                             }),
         scene, out);
  const CheckedFrame* first = summary.first_bad();
  if (first == nullptr) return;
  if (!first->here.empty() && summary.bad_frames() > 0)
    keep({first->frame}, false, scene, out);
  else
    keep({first->frame - 1, first->frame}, has_own(*first), scene, out);
}

}  // namespace contactcheck::check
