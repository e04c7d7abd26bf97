#include "reference/report/view_buffers.h"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

namespace contactcheck::report {
nlohmann::ordered_json ViewBuffers::reference(const char* type, std::size_t count) {
  bytes_.resize((bytes_.size() + kViewAlignment - 1) / kViewAlignment * kViewAlignment);
  return {{"type", type}, {"at", bytes_.size()}, {"count", count}};
}

void ViewBuffers::append(std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
}

void ViewBuffers::append(double value) {
  append(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
}

nlohmann::ordered_json ViewBuffers::singles(std::span<const double> values) {
  nlohmann::ordered_json out = reference("f32", values.size());
  for (double value : values) append(value);
  return out;
}

nlohmann::ordered_json ViewBuffers::points(std::span<const Vec3> values) {
  nlohmann::ordered_json out = reference("f32", 3 * values.size());
  for (const Vec3& p : values)
    for (int k = 0; k < 3; ++k) append(p[k]);
  return out;
}

nlohmann::ordered_json ViewBuffers::ids(std::span<const std::uint32_t> values) {
  const bool small =
      std::all_of(values.begin(), values.end(), [](std::uint32_t v) { return v <= UINT16_MAX; });
  nlohmann::ordered_json out = reference(small ? "u16" : "u32", values.size());
  for (std::uint32_t value : values) append(value, small ? 2 : 4);
  return out;
}

}  // namespace contactcheck::report
