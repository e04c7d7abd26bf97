#include "reference/run/printable.h"

#include <cxxabi.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <typeinfo>

namespace contactcheck {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

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
  for (const char c : first_line(text)) {
    if (out.size() == longest) return out + "...";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) {
      out += '?';
    } else if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    }
  }
  return out;
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

}  // namespace contactcheck
