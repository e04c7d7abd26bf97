#include "reference/text/json_value.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/types/check.h"
#include "core/types/shortest.h"
#include "reference/text/file_text.h"
#include "reference/text/printable.h"

namespace contactcheck::text {
namespace {

// Scene files are four levels deep; unbounded nesting would only exhaust the stack.
constexpr std::size_t kDeepest = 64;

// Bytes in a message: keys of any length may be nested before anybody asks whether they are
// allowed.
constexpr std::size_t kLongestKey = 100, kLongestPath = 300;

// `text` from a file as a message shows it, without quotes.
std::string plain(const std::string& text, std::size_t longest = std::string::npos) {
  const std::string quoted = in_quotes(text, longest);
  return quoted.substr(1, quoted.size() - 2);
}

// What nlohmann read last; a text brings its own quotes.
std::string shown_token(const std::string& token) {
  return !token.empty() && token[0] == '"' ? plain(token.substr(0, 40)) : in_quotes(token, 40);
}

std::string place_of(std::size_t at, const std::string& text) {
  const std::string before = text.substr(0, at);
  const std::size_t line_end = before.rfind('\n');
  const std::size_t column = line_end == std::string::npos ? at + 1 : at - line_end;
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " + std::to_string(column);
}

// Builds the value bottom-up: open arrays and objects wait on a stack.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(const std::string& text, const std::string& document)
      : text_(text), document_(document) {}

  JsonValue take() { return std::move(root_); }

  bool null() override { return add({}); }
  bool boolean(bool value) override {
    JsonValue out;
    out.kind = JsonValue::Kind::kBool;
    out.boolean = value;
    return add(std::move(out));
  }
  bool number_integer(number_integer_t value) override {
    return add_number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add_number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
  bool string(string_t& value) override {
    JsonValue out;
    out.kind = JsonValue::Kind::kText;
    out.text = value;
    return add(std::move(out));
  }
  bool binary(binary_t&) override { return false; }  // never called for text

  bool start_object(std::size_t) override { return open(JsonValue::Kind::kObject); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::kArray); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    JsonValue& object = open_.back();
    if (object.find(value) != nullptr) {
      throw InputError(document_ + ": " + end_of(member_path(path(), value), kLongestPath) +
                       " is given twice.");
    }
    object.keys.push_back(value);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::json::exception&) override {
    const std::size_t at = std::min(position > 0 ? position - 1 : 0, text_.size());
    const std::string place = place_of(at, text_);
    if (at == text_.size()) {
      throw InputError(document_ + " is not valid JSON: it ends too early, at " + place + ".");
    }
    throw InputError(document_ + " is not valid JSON at " + place + ", near " + shown_token(token) +
                     ".");
  }

 private:
  bool add_number(double value) {
    JsonValue out;
    out.kind = JsonValue::Kind::kNumber;
    out.number = value;
    return add(std::move(out));
  }

  bool add(JsonValue value) {
    if (open_.empty()) {
      root_ = std::move(value);
    } else {
      open_.back().items.push_back(std::move(value));
    }
    return true;
  }

  bool open(JsonValue::Kind kind) {
    if (open_.size() == kDeepest) {
      throw InputError(document_ + ": " + end_of(path(), kLongestPath) + " is nested deeper than " +
                       std::to_string(kDeepest) + " levels.");
    }
    open_.emplace_back().kind = kind;
    return true;
  }

  bool close() {
    JsonValue value = std::move(open_.back());
    open_.pop_back();
    return add(std::move(value));
  }

  // The path of the innermost open array or object.
  std::string path() const {
    std::string out;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const JsonValue& parent = open_[i];
      out = parent.kind == JsonValue::Kind::kObject ? member_path(out, parent.keys.back())
                                                    : item_path(out, parent.items.size());
    }
    return out;
  }

  const std::string& text_;
  const std::string& document_;
  JsonValue root_;
  std::vector<JsonValue> open_;
};

}  // namespace

const JsonValue* JsonValue::find(const std::string& key) const {
  const auto it = std::find(keys.begin(), keys.end(), key);
  if (it == keys.end()) return nullptr;
  return &items[static_cast<std::size_t>(it - keys.begin())];
}

JsonValue parse_json(const std::string& text, const std::string& document) {
  Builder builder(text, document);
  nlohmann::json::sax_parse(text, &builder);
  // nlohmann takes it for the end and what follows for nothing.
  if (const std::size_t at = text.find('\0'); at != std::string::npos)
    throw InputError(document + " is not valid JSON at " + place_of(at, text) + ": a NUL byte.");
  return builder.take();
}

std::string member_path(const std::string& parent, const std::string& key) {
  return (parent.empty() ? "" : parent + ".") + plain(key, kLongestKey);
}

std::string item_path(const std::string& parent, std::size_t index) {
  return parent + "[" + std::to_string(index) + "]";
}

std::string shown(double number) { return shortest(number); }

std::string shown(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::kNull:
      return "null";
    case JsonValue::Kind::kBool:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::kNumber:
      return shown(value.number);
    case JsonValue::Kind::kText:
      return in_quotes(value.text, 60);
    case JsonValue::Kind::kArray:
      return "an array of " + std::to_string(value.items.size());
    case JsonValue::Kind::kObject:
      return "an object";
  }
  return "unknown";
}

}  // namespace contactcheck::text
