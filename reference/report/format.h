// How numbers are shown: short, and never rounded to a better value than they are.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace contactcheck {

/// @throws nlohmann's type_error when the value is no whole number, or beyond 2^53
std::int64_t whole_number(const nlohmann::ordered_json& value);

/// "1" only for exactly 1, otherwise cut (not rounded) to five decimals: 0.99999 never reads as 1.
/// "-" for null.
std::string format_rate(const nlohmann::ordered_json& value);
/// The same for a rate of errors: raised to five decimals, 0.000001 never reads as 0.
std::string format_error_rate(const nlohmann::ordered_json& value);
/// Three significant digits, "-" for null.
std::string format_number(const nlohmann::ordered_json& value);
/// Whole numbers; "-" for null.
std::string format_count(const nlohmann::ordered_json& value);
/// Metres as millimetres with three significant digits; "0" for exactly 0; "-" for null.
std::string format_millimetres(const nlohmann::ordered_json& value);
/// "12.3x [11.8, 12.9]"; "-" for null.
std::string format_ratio(const nlohmann::ordered_json& ratio, bool interval);

}  // namespace contactcheck
