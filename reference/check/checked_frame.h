// What `check` found in one frame, and in the step that leads to it: all that is said, kept and
// shown.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/judge/frame_check.h"
#include "reference/judge/step_check.h"

namespace contactcheck::check {

using Json = nlohmann::ordered_json;

/// The first pairs of triangles: body, triangle, body, triangle of each.
using FlatPairs = std::vector<std::uint32_t>;

/// Contacts, of a frame or of a step.
struct FoundContacts {
  Json event;                      ///< as events have it (fixtures/README.md); null: none
  std::vector<std::string> words;  ///< a sentence per contact, those of `event` in their order
  std::vector<bool> found;  ///< of a step, per contact: it is not judged by the frames (Allowed)
  FlatPairs pairs;  ///< of a step: triangles of the elements that are first to meet, where that is
                    ///< not judged by the frames

  bool empty() const { return event.is_null(); }
};

struct CheckedFrame {
  std::size_t frame = 0;
  std::string stamp;   ///< of its files: another one means that they have changed
  FoundContacts here;  ///< not allowed ones
  FoundContacts step;  ///< from the frame before to this one, allowed or not
  /// What the next frame goes on from.
  judge::FrameContacts contacts;
  judge::OpenBodies open;
  judge::StepTotals totals;

  /// True if the step has a contact that the frames do not judge.
  bool found_in_step() const { return std::ranges::find(step.found, true) != step.found.end(); }
};

Json to_json(const CheckedFrame& frame);
/// @throws Json::exception for a missing or other field
CheckedFrame checked_frame(const Json& json);

}  // namespace contactcheck::check
