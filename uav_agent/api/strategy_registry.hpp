// Registry of planners and of programs at the ground station, by name. Each class registers itself before main().
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "uav_agent/api/agent_config.hpp"

namespace skein::agent {

/// @tparam Product  base class of what the registry makes: Planner or GroundProgram.
template <class Product>
class StrategyRegistry {
 public:
  using Factory = std::unique_ptr<Product> (*)(const ConfigDocument& parameters, const AgentConfig& agent);

  /// Registers a factory. @returns true. @throws std::logic_error when the name is taken.
  static bool add(const std::string& name, Factory factory) {
    if (!factories().emplace(name, factory).second) {
      throw std::logic_error("two strategies are registered as '" + name + "'");
    }
    return true;
  }

  /// All registered names, sorted.
  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const auto& entry : factories()) names.push_back(entry.first);
    return names;
  }

  /// @param spec  "hover", "hover:height_m=4,climb_mps=1" or "patrol:params.yaml" (a YAML file with the same keys).
  /// @param what  the word for Product in error messages: "planner".
  /// @throws InputError when a name or key is unknown (the message has similar or valid ones), a value is invalid, or
  ///   the file cannot be read.
  static std::unique_ptr<Product> make(const std::string& spec, const AgentConfig& agent, const std::string& what) {
    const auto colon = spec.find(':');
    const std::string name = spec.substr(0, colon);
    const std::string parameters = colon == std::string::npos ? "" : spec.substr(colon + 1);
    const auto found = factories().find(name);
    if (found == factories().end()) {
      throw InputError("--planner: there is no " + what + " '" + shortened(name) + "'; " + suggestion(name, names()));
    }
    const bool is_file = !parameters.empty() && parameters.find('=') == std::string::npos;
    if (is_file && !std::filesystem::exists(parameters)) {
      throw InputError("--planner " + name + ":" + parameters + ": there is no file " + parameters +
                       "; parameters are KEY=VALUE, or a file with them");
    }
    return found->second(
        is_file ? read_config_document(parameters) : parse_assignments(parameters, "--planner " + name), agent);
  }

  /// Reads Class::Config and constructs Class(config) or Class(config, agent).
  template <class Class>
  static std::unique_ptr<Product> construct(const ConfigDocument& parameters, const AgentConfig& agent) {
    using Config = typename Class::Config;
    const auto config = read_config<Config>(parameters);
    if constexpr (std::is_constructible_v<Class, const Config&, const AgentConfig&>) {
      return std::make_unique<Class>(config, agent);
    } else {
      return std::make_unique<Class>(config);
    }
  }

 private:
  /// Constructed on first use: static objects of different files are initialised in no defined order.
  static std::map<std::string, Factory>& factories() {
    static std::map<std::string, Factory> factories;
    return factories;
  }
};

}  // namespace skein::agent

/// Registers Class, which derives from Product, under a name, before main(). Use it inside namespace skein::agent. Link
/// its file as an object file: from a static library, a linker may leave it out.
#define SKEIN_REGISTER_STRATEGY(Product, name, Class)                                                    \
  [[maybe_unused]] const bool skein_registered_##Class = ::skein::agent::StrategyRegistry<Product>::add( \
      name, &::skein::agent::StrategyRegistry<Product>::construct<Class>)
