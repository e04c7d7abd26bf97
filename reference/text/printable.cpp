#include "reference/text/printable.h"

#include <cxxabi.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>
#include <typeinfo>

#include "core/deform/name_check.h"

namespace contactcheck::text {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// Control characters of ASCII, and U+0080 to U+009F: a terminal may take them for commands.
bool is_control(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  return byte(0) < 0x20 || byte(0) == 0x7f || (byte(0) == 0xc2 && byte(1) < 0xa0);
}

std::string_view first_line(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text.substr(0, text.find_first_of("\n\r"));
}

std::string type_of_current_exception() {
  const std::type_info* type = abi::__cxa_current_exception_type();
  if (type == nullptr) return "something of another language";
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> name(
      abi::__cxa_demangle(type->name(), nullptr, nullptr, &status), &std::free);
  return name ? name.get() : type->name();
}

}  // namespace

std::string printable_line(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::string_view rest = first_line(text); !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    const std::string_view next = length > 0 ? rest.substr(0, length) : "?";
    rest.remove_prefix(std::max<std::size_t>(length, 1));
    if (is_control(next)) continue;
    if (out.size() + next.size() > longest) return out + "...";
    out += next;
  }
  return out;
}

std::string end_of(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t begin = text.size() - longest;
  while (begin < text.size() && (text[begin] & 0xC0) == 0x80) ++begin;
  return "..." + text.substr(begin);
}

std::string current_exception_text() {
  try {
    throw;
  } catch (const std::exception& e) {
    const char* what = e.what();
    const std::string text = printable_line(what != nullptr ? what : "");
    return text.empty() ? "threw " + type_of_current_exception() + " without a word" : text;
  } catch (...) {
    return "threw " + printable_line(type_of_current_exception()) + ", which is no std::exception";
  }
}

}  // namespace contactcheck::text
