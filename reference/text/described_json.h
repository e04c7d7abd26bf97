// One description of a struct for both ways, to JSON and back: fields(io, value), in the order of
// the file.
//
//   io("key", member)            always written; missing leaves it as it is
//   io.unless_empty("key", m)    written when it has a value, an element, a character
//   CONTACTCHECK_FIELDS(io, value, a, b, c)               io("a", value.a); and so on
//   CONTACTCHECK_FIELDS(io.unless_empty, value, a, b, c)
//
// A short struct may be an array instead: elements(value) is the std::tie of its members. A variant
// is an array of its index and its value, one of a count and a text the value alone. A description
// is found by the struct's namespace. It must be declared before the first read_described() or
// described() of a struct that has it. For .cpp files alone.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/types/contact_set.h"
#include "core/types/semantics.h"

namespace contactcheck {

// An enum is described by values_of(), and by name_of() of each value.
constexpr auto values_of(Level) { return kLevels; }
constexpr auto values_of(Question) { return kQuestions; }
constexpr std::array<DepthKind, 3> values_of(DepthKind) {
  return {DepthKind::kNone, DepthKind::kVertexSurface, DepthKind::kConvexPair};
}
constexpr std::array<Precision, 2> values_of(Precision) {
  return {Precision::kDouble, Precision::kSingle};
}

inline auto elements(BodyPair& pair) { return std::tie(pair.a, pair.b); }

}  // namespace contactcheck

// At most 41 members, as often as EXPAND has the preprocessor rescan; more do not compile.
#define CONTACTCHECK_FIELDS(io, value, ...) \
  CONTACTCHECK_EXPAND(CONTACTCHECK_FIELD(io, value, __VA_ARGS__))
