#include "reference/text/json_field.h"

#include <algorithm>
#include <cmath>

#include "core/types/check.h"
#include "core/types/suggestion.h"
#include "reference/text/file_text.h"
#include "reference/text/lists.h"

namespace contactcheck::text {

bool NumberRange::holds(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string NumberRange::described() const {
  std::string out = "a number";
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  if (bounded_below) out += (low_open ? " above " : " of at least ") + shown(low);
  if (bounded_below && bounded_above) out += " and";
  if (bounded_above) out += (high_open ? " below " : " at most ") + shown(high);
  return out;
}

void JsonField::refuse(const std::string& wanted) const {
  fail("is " + shown(*value_) + "; it must be " + wanted);
}

void JsonField::fail(const std::string& rest) const {
  throw InputError(*document_ + ": " + (path_.empty() ? "the document" : path_) + " " + rest + ".");
}

void JsonField::require_object() const {
  if (!is(JsonValue::Kind::kObject)) refuse("an object");
}

void JsonField::only_keys(std::initializer_list<const char*> keys) const {
  only_keys(std::vector<std::string>(keys.begin(), keys.end()));
}

void JsonField::only_keys(const std::vector<std::string>& keys) const {
  require_object();
  for (std::size_t i = 0; i < value_->keys.size(); ++i) {
    const std::string& key = value_->keys[i];
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    JsonField(value_->items[i], *this, member_path(path_, key))
        .fail("is not a known key; " + suggestion(key, keys) + "allowed here: " + joined(keys));
  }
}

void JsonField::no_misspelt_keys(const std::vector<std::string>& keys) const {
  require_object();
  for (std::size_t i = 0; i < value_->keys.size(); ++i) {
    const std::string& key = value_->keys[i];
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    if (const std::string similar = suggestion(key, keys); !similar.empty())
      JsonField(value_->items[i], *this, member_path(path_, key))
          .fail("is not a known key; " + similar + "allowed here: " + joined(keys));
  }
}

std::string JsonField::exactly_one_of(const std::vector<std::string>& keys) const {
  require_object();
  std::string found;
  for (const std::string& key : keys) {
    if (!has(key)) continue;
    if (!found.empty()) {
      fail("has both " + in_quotes(found) + " and " + in_quotes(key) + "; exactly one of " +
           joined(keys) + " is allowed");
    }
    found = key;
  }
  if (found.empty()) fail("has none of the keys " + joined(keys) + "; exactly one is needed");
  return found;
}

JsonField JsonField::at(const std::string& key) const {
  require_object();
  const JsonValue* value = value_->find(key);
  if (value == nullptr) {
    const JsonValue nothing;
    // Who looks for it before the others may not have seen that one of them is misspelt.
    std::string misspelt;
    for (const std::string& there : value_->keys)
      if (!suggestion(there, {key}).empty())
        misspelt = "; " + in_quotes(there) + " may be meant by it";
    JsonField(nothing, *this, member_path(path_, key)).fail("is missing" + misspelt);
  }
  return JsonField(*value, *this, member_path(path_, key));
}

std::vector<JsonField> JsonField::items(std::size_t fewest) const {
  const std::string wanted =
      fewest == 0 ? "an array" : "an array of at least " + std::to_string(fewest);
  if (!is(JsonValue::Kind::kArray) || value_->items.size() < fewest) refuse(wanted);
  std::vector<JsonField> out;
  for (std::size_t i = 0; i < value_->items.size(); ++i) {
    out.push_back(JsonField(value_->items[i], *this, item_path(path_, i)));
  }
  return out;
}

bool JsonField::boolean() const {
  if (!is(JsonValue::Kind::kBool)) refuse("true or false");
  return value_->boolean;
}

std::string JsonField::text() const {
  if (!is(JsonValue::Kind::kText) || value_->text.empty()) refuse("a text that is not empty");
  // The name of a file would end there, and another one be opened.
  if (value_->text.find('\0') != std::string::npos) refuse("a text without the character U+0000");
  return value_->text;
}

std::string JsonField::one_of(const std::vector<std::string>& allowed) const {
  if (!is(JsonValue::Kind::kText) ||
      std::find(allowed.begin(), allowed.end(), value_->text) == allowed.end()) {
    refuse("one of " + joined(allowed));
  }
  return value_->text;
}

double JsonField::number(const NumberRange& range) const {
  if (!is(JsonValue::Kind::kNumber) || !range.holds(value_->number)) refuse(range.described());
  return value_->number;
}

std::size_t JsonField::whole(std::size_t low, std::size_t high) const {
  const double value = value_->number;
  if (!is(JsonValue::Kind::kNumber) || value != std::floor(value) ||
      value < static_cast<double>(low) || value > static_cast<double>(high)) {
    refuse("a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<std::size_t>(value);
}

Vec3 JsonField::vector(const NumberRange& range) const {
  if (!is(JsonValue::Kind::kArray) || value_->items.size() != 3)
    refuse("an array of three numbers");
  const std::vector<JsonField> parts = items();
  return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

}  // namespace contactcheck::text
