#include "reference/text/file_text.h"

#include <algorithm>
#include <cstdint>
#include <istream>

#include "core/types/check.h"
#include "core/types/input_file.h"

namespace contactcheck::text {
namespace {

// Whatever the size was: a file may grow meanwhile, and those of /proc have none. `likely`: what
// there is to be read, as far as it is known.
std::string first_bytes(std::istream& in, std::uintmax_t likely, std::size_t most) {
  constexpr std::size_t kLeast = std::size_t{1} << 12, kMost = std::size_t{1} << 20;
  const std::size_t block = std::clamp<std::uintmax_t>(likely, kLeast - 1, kMost - 1) + 1;
  std::string bytes;
  while (in && bytes.size() < most) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(block, most - before));
    in.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  return bytes;
}

}  // namespace

std::string read_file_bytes(const std::filesystem::path& file, const std::string& kind,
                            std::size_t longest) {
  const std::string name = kind + " " + in_quotes(file.string());
  std::ifstream in = open_input_file(file, name);
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(file, ignored);
  std::string bytes = size <= longest ? first_bytes(in, size, longest + 1) : "";
  if (in.bad()) throw InputError(name + " cannot be read.");
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

}  // namespace contactcheck::text
