// The rules that scenes are drawn from: fixtures/drawn.json, or a file of the user
// (fixtures/README.md, "Drawn scenes").
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reference/text/json_value.h"

namespace contactcheck::scene {

struct DrawRange {
  double low = 0.0, high = 0.0;
};

enum class Happening { kApart, kNearMiss, kGraze, kTouch, kDeep, kPile, kNested };
inline constexpr std::array<const char*, 7> kHappenings = {"apart", "near-miss", "graze", "touch",
                                                           "deep",  "pile",      "nested"};
inline const char* name_of(Happening what) { return kHappenings[static_cast<std::size_t>(what)]; }

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
};

/// @throws InputError, one sentence: file, path of the field, value, what is allowed
DrawRules parse_draw_rules(const std::string& text, const std::string& document);

/// True if a JSON document contains draw rules.
bool holds_draw_rules(const text::JsonValue& document);

}  // namespace contactcheck::scene
