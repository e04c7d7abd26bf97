#include "reference/text/id_check.h"

namespace contactcheck::text {
namespace {

constexpr std::size_t kLongestId = 64;
constexpr const char* kAlphanumeric =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

}  // namespace

bool is_id(const std::string& text) {
  return !text.empty() && text.size() <= kLongestId && text.find_first_of(kAlphanumeric) == 0 &&
         text.find_first_not_of(std::string(kAlphanumeric) + "-_.") == std::string::npos;
}

std::string parse_id(const JsonField& field) {
  std::string id = field.text();
  if (!is_id(id)) {
    field.refuse("letters, digits, '-', '_' and '.', beginning with a letter or digit, at most " +
                 std::to_string(kLongestId));
  }
  return id;
}

}  // namespace contactcheck::text
