#include "reference/report/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace contactcheck {
namespace {

// Rates are shown with five decimals. The product with 1e5 may fall a rounding step beside a whole
// number (0.29 gives 28999.999...): a few steps of 2^-53 are forgiven, far below any count's reach.
constexpr double kRateSteps = 1e5, kSlack = 0x1p-50;

// Three significant digits without exponent in the range people read.
std::string significant(double value) {
  if (value == 0.0) return "0";
  if (std::isnan(value)) return "-";  // a quotient of nothing by nothing
  const double size = std::fabs(value);
  if (size >= 1e6 || size < 1e-4) return fmt::format("{:.2e}", value);
  const int digits = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, digits);
}

// Beyond this, JSON numbers are not whole in every program that reads them.
constexpr double kLargestWhole = 0x1p53;

}  // namespace

std::int64_t whole_number(const nlohmann::ordered_json& value) {
  const bool whole = value.is_number() && value.get<double>() == std::trunc(value.get<double>()) &&
                     std::fabs(value.get<double>()) <= kLargestWhole;
  if (!whole)
    throw nlohmann::ordered_json::type_error::create(
        302, value.dump() + " is not a whole number within 2^53", &value);
  return value.get<std::int64_t>();
}

std::string format_rate(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "-";
  const double rate = value.get<double>();
  if (rate == 1.0 || rate == 0.0) return fmt::format("{:.0f}", rate);
  const double cut = std::min(std::floor(rate * kRateSteps * (1.0 + kSlack)), kRateSteps - 1.0);
  return fmt::format("{:.5f}", cut / kRateSteps);
}

std::string format_error_rate(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "-";
  const double rate = value.get<double>();
  if (rate == 1.0 || rate == 0.0) return fmt::format("{:.0f}", rate);
  const double raised = std::max(std::ceil(rate * kRateSteps * (1.0 - kSlack)), 1.0);
  return fmt::format("{:.5f}", raised / kRateSteps);
}

std::string format_number(const nlohmann::ordered_json& value) {
  return value.is_null() ? "-" : significant(value.get<double>());
}

std::string format_count(const nlohmann::ordered_json& value) {
  return value.is_null() ? "-" : fmt::format("{}", whole_number(value));
}

std::string format_millimetres(const nlohmann::ordered_json& value) {
  return value.is_null() ? "-" : significant(1e3 * value.get<double>());
}

std::string format_ratio(const nlohmann::ordered_json& ratio, bool interval) {
  if (ratio.is_null()) return "-";
  std::string text = significant(ratio.at("ratio").get<double>()) + "x";
  if (interval)
    text += " [" + significant(ratio.at("low").get<double>()) + ", " +
            significant(ratio.at("high").get<double>()) + "]";
  return text;
}

}  // namespace contactcheck
