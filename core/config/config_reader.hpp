// The strict reader of all configuration files. A struct lists its keys once, in describe(). Reading, checking and
// printing (config_writer.hpp) use this list:
//
//   struct LinkFault {
//     std::string from;            ///< node name
//     double delay_s = 0.0;        ///< [0, 10]
//     void describe(auto& r) {
//       r.required("from", from);
//       r.field("delay_s", delay_s, within(0.0, 10.0));
//       r.check(from != "nobody", "from", "must be a node");
//     }
//   };
//   const auto fault = read_config_file<LinkFault>("fault.yaml");
//
// Instead of the member function, a free function `void describe(auto& r, LinkFault& fault)` in the
// same namespace also works. Readable types: bool, integers, double, std::string, std::filesystem::path, enums with
// enum_names() (core/types.hpp), Vector2d and Vector3d, std::array<double, N>, structs, std::vector and
// std::optional of all these, Named<T> (a map with free keys), std::variant<std::string, T> (a text, else a T).
//
// Errors are: an unknown or duplicate key, a wrong type, a number that is out of range or not finite, a missing
// required key. The reader collects the errors of a document and throws them as one InputError, one line each:
// "file:line: key: what would be right".  Pure; a reader is used from one thread.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/config/config_node.hpp"
#include "core/types.hpp"

namespace skein {

/// The range of numbers that a key accepts. For a list or vector, it applies to each element.
struct Bounds {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false;  ///< lo itself is not accepted

  bool contain(double value) const { return (lo_open ? value > lo : value >= lo) && value <= hi; }
  /// "within [0, 1]", "above 0".
  std::string text() const;
};
inline Bounds within(double lo, double hi) { return {lo, hi, false}; }
inline Bounds at_least(double lo) { return {lo, std::numeric_limits<double>::infinity(), false}; }
inline Bounds above(double lo) { return {lo, std::numeric_limits<double>::infinity(), true}; }

/// A map with free keys, in the file's order.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

/// Collects the errors of one document.
class ConfigErrors {
 public:
  /// @param document must outlive this.
  explicit ConfigErrors(const ConfigDocument& document) : document_(document) {}

  void add(int line, const std::string& message);
  /// Adds an error unless `ok`. The message has `key_path` ("fleet[2].start") and the line of that key.
  void check(bool ok, const std::string& key_path, const std::string& what);
  /// Adds an error at a character of a key's text. @param at  index of the character, from 0
  void add_at(const std::string& key_path, std::size_t at, const std::string& what);
  std::size_t count() const { return errors_.size(); }
  /// @throws InputError with one line for each error in the order of the file; ten at most.
  void throw_if_any() const;

 private:
  struct Error {
    ConfigPlace place;  ///< column 0: the line as a whole
    std::string message;
  };
  /// Line and value of a key; for a missing key, those of the innermost existing part of its path.
  std::pair<int, const ConfigNode*> find(const std::string& key_path) const;

  const ConfigDocument& document_;
  std::vector<Error> errors_;
};

/// Reads the keys of one map. Made by read_config(); describe() uses field(), required() and check().
class ConfigReader {
 public:
  static constexpr bool kReads = true;  ///< false in ConfigWriter

  /// @param path  path of the map's key, for messages; empty at the root.
  ConfigReader(const ConfigNode& map, std::string path, ConfigErrors& errors);

  /// Reads an optional key. If the key is absent, `value` does not change.
  template <class T>
  void field(const std::string& key, T& value, const Bounds& bounds = {});
  /// Reads a required key.
  template <class T>
  void required(const std::string& key, T& value, const Bounds& bounds = {});
  /// Adds an error if a rule about the values is broken (`ok` is false), but only if this map has no errors so far.
  void check(bool ok, const std::string& key, const std::string& what);
  bool has(const std::string& key) const { return map_.find(key) != nullptr; }

  /// Adds an error for each key that describe() has not read. Call it after describe().
  void refuse_unknown_keys();

 private:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  const ConfigNode& map_;
  const std::string path_;
  ConfigErrors& errors_;
  const std::size_t errors_before_;
  std::vector<std::string> known_;
};

namespace config_detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsNamed : std::false_type {};
template <class T>
struct IsNamed<std::vector<std::pair<std::string, T>>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsTextOr : std::false_type {};
template <class T>
struct IsTextOr<std::variant<std::string, T>> : std::true_type {};
template <class T>
struct IsNumbers : std::false_type {};
template <std::size_t N>
struct IsNumbers<std::array<double, N>> : std::true_type {};
template <>
struct IsNumbers<Vector2d> : std::true_type {};
template <>
struct IsNumbers<Vector3d> : std::true_type {};

template <class T, class R>
void call_describe(R& r, T& value) {
  if constexpr (requires { value.describe(r); }) {
    value.describe(r);
  } else {
    describe(r, value);
  }
}

/// A node, its path, and the collector of its errors.
struct Place {
  const ConfigNode& node;
  const std::string& path;
  ConfigErrors& errors;

