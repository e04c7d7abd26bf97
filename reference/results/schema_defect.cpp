#include "reference/results/schema_defect.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "reference/text/file_text.h"
#include "reference/text/json_value.h"
#include "reference/text/lists.h"

namespace contactcheck::results {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestValue = 60;  // bytes that are shown of a text

std::string value_text(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  if (value.is_string()) return text::in_quotes(value.get<std::string>(), kLongestValue);
  return value.dump();
}

std::string wrong(const std::string& path, const Json& value, const std::string& wanted) {
  return (path.empty() ? "the document" : path) + " is " + value_text(value) + "; it must be " +
         wanted;
}

// Beyond 2^53 a double says nothing about the whole number that was meant.
bool is_whole(const Json& value) {
  if (!value.is_number_float()) return value.is_number();
  const double number = value.get<double>();
  return number == std::trunc(number) && std::fabs(number) <= 0x1p53;
}

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "integer") return is_whole(value);
  if (type == "number") return value.is_number();
  return value.type_name() == type;
}

// A keyword's value, alone or in an array, as an array.
Json listed(const Json& value) { return value.is_array() ? value : Json::array({value}); }

std::string joined_texts(const Json& values) {
  return text::joined(
      values, [](const Json& v) { return v.is_string() ? v.get<std::string>() : v.dump(); });
}

// A keyword that nothing here checks would be ignored in silence.
void require_known_keywords(const Json& schema) {
  static const std::set<std::string> of_one_schema = {
      "items", "additionalProperties", "propertyNames", "if", "then", "else"};
  static const std::set<std::string> of_schemas = {"allOf", "anyOf", "oneOf", "properties",
                                                   "$defs"};
  static const std::set<std::string> others = {"$ref",
                                               "$schema",
                                               "title",
                                               "description",
                                               "type",
                                               "const",
                                               "enum",
                                               "minLength",
                                               "minimum",
                                               "exclusiveMinimum",
                                               "maximum",
                                               "required",
                                               "dependentRequired",
                                               "minItems",
                                               "uniqueItems"};
  if (!schema.is_object()) return;  // true or false
  for (const auto& [keyword, value] : schema.items()) {
    if (of_one_schema.count(keyword)) {
      require_known_keywords(value);
    } else if (of_schemas.count(keyword)) {
      for (const Json& part : value) require_known_keywords(part);
    } else if (!others.count(keyword)) {
      throw std::invalid_argument("the schema has the keyword " + text::in_quotes(keyword) +
                                  ", which is not checked");
    }
  }
}

/// Each check gives the first defect that it finds, or "".
class Checker {
 public:
  explicit Checker(const Json& root) : root_(root) { require_known_keywords(root); }

  std::string defect(const Json& schema, const Json& value, const std::string& path) const {
    if (schema == false) return (path.empty() ? "the document" : path) + " is not allowed";
    if (schema.contains("$ref")) {
      std::string found = defect(referred(schema.at("$ref")), value, path);
      if (!found.empty()) return found;
    }
    for (const auto check : {&Checker::kind, &Checker::range, &Checker::members, &Checker::items,
                             &Checker::combinations}) {
      std::string found = (this->*check)(schema, value, path);
      if (!found.empty()) return found;
    }
    return "";
  }

 private:
  // "#/$defs/name"
  const Json& referred(const std::string& reference) const {
    return root_.at(Json::json_pointer(reference.substr(1)));
  }

  bool holds(const Json& schema, const Json& value) const {
    return defect(schema, value, "").empty();
  }

  std::string kind(const Json& schema, const Json& value, const std::string& path) const {
    if (schema.contains("type")) {
      const Json types = listed(schema.at("type"));
      const bool known = std::any_of(types.begin(), types.end(), [&](const Json& type) {
        return is_of_type(value, type.get<std::string>());
      });
      if (!known) return wrong(path, value, "of type " + joined_texts(types));
    }
    if (schema.contains("const") && value != schema.at("const"))
      return wrong(path, value, value_text(schema.at("const")));
    if (schema.contains("enum")) {
      const Json& allowed = schema.at("enum");
      if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
        return wrong(path, value, "one of " + joined_texts(allowed));
    }
    return "";
  }

