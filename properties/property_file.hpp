// Properties in YAML: in a file of their own, or in a fault test. docs/properties.md explains both. Reads files only.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/scenario.hpp"
#include "properties/property.hpp"

namespace skein::properties {

/// What a file has under a property's name.
using PropertyEntry = std::variant<std::string, skein::Named<std::string>>;  ///< a text, or parameters of a ready one
using PropertyEntries = skein::Named<PropertyEntry>;

/// A property of a file, ready to be evaluated.
struct NamedProperty {
  std::string name;
  std::string text;                        ///< as it was written
  std::vector<std::string> not_with = {};  ///< of a ready one, see ReadyProperty
  std::vector<Property> cases = {};        ///< for each of those that its variables stand for
};
using PropertySet = std::vector<NamedProperty>;

/// @param key      under which the entries stand in the document: "properties".
/// @param errors   gets what is wrong, with line and column: texts that do not parse, ready ones and parameters that do
///   not exist.
PropertySet parse_properties(const PropertyEntries& entries, const std::string& key, const Scenario& scenario,
                             ConfigErrors& errors);

/// What a file of its own has under `properties`. @throws InputError.
PropertyEntries load_property_entries(const std::filesystem::path& file);
/// The same, ready to be evaluated. @throws InputError.
PropertySet load_properties(const std::filesystem::path& file, const Scenario& scenario);

/// One of config/properties/.
struct ReadyProperty {
  std::string name, description, text;
  bool in_hunts = true;  ///< asked in hunts unless somebody says what is
  /// Kinds of faults, and effects of links ("duplication"), with which it says nothing of a program: a hunt does not
  /// ask it of runs with one of them.
  std::vector<std::string> not_with;
  std::map<std::string, std::string> parameters;  ///< with what they are unless somebody says otherwise: "20 s"
};
/// @throws InputError when there is none of this name, or its file is wrong.
ReadyProperty load_ready_property(const std::string& name);
/// In alphabetical order.
std::vector<std::string> ready_property_names();

}  // namespace skein::properties
