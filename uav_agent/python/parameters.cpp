#include "uav_agent/python/parameters.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <variant>

#include "core/config/config_reader.hpp"
#include "uav_agent/python/interpreter.hpp"
#include "uav_agent/python/values.hpp"

namespace skein::agent::python {
namespace {

/// One field of a Config.
struct Field {
  std::string name, kind;  ///< as skein._embedded.parameters() returns them
  bool optional = false, required = false;
  Bounds bounds;
};

template <class T>
py::object read_field(ConfigReader& reader, const Field& field) {
  T value{};
  if (field.required) {
    reader.required(field.name, value, field.bounds);
  } else {
    reader.field(field.name, value, field.bounds);
  }
  return py::cast(value);
}

py::object read_by_kind(ConfigReader& reader, const Field& field, bool is_null) {
  if (field.optional && is_null) {
    std::optional<double> none;
    reader.field(field.name, none);
    return py::none();
  }
  if (field.kind == "bool") return read_field<bool>(reader, field);
  if (field.kind == "int") return read_field<std::int64_t>(reader, field);
  if (field.kind == "float") return read_field<double>(reader, field);
  if (field.kind == "ints") return read_field<std::vector<std::int64_t>>(reader, field);
  if (field.kind == "floats") return read_field<std::vector<double>>(reader, field);
  if (field.kind == "strs") return read_field<std::vector<std::string>>(reader, field);
  return read_field<std::string>(reader, field);
}

/// Copies a FlightConfig to a skein.planner.FlightConfig.
struct ToPython {
  const py::object& config;
  void field(const char* key, double& value, const Bounds&) { config.attr(key) = value; }
  void field(const char* key, bool& value) { config.attr(key) = value; }
};

/// Copies a skein.planner.FlightConfig to a FlightConfig, and checks the bounds.
struct FromPython {
  py::handle config;
  void field(const char* key, double& value, const Bounds& bounds) {
    const Place root("flight()"), place(root, key);
    const py::object number = config.attr(key);
    value = read_number(number, place);
    if (!bounds.contain(value)) place.refuse(bounds.text(), number);
  }
  void field(const char* key, bool& value) {
    const Place root("flight()"), place(root, key);
    value = read_bool(config.attr(key), place);
  }
};

std::vector<Field> fields_of(const py::object& planner) {
  std::vector<Field> fields;
  for (const py::handle one : interpreter().embedded.attr("parameters")(planner)) {
    const auto [name, kind, optional, required, least, most] =
        one.cast<std::tuple<std::string, std::string, bool, bool, double, double>>();
    fields.push_back({name, kind, optional, required, within(least, most)});
  }
  return fields;
}

}  // namespace

py::dict read_parameters(const py::object& planner, const ConfigDocument& document) {
  py::dict values;
  ConfigErrors errors(document);
  static const ConfigNode kNoKeys = ConfigNode::make_map();
  const bool is_map = document.root.kind == ConfigNode::Kind::map;
  errors.check(is_map || document.root.kind == ConfigNode::Kind::null, "", "must be a map of parameters");
  ConfigReader reader(is_map ? document.root : kNoKeys, "", errors);
  for (const Field& field : fields_of(planner)) {
    if (field.kind == "flight") {
      FlightConfig flight;
      flight.describe(reader);
      const py::object config = interpreter().words.flight_config();
      ToPython to_python{config};
      flight.describe(to_python);
      values[field.name.c_str()] = config;
      continue;
    }
    const ConfigNode* const node = document.root.find(field.name);
    const bool is_null = node != nullptr && node->kind == ConfigNode::Kind::null;
    if (const py::object value = read_by_kind(reader, field, is_null); reader.has(field.name)) {
      values[field.name.c_str()] = value;
    }
  }
  reader.refuse_unknown_keys();
  errors.throw_if_any();
  return values;
}

FlightConfig read_flight_config(py::handle value) {
  if (!py::isinstance(value, interpreter().words.flight_config)) {
    Place("flight()").refuse("a skein.planner.FlightConfig or None", value);
  }
  FlightConfig flight;
  FromPython from_python{value};
  flight.describe(from_python);
  return flight;
}

}  // namespace skein::agent::python
