#include "reference/scene/file_text.h"

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "core/types/check.h"

namespace contactcheck {
namespace {

// Also of what has no size, such as a device that gives bytes without end.
std::string first_bytes(std::istream& in, std::size_t most) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::string bytes;
  while (in && bytes.size() < most) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(kBlock, most - before));
    in.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  return bytes;
}

}  // namespace

std::string read_file_bytes(const std::filesystem::path& file, const std::string& kind,
                            std::size_t longest) {
  const std::string name = kind + " " + in_quotes(file.string());
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError(name + " does not exist.");
  }
  if (std::filesystem::is_directory(status)) throw InputError(name + " is a folder, not a file.");
  std::ifstream in(file, std::ios::binary);
  const auto size = std::filesystem::is_regular_file(status)
                        ? std::filesystem::file_size(file, ignored)
                        : std::uintmax_t{0};
  const std::string bytes = size <= longest ? first_bytes(in, longest + 1) : "";
  if (!in.is_open() || in.bad()) throw InputError(name + " cannot be read.");
  if (std::max<std::uintmax_t>(size, bytes.size()) > longest)
    throw InputError(name + " has more than " + std::to_string(longest >> 20) + " MiB.");
  if (bytes.empty()) throw InputError(name + " is empty.");
  return bytes;
}

std::string in_quotes(const std::string& text, std::size_t longest) {
  std::string out = "\"";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  if (text.size() > longest) out += "...";
  return out + "\"";
}

std::string without_full_stop(std::string sentence) {
  if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
  return sentence;
}

}  // namespace contactcheck
