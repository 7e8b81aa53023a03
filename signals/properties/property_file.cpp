#include "signals/properties/property_file.hpp"

#include <algorithm>
#include <cctype>

#include "core/config/config_files.hpp"
#include "core/text/suggestion.hpp"
#include "signals/properties/property_parser.hpp"

namespace skein::properties {
namespace {

/// Entry, instead of a text, that selects a ready property with its default parameters.
constexpr std::string_view kReady = "ready";
/// Entry that turns a default property off.
constexpr std::string_view kOff = "off";

std::filesystem::path ready_dir() { return default_config_dir() / "properties"; }

struct ReadyFile {
  std::string name, description, property;
  bool hunt = true;
  std::vector<std::string> not_with;
  skein::Named<std::string> parameters;

  void describe(auto& r) {
    r.field("name", name);
    r.required("description", description);
    r.field("parameters", parameters);
    r.field("hunt", hunt);
    r.field("not_with", not_with);
    r.required("property", property);
  }
};

struct PropertyFile {
  std::string name, description;
  PropertyEntries properties;

  void describe(auto& r) {
    r.field("name", name);
    r.field("description", description);
    r.required("properties", properties);
  }
};

/// Whether a text can name a property. Folders and files of hunts and fault tests are named after properties.
bool is_property_name(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  const auto is_part = [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-'); };
  return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, is_part);
}

/// Parses a quantity such as "20 s". @throws ExpressionError.
Quantity quantity_of(const std::string& text) {
  ExpressionText letters(text);
  const bool negative = letters.accept_mark("-");
  if (!letters.at_number()) ExpressionText::fail(letters.at(), "here must be a number, not " + letters.next_text());
  Quantity value = letters.number();
  letters.expect_end();
  if (negative) value.value = -value.value;
  return value;
}

std::string unit_name(const Unit& unit) {
  return unit == kPlainNumber ? "a plain number" : "a number of " + unit_text(unit);
}

/// Parses one property; reports an error at `key` in the document of `errors`.
void parse_text(NamedProperty& property, const std::map<std::string, Quantity>& parameters, const Scenario& scenario,
                const std::string& key, ConfigErrors& errors) {
  try {
    property.cases = parse_property(property.name, property.text, scenario, parameters);
  } catch (const ExpressionError& error) {
    errors.add_at(key, error.at, error.what());
  }
}

/// Reads a ready property. Errors in its own file are thrown, not reported in the document that uses it.
class ReadyReader {
 public:
  ReadyReader(const std::string& name, const Scenario& scenario)
      : ready_(load_ready_property(name)), scenario_(scenario) {
    for (const auto& [parameter, value] : ready_.parameters) parameters_[parameter] = quantity_of(value);
  }

  /// Sets parameters. @param key  key of the parameters in the document of `errors`.
  void set(const skein::Named<std::string>& given, const std::string& key, ConfigErrors& errors) {
    for (const auto& [parameter, text] : given) {
      const std::string path = key + "." + parameter;
      const auto known = parameters_.find(parameter);
      if (known == parameters_.end()) {
        std::vector<std::string> names;
        for (const auto& [name, value] : parameters_) names.push_back(name);
        errors.check(false, path, "'" + ready_.name + "' has no such parameter; " + suggestion(parameter, names));
        continue;
      }
      set_one(known->second, text, path, errors);
    }
  }

  NamedProperty read(const std::string& name, const std::string& key, ConfigErrors& errors) const {
    NamedProperty property{name, ready_.text, ready_.not_with};
    try {
      property.cases = parse_property(name, ready_.text, scenario_, parameters_);
    } catch (const ExpressionError& error) {
      errors.check(false, key, "the ready property '" + ready_.name + "' does not fit here: " + error.what());
    }
    return property;
  }

 private:
  static void set_one(Quantity& value, const std::string& text, const std::string& path, ConfigErrors& errors) {
    try {
      const Quantity given = quantity_of(text);
      if (given.unit != value.unit) {
        ExpressionText::fail(0, "must be " + unit_name(value.unit) + ", not " + unit_name(given.unit));
      }
      value = given;
    } catch (const ExpressionError& error) {
      errors.add_at(path, error.at, error.what());
    }
  }

  const ReadyProperty ready_;
  const Scenario& scenario_;
  std::map<std::string, Quantity> parameters_;
};

}  // namespace

ReadyProperty load_ready_property(const std::string& name) {
  const auto file = find_config_file("ready property", name, ready_dir());
  const auto content = read_config_file<ReadyFile>(file);
  return {name,         content.description, content.property,
          content.hunt, content.not_with,    {content.parameters.begin(), content.parameters.end()}};
}

std::vector<std::string> ready_property_names() { return config_names(ready_dir()); }

PropertyEntries missing_defaults(const PropertyEntries& entries) {
  PropertyEntries missing;
  for (const char* name : kDefaultProperties) {
    const bool is_there = std::ranges::any_of(entries, [&](const auto& entry) { return entry.first == name; });
    if (!is_there) missing.emplace_back(name, std::string(kReady));
  }
  return missing;
}

PropertySet parse_properties(const PropertyEntries& entries, const std::string& key, const Scenario& scenario,
                             ConfigErrors& errors) {
  PropertySet set;
  const std::vector<std::string> ready = ready_property_names();
  for (const auto& [name, entry] : entries) {
    const std::string path = key + "." + name;
    if (!is_property_name(name)) {
      errors.check(false, path, "a property's name consists of 1 to 64 letters, digits, '_' and '-'");
      continue;
    }
    const std::string* text = std::get_if<std::string>(&entry);
    if (text != nullptr && *text == kOff) {
      errors.check(std::ranges::find(kDefaultProperties, name) != kDefaultProperties.end(), path,
                   "only a property that holds by default can be off: " +
                       joined({kDefaultProperties.begin(), kDefaultProperties.end()}) + "; leave this line out");
      continue;
    }
    if (text != nullptr && *text != kReady) {
      parse_text(set.emplace_back(NamedProperty{name, *text}), {}, scenario, path, errors);
      continue;
    }
    if (std::ranges::find(ready, name) == ready.end()) {
      errors.check(false, path, "there is no ready property '" + name + "'; " + suggestion(name, ready));
      continue;
    }
    ReadyReader reader(name, scenario);
    if (text == nullptr) reader.set(std::get<1>(entry), path, errors);
    set.push_back(reader.read(name, path, errors));
  }
  return set;
}

PropertySet parse_properties(const PropertyEntries& entries, const Scenario& scenario) {
  const ConfigDocument document{"properties", ConfigNode::make_map()};
  ConfigErrors errors(document);
  PropertySet set = parse_properties(entries, "properties", scenario, errors);
  errors.throw_if_any();
  return set;
}

PropertyEntries load_property_entries(const std::filesystem::path& file) {
  return read_config_file<PropertyFile>(file).properties;
}

PropertySet load_properties(const std::filesystem::path& file, const Scenario& scenario) {
  const ConfigDocument document = read_config_document(file);
  const auto content = read_config<PropertyFile>(document);
  ConfigErrors errors(document);
  PropertySet set = parse_properties(content.properties, "properties", scenario, errors);
  errors.throw_if_any();
  return set;
}

}  // namespace skein::properties