  std::string range(const Json& schema, const Json& value, const std::string& path) const {
    if (value.is_string() &&
        value.get_ref<const std::string&>().size() < schema.value("minLength", 0u))
      return wrong(path, value, "a text that is not empty");
    if (!value.is_number()) return "";
    if (schema.contains("minimum") && value < schema.at("minimum"))
      return wrong(path, value, "at least " + schema.at("minimum").dump());
    if (schema.contains("exclusiveMinimum") && value <= schema.at("exclusiveMinimum"))
      return wrong(path, value, "above " + schema.at("exclusiveMinimum").dump());
    if (schema.contains("maximum") && value > schema.at("maximum"))
      return wrong(path, value, "at most " + schema.at("maximum").dump());
    return "";
  }

  std::string members(const Json& schema, const Json& value, const std::string& path) const {
    if (!value.is_object()) return "";
    for (const Json& key : schema.value("required", Json::array()))
      if (!value.contains(key.get<std::string>()))
        return text::member_path(path, key.get<std::string>()) + " is missing";
    const Json companions = schema.value("dependentRequired", Json::object());
    for (const auto& [key, others] : companions.items())
      for (const Json& other : others)
        if (value.contains(key) && !value.contains(other.get<std::string>()))
          return text::member_path(path, other.get<std::string>()) + " is missing beside " + key;
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [key, member] : value.items()) {
      std::string found;
      if (schema.contains("propertyNames"))
        found = defect(schema.at("propertyNames"), key, "a key of " + path);
      if (found.empty() && properties.contains(key)) {
        found = defect(properties.at(key), member, text::member_path(path, key));
      } else if (found.empty() && schema.contains("additionalProperties")) {
        found = defect(schema.at("additionalProperties"), member, text::member_path(path, key));
      }
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string items(const Json& schema, const Json& value, const std::string& path) const {
    if (!value.is_array()) return "";
    if (value.size() < schema.value("minItems", 0u))
      return wrong(path, value, "at least " + schema.at("minItems").dump() + " long");
    if (schema.value("uniqueItems", false))
      for (std::size_t i = 1; i < value.size(); ++i)
        if (std::find(value.begin(), value.begin() + i, value[i]) != value.begin() + i)
          return text::item_path(path, i) + " is " + value_text(value[i]) +
                 ", as an earlier one is";
    if (!schema.contains("items")) return "";
    for (std::size_t i = 0; i < value.size(); ++i) {
      std::string found = defect(schema.at("items"), value[i], text::item_path(path, i));
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string combinations(const Json& schema, const Json& value, const std::string& path) const {
    for (const Json& part : schema.value("allOf", Json::array())) {
      std::string found = defect(part, value, path);
      if (!found.empty()) return found;
    }
    if (schema.contains("if")) {
      const char* const branch = holds(schema.at("if"), value) ? "then" : "else";
      std::string found = schema.contains(branch) ? defect(schema.at(branch), value, path) : "";
      if (!found.empty()) return found;
    }
    for (const char* keyword : {"anyOf", "oneOf"}) {
      std::string found = alternatives(schema, keyword, value, path);
      if (!found.empty()) return found;
    }
    return "";
  }

  // Where none fits, what the first one says: it is the usual form, the others are exceptions.
  std::string alternatives(const Json& schema, const char* keyword, const Json& value,
                           const std::string& path) const {
    if (!schema.contains(keyword)) return "";
    const Json& parts = schema.at(keyword);
    const auto fitting = std::count_if(parts.begin(), parts.end(),
                                       [&](const Json& part) { return holds(part, value); });
    if (fitting == 0) return defect(parts.front(), value, path);
    if (fitting == 1 || std::string(keyword) == "anyOf") return "";
    return wrong(path, value, "of one kind alone of " + std::to_string(parts.size()));
  }

  const Json& root_;
};

}  // namespace

std::string schema_defect(const Json& schema, const Json& document) {
  return Checker(schema).defect(schema, document, "");
}

}  // namespace contactcheck::results
