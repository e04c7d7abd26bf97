// Short ways to describe an option of a detector.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/detect/registry.h"

namespace contactcheck {

inline OptionInfo choice_option(std::string name, std::string value,
                                std::vector<std::string> choices, std::string help) {
  OptionInfo o;
  o.name = std::move(name);
  o.default_value = std::move(value);
  o.choices = std::move(choices);
  o.help = std::move(help);
  return o;
}

/// An option that is a number in [min, max], whole if `integer`.
inline OptionInfo numeric_option(std::string name, std::string value, double min, double max,
                                 bool integer, std::string help, double step = 2.0) {
  OptionInfo o;
  o.name = std::move(name);
  o.default_value = std::move(value);
  o.min = min;
  o.max = max;
  o.integer = integer;
  o.help = std::move(help);
  o.step = step;
  return o;
}

inline OptionInfo precision_option() {
  return choice_option("precision", "double", {"double", "single"},
                       "single: floats about the centre of the frame, rounded once, not exact");
}

/// @pre the detector has precision_option()
inline bool in_single(const Options& options) { return options.at("precision") == "single"; }
inline Precision precision_of(const Options& options) {
  return in_single(options) ? Precision::kSingle : Precision::kDouble;
}

}  // namespace contactcheck
