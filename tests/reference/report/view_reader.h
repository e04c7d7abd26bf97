// Reads the container of reference/report/formats/view_bytes.h as the page does, by its description
// alone.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace contactcheck::test {

class ViewReader {
 public:
  /// Fails the test where `bytes` are no such container.
  explicit ViewReader(std::string bytes);

  const nlohmann::ordered_json& header() const { return header_; }
  const nlohmann::ordered_json& scene(std::size_t number) const;

  /// An array that the header of `scene` names; whole numbers and singles alike as doubles.
  std::vector<double> array(const nlohmann::ordered_json& scene,
                            const nlohmann::ordered_json& reference) const;

 private:
  std::string bytes_;
  nlohmann::ordered_json header_;
  std::size_t arrays_ = 0;  ///< byte where the arrays start
};

}  // namespace contactcheck::test
