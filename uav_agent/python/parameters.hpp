// Parameters of a planner in Python: reads its Config, a dataclass, with the ConfigReader that reads all configuration.
#pragma once

#include <pybind11/pybind11.h>

#include "core/config/config_node.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// @param planner  class of the planner. @returns the fields of its Config that the document sets, and its FlightConfig
/// if it has one. @throws InputError for wrong keys and values, py::error_already_set for a wrong Config.
py::dict read_parameters(const py::object& planner, const ConfigDocument& document);

/// Reads the FlightConfig that a planner's flight() returned. @throws WrongOutput
FlightConfig read_flight_config(py::handle value);

}  // namespace skein::agent::python