  /// "path: must be `wanted`, not ...".
  void refuse(const std::string& wanted) const;
};

void read_bool(const Place& place, bool& value);
void read_double(const Place& place, double& value, const Bounds& bounds);
void read_integer(const Place& place, std::int64_t& value, const Bounds& bounds);
void read_unsigned(const Place& place, std::uint64_t& value, const Bounds& bounds);
void read_text(const Place& place, std::string& value);
/// Index of the node's text in `names`; nullopt, after an error was added, if `names` lacks it.
std::optional<std::size_t> read_name(const Place& place, const std::vector<std::string>& names);
/// Each adds an error and returns false if the node has another kind or, for numbers, another count.
bool expect_list(const Place& place);
bool expect_numbers(const Place& place, std::size_t count);
bool expect_map(const Place& place);

template <class T>
void read_value(const Place& place, T& value, const Bounds& bounds);

template <class T>
void read_element(const Place& list, std::size_t i, T& value, const Bounds& bounds) {
  const std::string path = list.path + "[" + std::to_string(i) + "]";
  read_value(Place{list.node.items[i], path, list.errors}, value, bounds);
}

template <class T>
void read_integral(const Place& place, T& value, const Bounds& bounds) {
  using Limits = std::numeric_limits<T>;
  std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t> wide = value;
  Bounds fitting = bounds;
  if constexpr (sizeof(T) < 8) {
    fitting.lo = std::max(bounds.lo, static_cast<double>(Limits::min()));
    fitting.hi = std::min(bounds.hi, static_cast<double>(Limits::max()));
  }
  if constexpr (std::is_signed_v<T>) {
    read_integer(place, wide, fitting);
  } else {
    read_unsigned(place, wide, fitting);
  }
  value = static_cast<T>(wide);
}

template <class T>
void read_enum(const Place& place, T& value) {
  std::vector<std::string> names;
  for (const auto& entry : enum_names(T{})) names.emplace_back(entry.name);
  if (const auto i = read_name(place, names)) value = enum_names(T{})[*i].value;
}

template <class T>
void read_struct(const Place& place, T& value) {
  if (!expect_map(place)) return;
  ConfigReader reader(place.node, place.path, place.errors);
  call_describe(reader, value);
  reader.refuse_unknown_keys();
}

template <class T>
void read_named(const Place& place, T& value, const Bounds& bounds) {
  if (!expect_map(place)) return;
  value.clear();
  for (std::size_t i = 0; i < place.node.items.size(); ++i) {
    auto& entry = value.emplace_back();
    entry.first = place.node.keys[i];
    const std::string path = place.path.empty() ? entry.first : place.path + "." + entry.first;
    read_value(Place{place.node.items[i], path, place.errors}, entry.second, bounds);
  }
}

template <class T>
void read_value(const Place& place, T& value, const Bounds& bounds) {
  if constexpr (std::is_same_v<T, bool>) {
    read_bool(place, value);
  } else if constexpr (std::is_integral_v<T>) {
    read_integral(place, value, bounds);
  } else if constexpr (std::is_same_v<T, double>) {
    read_double(place, value, bounds);
  } else if constexpr (std::is_same_v<T, std::string>) {
    read_text(place, value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    std::string text;
    read_text(place, text);
    value = text;
  } else if constexpr (std::is_enum_v<T>) {
    read_enum(place, value);
  } else if constexpr (IsNumbers<T>::value) {
    if (!expect_numbers(place, static_cast<std::size_t>(value.size()))) return;
    for (std::size_t i = 0; i < place.node.items.size(); ++i) read_element(place, i, value[i], bounds);
  } else if constexpr (IsOptional<T>::value) {
    value.reset();
    if (place.node.kind != ConfigNode::Kind::null) read_value(place, value.emplace(), bounds);
  } else if constexpr (IsTextOr<T>::value) {
    if (place.node.kind == ConfigNode::Kind::scalar) {
      read_value(place, value.template emplace<0>(), bounds);
    } else {
      read_value(place, value.template emplace<1>(), bounds);
    }
  } else if constexpr (IsNamed<T>::value) {
    read_named(place, value, bounds);
  } else if constexpr (IsVector<T>::value) {
    if (!expect_list(place)) return;
    value.assign(place.node.items.size(), {});
    for (std::size_t i = 0; i < value.size(); ++i) read_element(place, i, value[i], bounds);
  } else {
    read_struct(place, value);
  }
}

}  // namespace config_detail

template <class T>
void ConfigReader::field(const std::string& key, T& value, const Bounds& bounds) {
  known_.push_back(key);
  const ConfigNode* node = map_.find(key);
  const std::string path = path_of(key);
  if (node) config_detail::read_value(config_detail::Place{*node, path, errors_}, value, bounds);
}

template <class T>
void ConfigReader::required(const std::string& key, T& value, const Bounds& bounds) {
  if (!has(key)) errors_.add(map_.line, "missing key '" + path_of(key) + "': it is required");
  field(key, value, bounds);
}

/// Reads a document as a T; absent keys keep T's defaults.
/// @throws InputError with the document's errors, ten at most.
template <class T>
T read_config(const ConfigDocument& document) {
  T value{};
  ConfigErrors errors(document);
  config_detail::read_value(config_detail::Place{document.root, std::string(), errors}, value, Bounds{});
  errors.throw_if_any();
  return value;
}

/// @throws InputError also when the file is missing or is not YAML.
template <class T>
T read_config_file(const std::filesystem::path& file) {
  return read_config<T>(read_config_document(file));
}

}  // namespace skein
