// For tests: reads a docker-compose file as docker-compose does.
#pragma once

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace skein::cli {

using Texts = std::vector<std::string>;
using Names = std::set<std::string>;

/// Expands a text as docker-compose does when no variable is set: "${X:-y}" becomes "y", "$$" becomes "$".
inline std::string filled_in(const std::string& text) {
  std::string filled;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$') {
      filled += text[i];
    } else if (text.compare(i, 2, "$$") == 0) {
      filled += text[++i];
    } else {
      const std::size_t otherwise = text.find(":-", i), end = text.find('}', i);
      if (text.compare(i, 2, "${") != 0 || otherwise > end) throw std::runtime_error("an odd variable: " + text);
      filled += text.substr(otherwise + 2, end - otherwise - 2);
      i = end;
    }
  }
  return filled;
}

inline Texts texts_of(const YAML::Node& list) {
  Texts texts;
  for (const YAML::Node& text : list) texts.push_back(filled_in(text.as<std::string>()));
  return texts;
}

inline Names names_of(const YAML::Node& map) {
  Names names;
  for (const auto& entry : map) names.insert(entry.first.as<std::string>());
  return names;
}

/// A docker-compose file.
class Compose {
 public:
  explicit Compose(const std::string& text) : root_(YAML::Load(text)) {}

  Names services() const { return names_of(root_["services"]); }
  Names networks() const { return names_of(root_["networks"]); }
  YAML::Node network(const std::string& name) const { return root_["networks"][name]; }
  Names volumes() const { return root_["volumes"] ? names_of(root_["volumes"]) : Names(); }
  /// The service's own value of a key, or that of the settings which all services have in common ("<<").
  YAML::Node of(const std::string& service, const std::string& key) const {
    const YAML::Node own = root_["services"][service];
    return own[key] ? own[key] : own["<<"][key];
  }
  std::string text(const std::string& service, const std::string& key) const {
    return filled_in(of(service, key).as<std::string>());
  }
  Names networks_of(const std::string& service) const { return names_of(of(service, "networks")); }
  Names members(const std::string& network) const {
    Names members;
    for (const std::string& service : services()) {
      if (networks_of(service).contains(network)) members.insert(service);
    }
    return members;
  }
  Texts aliases(const std::string& service, const std::string& network) const {
    return texts_of(of(service, "networks")[network]["aliases"]);
  }
  /// The mounts of a service: key is the path in the container, value the path on the host.
  std::map<std::string, std::string> mounts(const std::string& service) const {
    std::map<std::string, std::string> mounts;
    for (const YAML::Node& volume : of(service, "volumes")) {
      if (volume.IsMap()) {
        EXPECT_EQ(volume["type"].as<std::string>(), "bind");
        mounts[filled_in(volume["target"].as<std::string>())] = filled_in(volume["source"].as<std::string>());
        continue;
      }
      const std::string text = filled_in(volume.as<std::string>()), here = text.substr(0, text.find(':'));
      const std::string rest = text.substr(here.size() + 1);
      mounts[rest.substr(0, rest.find(':'))] = here;
    }
    return mounts;
  }
  /// The value of an option NAME=VALUE in the service's command; empty if it has none.
  std::string option(const std::string& service, const std::string& name) const {
    for (const std::string& argument : texts_of(of(service, "command"))) {
      if (argument.starts_with(name + "=")) return argument.substr(name.size() + 1);
    }
    return {};
  }

 private:
  YAML::Node root_;
};

}  // namespace skein::cli