#define CONTACTCHECK_FIELD(io, value, name, ...) \
  io(#name, value.name);                         \
  __VA_OPT__(CONTACTCHECK_NEXT_FIELD CONTACTCHECK_PARENS(io, value, __VA_ARGS__))
#define CONTACTCHECK_NEXT_FIELD() CONTACTCHECK_FIELD
#define CONTACTCHECK_PARENS ()
#define CONTACTCHECK_EXPAND(...) \
  CONTACTCHECK_EXPAND_4(CONTACTCHECK_EXPAND_4(CONTACTCHECK_EXPAND_4(__VA_ARGS__)))
#define CONTACTCHECK_EXPAND_4(...) \
  CONTACTCHECK_EXPAND_3(CONTACTCHECK_EXPAND_3(CONTACTCHECK_EXPAND_3(__VA_ARGS__)))
#define CONTACTCHECK_EXPAND_3(...) \
  CONTACTCHECK_EXPAND_2(CONTACTCHECK_EXPAND_2(CONTACTCHECK_EXPAND_2(__VA_ARGS__)))
#define CONTACTCHECK_EXPAND_2(...) __VA_ARGS__

namespace contactcheck::text {

using Json = nlohmann::ordered_json;

/// What is missing stays as it is. @throws nlohmann::json::exception for a field of another type,
/// or a name that no value has
template <typename T>
void read_described(const Json& json, T& value);
template <typename T>
Json described(const T& value);

class Reader {
 public:
  static constexpr bool kReads = true;
  explicit Reader(const Json& json) : json_(json) {}
  const Json& json() const { return json_; }

  template <typename T>
  void operator()(const char* key, T& value) {
    if (const auto it = json_.find(key); it != json_.end()) read_described(*it, value);
  }
  template <typename T>
  void unless_empty(const char* key, T& value) {
    (*this)(key, value);
  }

 private:
  const Json& json_;
};

class Writer {
 public:
  static constexpr bool kReads = false;
  explicit Writer(Json& json) : json_(json) {}

  template <typename T>
  void operator()(const char* key, const T& value) {
    json_[key] = described(value);
  }
  template <typename T>
  void unless_empty(const char* key, const T& value) {
    bool empty = false;
    if constexpr (requires { value.empty(); })
      empty = value.empty();
    else
      empty = !value;
    if (!empty) (*this)(key, value);
  }

 private:
  Json& json_;
};

template <typename T>
T value_named(const Json& json) {
  for (const T value : values_of(T{}))
    if (json.get_ref<const std::string&>() == name_of(value)) return value;
  throw Json::other_error::create(501, "unknown name " + json.dump(), &json);
}

template <typename T>
concept HasFields = requires(Reader& reader, T& value) { fields(reader, value); };
template <typename T>
concept HasElements = requires(T& value) { elements(value); };
template <typename T>
concept Optional = requires(T& value) { value.reset(); };
template <typename T>
concept Variant = requires { std::variant_size<T>::value; };
/// A map, or a list of pairs of which the first is a name: both are objects in the file.
template <typename T>
concept Keyed = requires { typename T::value_type::second_type; };
template <typename T>
concept List = requires(T& value) {
  { value.emplace_back() } -> std::same_as<typename T::value_type&>;
};

using CountOrText = std::variant<std::uint64_t, std::string>;

template <typename... Ts>
void read_variant(const Json& json, std::variant<Ts...>& value) {
  std::size_t index = json.at(0).get<std::size_t>();
  if (index >= sizeof...(Ts)) throw Json::other_error::create(501, "no such alternative", &json);
  ((index-- == 0 ? read_described(json.at(1), value.template emplace<Ts>()) : void()), ...);
}

template <typename T>
void read_described(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    value = json;
  } else if constexpr (std::is_enum_v<T>) {
    value = value_named<T>(json);
  } else if constexpr (HasFields<T>) {
    if (!json.is_object()) throw Json::type_error::create(304, "not an object", &json);
    Reader reader(json);
    fields(reader, value);
  } else if constexpr (HasElements<T>) {
    std::size_t next = 0;
    std::apply([&](auto&... member) { (read_described(json.at(next++), member), ...); },
               elements(value));
  } else if constexpr (std::is_same_v<T, CountOrText>) {
    if (json.is_string())
      value = json.get<std::string>();
    else
      value = json.get<std::uint64_t>();
  } else if constexpr (Variant<T>) {
    read_variant(json, value);
  } else if constexpr (std::is_same_v<T, std::map<std::string, std::string>>) {
    value.clear();
    for (const auto& [key, item] : json.items())  // options of other programs may be numbers
      value[key] = item.is_string() ? item.template get<std::string>() : item.dump();
  } else if constexpr (Optional<T>) {
    if (json.is_null())
      value.reset();
    else
      read_described(json, value.emplace());
  } else if constexpr (Keyed<T>) {
    value.clear();
    for (const auto& [key, item] : json.items())
      if constexpr (List<T>) {
        auto& [name, held] = value.emplace_back();
        name = key;
        read_described(item, held);
      } else {
        typename T::key_type place{};
        read_described(Json(key), place);
        read_described(item, value[place]);
      }
  } else if constexpr (List<T>) {
    value.clear();
    for (const Json& item : json) read_described(item, value.emplace_back());
  } else {
    json.get_to(value);
  }
}

template <typename T>
Json described(const T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (HasFields<T>) {
    Json out = Json::object();
    Writer writer(out);
    // A description takes the struct to read into; a writer changes nothing in it.
    fields(writer, const_cast<T&>(value));
    return out;
  } else if constexpr (HasElements<T>) {
    return std::apply([](const auto&... member) { return Json::array({described(member)...}); },
                      elements(const_cast<T&>(value)));
  } else if constexpr (std::is_same_v<T, CountOrText>) {
    return std::visit([](const auto& held) { return Json(held); }, value);
  } else if constexpr (Variant<T>) {
    return std::visit(
        [&](const auto& held) {
          return Json::array({value.index(), described(held)});
        },
        value);
  } else if constexpr (Optional<T>) {
    return value ? described(*value) : Json(nullptr);
  } else if constexpr (Keyed<T>) {
    Json out = Json::object();
    for (const auto& [key, item] : value)
      out[described(key).template get<std::string>()] = described(item);
    return out;
  } else if constexpr (List<T>) {
    Json out = Json::array();
    for (const auto& item : value) out.push_back(described(item));
    return out;
  } else {
    return value;
  }
}

}  // namespace contactcheck::text
