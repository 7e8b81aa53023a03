// Prints a configuration with every key that its describe() lists, so that config_reader.hpp can read it back.
// Pure; safe from any thread.
#pragma once

#include <string>

#include "core/config/config_reader.hpp"

namespace skein {

/// Collects the keys of one struct.
class ConfigWriter {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void field(const std::string& key, const T& value, const Bounds& = {}) {
    if (auto node = node_of(value)) map_.add(key, std::move(*node));
  }
  template <class T>
  void required(const std::string& key, const T& value, const Bounds& = {}) {
    field(key, value);
  }
  void check(bool, const std::string&, const std::string&) {}

  /// The value as a node; nullopt for an empty optional, whose key is left out.
  template <class T>
  static std::optional<ConfigNode> node_of(const T& value);

  ConfigNode take() { return std::move(map_); }

 private:
  static ConfigNode number(double value);
  static ConfigNode text(const std::string& value);

  ConfigNode map_ = ConfigNode::make_map();
};

/// The value as YAML.
template <class T>
std::string config_to_yaml(const T& value) {
  return to_yaml(ConfigWriter::node_of(value).value_or(ConfigNode{}));
}

template <class T>
std::optional<ConfigNode> ConfigWriter::node_of(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return ConfigNode::make_scalar(value ? "true" : "false");
  } else if constexpr (std::is_integral_v<T>) {
    return ConfigNode::make_scalar(std::to_string(value));
  } else if constexpr (std::is_same_v<T, double>) {
    return number(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return text(value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return text(value.string());
  } else if constexpr (std::is_enum_v<T>) {
    return text(name_of(value));
  } else if constexpr (config_detail::IsOptional<T>::value) {
    return value ? node_of(*value) : std::nullopt;
  } else if constexpr (config_detail::IsTextOr<T>::value) {
    return value.index() == 0 ? node_of(std::get<0>(value)) : node_of(std::get<1>(value));
  } else if constexpr (config_detail::IsNamed<T>::value) {
    ConfigNode map = ConfigNode::make_map();
    for (const auto& [key, item] : value) map.add(key, node_of(item).value_or(ConfigNode{}));
    return map;
  } else if constexpr (config_detail::IsNumbers<T>::value || config_detail::IsVector<T>::value) {
    ConfigNode list = ConfigNode::make_list();
    for (const auto& item : value) list.items.push_back(node_of(item).value_or(ConfigNode{}));
    return list;
  } else {
    ConfigWriter writer;
    T copy = value;  // describe() also reads into the struct, so it takes no const reference
    config_detail::call_describe(writer, copy);
    return writer.take();
  }
}

}  // namespace skein
