// A number of a case family that may depend on the family's parameter: "1", "0x1p-52", "$", "-$",
// "1+$", "0.5-$*2". A sum is rounded once after the product, both in double.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/types/vec3.h"
#include "reference/text/json_field.h"

namespace contactcheck::scene {

struct Amount {
  double constant = 0.0;
  double factor = 0.0;  ///< of the parameter

  double at(double parameter) const {
    return factor == 0.0 ? constant : constant + factor * parameter;
  }
};

using AmountVector = std::array<Amount, 3>;

inline Vec3 at(const AmountVector& amounts, double parameter) {
  return {amounts[0].at(parameter), amounts[1].at(parameter), amounts[2].at(parameter)};
}

/// A whole text as one finite double, decimal or hexadecimal ("0x1.8p-3"); nothing for other texts.
std::optional<double> parse_double(const std::string& text);

/// A JSON number, or a text as above. @throws InputError
Amount parse_amount(const text::JsonField& field);

/// An array of three. @throws InputError
AmountVector parse_amount_vector(const text::JsonField& field);

}  // namespace contactcheck::scene
