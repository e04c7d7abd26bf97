// The rules that scenes are drawn from: fixtures/drawn.json, or a file of the user
// (fixtures/README.md, "Drawn scenes").
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/text/json_value.h"

namespace contactcheck::scene {

struct DrawRange {
  double low = 0.0, high = 0.0;
};

enum class Happening { kApart, kNearMiss, kGraze, kTouch, kDeep, kPile, kNested, kPass };
inline constexpr std::array<const char*, 8> kHappenings = {"apart", "near-miss", "graze",  "touch",
                                                           "deep",  "pile",      "nested", "pass"};
inline const char* name_of(Happening what) { return kHappenings[static_cast<std::size_t>(what)]; }

/// Rules for scenes that are judged between frames. In these, speed is drawn log-uniform.
struct DrawnSteps {
  /// Largest triangles of a scene times speed. Elements whose boxes over a step meet grow with its
  /// square.
  double most_swept = 0.0;
  double self_share = 0.0;  ///< of the scenes: also judged for contact of bodies with themselves
  DrawRange self_twist;     ///< degrees per step, log-uniform, of one body of each of these
};

struct DrawRules {
  std::string title;
  std::vector<std::string> detectors, meshes;  ///< meshes: data sets and built-in shapes
  std::array<double, kHappenings.size()> shares = {};
  std::size_t most_triangles = 0;                     ///< per scene
  DrawRange triangles, cells;                         ///< per body, log-uniform
  DrawRange bodies, size_ratio;                       ///< log-uniform
  DrawRange frames, speed, contact_share, deformers;  ///< speed: of the largest body, per frame
  DrawRange twist, bend, taper, stretch;              ///< degrees, degrees, amounts
  /// In the smaller body's size, log-uniform.
  DrawRange apart_gap, near_gap, graze_depth, touch_depth, deep_depth;
  std::optional<DrawnSteps> steps;  ///< none: scenes are judged in their frames
};

/// @throws InputError, one sentence: file, path of the field, value, what is allowed
DrawRules parse_draw_rules(const std::string& text, const std::string& document);

/// True if a JSON document contains draw rules.
bool holds_draw_rules(const text::JsonValue& document);

}  // namespace contactcheck::scene
