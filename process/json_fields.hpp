// Converts structs to JSON objects and back; each struct lists its keys once:
//
//   struct Tally {
//     int points = 0;
//     std::optional<double> score;
//   };
//   void describe(auto& f, Tally& tally) {
//     f.field("points", tally.points);
//     f.field("score", tally.score);  // no key while it is empty; f.nullable(): null
//   }
//
//   Json json = json_of(tally);
//   Tally tally = struct_of<Tally>(json);
//
// Reading never throws: a member whose key is missing, or has a value of another kind, keeps its default (an optional
// with a value of another kind becomes empty). Members may be bool, numbers, strings, enums with names
// (core/types.hpp), paths, such structs, Json (any object), and optionals, vectors, arrays and Named of these. Unfit
// elements of a vector are left out.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/types.hpp"
#include "process/json_text.hpp"

namespace skein {

/// A number that cannot be negative: a time, a distance, a score. Reading treats a negative number as a wrong kind.
class Amount {
 public:
  constexpr Amount(double value = 0.0) : value_(value) {}  // NOLINT: implicit conversions are intended
  constexpr operator double() const { return value_; }     // NOLINT

 private:
  double value_;
};

/// Lets nlohmann::json convert an Amount.
template <class AnyJson>
void to_json(AnyJson& json, const Amount& amount) {
  json = static_cast<double>(amount);
}

/// An object with arbitrary names as keys, in the file's order.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

namespace json_detail {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsNamed = false;
template <class T>
inline constexpr bool kIsNamed<Named<T>> = true;
template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;

template <class T>
Json write(const T& value);
template <class T>
std::optional<T> read(const Json& json);

class Writer {
 public:
  template <class T>
  void field(const char* key, const T& value) {
    if constexpr (kIsOptional<T>) {
      if (value) object_[key] = write(*value);
    } else {
      object_[key] = write(value);
    }
  }
  template <class T>
  void nullable(const char* key, const std::optional<T>& value) {
    object_[key] = value ? write(*value) : Json();
  }
  Json take() { return std::move(object_); }

 private:
  Json object_ = Json::object();
};

class Reader {
 public:
  explicit Reader(const Json& object) : object_(object) {}

  template <class T>
  void field(const char* key, T& value) {
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    if constexpr (kIsOptional<T>) {
      value = read<typename T::value_type>(*found);
    } else if (auto fits = read<T>(*found)) {
      value = std::move(*fits);
    }
  }
  template <class T>
  void nullable(const char* key, std::optional<T>& value) {
    field(key, value);
  }

 private:
  const Json& object_;
};

template <class T>
Json write(const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, Amount> || std::is_same_v<T, std::string> ||
                std::is_same_v<T, Json>) {
    return Json(value);
  } else if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return value.string();
  } else if constexpr (kIsNamed<T>) {
    Json object = Json::object();
    for (const auto& [name, item] : value) object[name] = write(item);
    return object;
  } else if constexpr (kIsVector<T> || kIsArray<T>) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(write(item));
    return list;
  } else {
    Writer writer;
    T copy = value;  // describe() also reads into the struct, so it takes no const reference
    describe(writer, copy);
    return writer.take();
  }
}

/// Reads a whole number. A fraction is cut off; nullopt for a number that T cannot represent.
template <std::integral T>
std::optional<T> whole_number(const Json& json) {
  constexpr double kExact = 9007199254740992.0;  // all whole numbers below 2^53 are doubles
  const auto if_room = [](auto number) {
    return std::in_range<T>(number) ? std::optional(static_cast<T>(number)) : std::nullopt;
  };
  if (json.is_number_unsigned()) return if_room(json.get<std::uint64_t>());
  if (json.is_number_integer()) return if_room(json.get<std::int64_t>());
  if (!json.is_number_float() || !(std::abs(json.get<double>()) < kExact)) return std::nullopt;
  return if_room(static_cast<std::int64_t>(json.get<double>()));
}

template <class T>
std::optional<T> read_enum(const Json& json) {
  if (!json.is_string()) return std::nullopt;
  for (const auto& entry : enum_names(T{})) {
    if (json == entry.name) return entry.value;
  }
  return std::nullopt;
}

template <class T>
std::optional<T> read_list(const Json& json) {
  if (!json.is_array()) return std::nullopt;
  T list;
  for (const Json& item : json) {
    if (auto fits = read<typename T::value_type>(item)) list.push_back(std::move(*fits));
  }
  return list;
}

template <class T>
std::optional<T> read_array(const Json& json) {
  T array{};
  if (!json.is_array() || json.size() != array.size()) return std::nullopt;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const auto fits = read<typename T::value_type>(json[i]);
    if (!fits) return std::nullopt;
    array[i] = *fits;
  }
  return array;
}

template <class T>
std::optional<T> read_named(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  T named;
  for (const auto& [name, item] : json.items()) {
    if (auto fits = read<typename T::value_type::second_type>(item)) named.emplace_back(name, std::move(*fits));
  }
  return named;
}

template <class T>
std::optional<T> read(const Json& json) {
  if constexpr (std::is_same_v<T, bool>) {
    return json.is_boolean() ? std::optional(json.get<bool>()) : std::nullopt;
  } else if constexpr (std::is_integral_v<T>) {
    return whole_number<T>(json);
  } else if constexpr (std::is_floating_point_v<T>) {
    return json.is_number() ? std::optional(json.get<T>()) : std::nullopt;
  } else if constexpr (std::is_same_v<T, Amount>) {
    return json.is_number() && json.get<double>() >= 0.0 ? std::optional(Amount(json.get<double>())) : std::nullopt;
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::filesystem::path>) {
    return json.is_string() ? std::optional<T>(json.get<std::string>()) : std::nullopt;
  } else if constexpr (std::is_same_v<T, Json>) {
    return json.is_object() ? std::optional(json) : std::nullopt;
  } else if constexpr (std::is_enum_v<T>) {
    return read_enum<T>(json);
  } else if constexpr (kIsNamed<T>) {
    return read_named<T>(json);
  } else if constexpr (kIsVector<T>) {
    return read_list<T>(json);
  } else if constexpr (kIsArray<T>) {
    return read_array<T>(json);
  } else {
    if (!json.is_object()) return std::nullopt;
    T value{};
    Reader reader(json);
    describe(reader, value);
    return value;
  }
}

}  // namespace json_detail

/// The value as JSON: a struct becomes an object, a vector of structs an array.
template <class T>
Json json_of(const T& value) {
  return json_detail::write(value);
}

/// The JSON as a T. JSON that is not an object gives T's defaults.
template <class T>
T struct_of(const Json& json) {
  return json_detail::read<T>(json).value_or(T{});
}

}  // namespace skein
