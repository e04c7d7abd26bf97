#include "tests/reference/report/view_reader.h"

#include <gtest/gtest.h>

#include <bit>
#include <utility>

namespace contactcheck::test {
namespace {

std::uint32_t little_endian(const std::string& bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = size - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  return value;
}

}  // namespace

ViewReader::ViewReader(std::string bytes) : bytes_(std::move(bytes)) {
  EXPECT_EQ(bytes_.substr(0, 8), "CCVIEW1\n");
  const std::uint32_t size = little_endian(bytes_, 8, 4);
  EXPECT_EQ(size % 4, 0u);
  header_ = nlohmann::ordered_json::parse(bytes_.substr(12, size));
  arrays_ = 12 + size;
  EXPECT_EQ(header_.at("schema"), "contactcheck-view/1");
}

const nlohmann::ordered_json& ViewReader::scene(std::size_t number) const {
  return header_.at("scenes").at(number);
}

std::vector<double> ViewReader::array(const nlohmann::ordered_json& scene,
                                      const nlohmann::ordered_json& reference) const {
  const std::size_t at = reference.at("at");
  EXPECT_EQ(at % 4, 0u);
  const std::size_t start = arrays_ + scene.at("base").get<std::size_t>() + at;
  const bool singles = reference.at("type") == "f32";
  const int size = reference.at("type") == "u16" ? 2 : 4;
  std::vector<double> out;
  for (std::size_t i = 0; i < reference.at("count"); ++i) {
    const std::uint32_t bits =
        little_endian(bytes_, start + i * static_cast<std::size_t>(size), size);
    out.push_back(singles ? static_cast<double>(std::bit_cast<float>(bits)) : bits);
  }
  return out;
}

}  // namespace contactcheck::test
