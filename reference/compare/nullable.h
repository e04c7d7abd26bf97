// A quantity that was not measured is null in JSON, never 0.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

namespace contactcheck {

template <typename T>
nlohmann::ordered_json nullable(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace contactcheck
