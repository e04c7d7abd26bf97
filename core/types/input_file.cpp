#include "core/types/input_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/types/check.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

const char* kind_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    default:
      return "something else";
  }
}

}  // namespace

std::string input_file_fault(const fs::path& file) {
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::regular) return "";
  if (type == fs::file_type::not_found) return " does not exist";
  if (type == fs::file_type::none) return " cannot be read: " + error.message();
  return std::string(" is ") + kind_of(type) + ", not a regular file";
}

std::ifstream open_input_file(const fs::path& file, const std::string& name) {
  const std::string fault = input_file_fault(file);
  if (!fault.empty()) throw InputError(name + fault + ".");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(name + " cannot be read: " + std::strerror(errno) + ".");
  return in;
}

}  // namespace contactcheck
