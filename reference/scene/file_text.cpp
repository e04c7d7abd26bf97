#include "reference/scene/file_text.h"

#include <fstream>
#include <iterator>

#include "core/types/check.h"

namespace contactcheck {
std::string read_file_bytes(const std::filesystem::path& file, const std::string& kind) {
  const std::string name = kind + " " + in_quotes(file.string());
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError(name + " does not exist.");
  }
  if (std::filesystem::is_directory(status)) throw InputError(name + " is a folder, not a file.");
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) throw InputError(name + " cannot be read.");
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
