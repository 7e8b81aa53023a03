// Properties in YAML: in a file of their own, or in a fault test. docs/properties.md explains both. Reads files only.
// Threads: any.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/scenario/scenario.hpp"
#include "signals/properties/property.hpp"

namespace skein::properties {

/// The value under a property's name in a file: a text, or the parameters of a ready property.
using PropertyEntry = std::variant<std::string, skein::Named<std::string>>;
using PropertyEntries = skein::Named<PropertyEntry>;

/// The ready properties that hold in every fault test whose file does not say otherwise. Only these may be `off`.
inline constexpr std::array kDefaultProperties = {"custody_kept", "no_collision", "score_adds_up"};

/// The default properties that `entries` does not mention, as entries of a file.
PropertyEntries missing_defaults(const PropertyEntries& entries);

/// A property of a file, ready to be evaluated.
struct NamedProperty {
  std::string name;
  std::string text;                        ///< as written in the file
  std::vector<std::string> not_with = {};  ///< see ReadyProperty; empty for other properties
  std::vector<Property> cases = {};        ///< one per binding of its variables
};
using PropertySet = std::vector<NamedProperty>;

/// Entries that are `off` give no property.
/// @param key      key of the entries in the document: "properties".
/// @param errors   receives all errors, with line and column: texts that do not parse, and unknown ready properties or
///   parameters, and `off` for a property that is none of kDefaultProperties.
/// @throws InputError if the file of a ready property is wrong.
PropertySet parse_properties(const PropertyEntries& entries, const std::string& key, const Scenario& scenario,
                             ConfigErrors& errors);
/// The same for entries of no particular document. @throws InputError if one is wrong or does not fit the scenario.
PropertySet parse_properties(const PropertyEntries& entries, const Scenario& scenario);

/// The entries of a property file, unparsed. @throws InputError if the file is wrong.
PropertyEntries load_property_entries(const std::filesystem::path& file);
/// The same, ready to be evaluated. @throws InputError if the file or a property is wrong.
PropertySet load_properties(const std::filesystem::path& file, const Scenario& scenario);

/// A ready property: one of config/properties/.
struct ReadyProperty {
  std::string name, description, text;
  bool in_hunts = true;  ///< `skein hunt` checks it unless the user selects properties
  /// Kinds of faults, and effects of links ("duplication"), with which the property says nothing about a program: a
  /// hunt does not check it in runs with one of them.
  std::vector<std::string> not_with;
  std::map<std::string, std::string> parameters;  ///< by name: the default value, "20 s"
};
/// @throws InputError if there is none of this name, or its file is wrong.
ReadyProperty load_ready_property(const std::string& name);
/// In alphabetical order.
std::vector<std::string> ready_property_names();

}  // namespace skein::properties
