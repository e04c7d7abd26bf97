// A place in a JSON document, for reading it strictly: every refusal is one sentence with the
// document, the path of the field, its value and what is allowed.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types/vec3.h"
#include "reference/text/json_value.h"

namespace contactcheck::text {

/// Bounds of a number; an open bound is not allowed itself.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  bool low_open = false;
  double high = std::numeric_limits<double>::infinity();
  bool high_open = false;

  bool holds(double value) const;
  /// "a number above 0 and at most 100"
  std::string described() const;
};

class JsonField {
 public:
  /// The root of a document. Value and document name must outlive every field.
  JsonField(const JsonValue& value, const std::string& document)
      : value_(&value), document_(&document) {}

  /// "DOCUMENT: PATH is VALUE; it must be WANTED."
  [[noreturn]] void refuse(const std::string& wanted) const;
  /// "DOCUMENT: PATH REST." for defects that are not a bad value.
  [[noreturn]] void fail(const std::string& rest) const;

  const JsonValue& value() const { return *value_; }
  const std::string& path() const { return path_; }
  bool is(JsonValue::Kind kind) const { return value_->kind == kind; }

  /// Requires an object with no other keys than these.
  void only_keys(std::initializer_list<const char*> keys) const;
  void only_keys(const std::vector<std::string>& keys) const;
  /// Requires an object whose other keys resemble none of these: of a document that a later version
  /// of its format may have written.
  void no_misspelt_keys(const std::vector<std::string>& keys) const;
  /// The one key of `keys` that is there. @throws when none or several are
  std::string exactly_one_of(const std::vector<std::string>& keys) const;
  bool has(const std::string& key) const { return value_->find(key) != nullptr; }
  /// @throws when the key is missing
  JsonField at(const std::string& key) const;
  /// Items of an array. @throws when it is no array or has fewer than `fewest`
  std::vector<JsonField> items(std::size_t fewest = 0) const;

  bool boolean() const;
  std::string text() const;
  /// A text out of a list.
  std::string one_of(const std::vector<std::string>& allowed) const;
  double number(const NumberRange& range = {}) const;
  std::size_t whole(std::size_t low, std::size_t high) const;
  /// An array of three numbers.
  Vec3 vector(const NumberRange& range = {}) const;

 private:
  JsonField(const JsonValue& value, const JsonField& parent, std::string path)
      : value_(&value), document_(parent.document_), path_(std::move(path)) {}
  void require_object() const;

  const JsonValue* value_;
  const std::string* document_;
  std::string path_;  // empty for the root
};

}  // namespace contactcheck::text
