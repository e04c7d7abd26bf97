// A JSON document as plain values, read strictly: duplicate keys, trailing text and numbers out of
// range are errors. (nlohmann-json alone keeps the last of duplicate keys; it stays in the .cpp.)
#pragma once

#include <string>
#include <vector>

namespace contactcheck::text {

struct JsonValue {
  enum class Kind { kNull, kBool, kNumber, kText, kArray, kObject };

  Kind kind = Kind::kNull;
  bool boolean = false;
  double number = 0.0;  ///< finite
  std::string text;
  std::vector<JsonValue> items;   ///< of an array, or the values of an object
  std::vector<std::string> keys;  ///< of an object, all different; as many as items

  /// The value under `key`, or null. @pre an object
  const JsonValue* find(const std::string& key) const;
};

/// `document` names the text in messages: scene file "touch.json".
/// @throws InputError with line and column for broken syntax, with the path for duplicate keys
JsonValue parse_json(const std::string& text, const std::string& document);

/// The path of a member as a message shows it: "bodies[1]" and "name" give "bodies[1].name"; of the
/// root: "name". Keys come from files: without control characters, and shortened.
std::string member_path(const std::string& parent, const std::string& key);
std::string item_path(const std::string& parent, std::size_t index);

/// The value as a message shows it: 0.5, "left", an array of 3, an object, null.
std::string shown(const JsonValue& value);

/// The shortest decimal that reads back as the same double.
std::string shown(double number);

}  // namespace contactcheck::text
