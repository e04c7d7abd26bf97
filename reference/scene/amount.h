// A number of a case family, which may depend on the family's parameter $: "1", "0x1p-52", "$",
// "-$", "1+$", "0.5-$*2". The product and the sum are each rounded once, in double.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/types/vec3.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

struct Amount {
  double constant = 0.0;
  double factor = 0.0;  ///< multiplies the parameter

  double at(double parameter) const {
    return factor == 0.0 ? constant : constant + factor * parameter;
  }
};

using AmountVector = std::array<Amount, 3>;

inline Vec3 at(const AmountVector& amounts, double parameter) {
  return {amounts[0].at(parameter), amounts[1].at(parameter), amounts[2].at(parameter)};
}

/// All of `text` as a finite double, decimal or hexadecimal ("0x1.8p-3"); nothing otherwise.
std::optional<double> parse_double(const std::string& text);

/// A JSON number, or a text as in the examples above. @throws InputError
Amount parse_amount(const text::JsonField& field);

/// An array of three amounts. @throws InputError
AmountVector parse_amount_vector(const text::JsonField& field);

}  // namespace contactcheck::scene
