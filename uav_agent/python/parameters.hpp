// Parameters of a planner in Python: its Config, a dataclass, read by the reader of all configuration.
#pragma once

#include <pybind11/pybind11.h>

#include "core/config/config_node.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// @param planner  its class. @returns the fields of its Config that the document has, and its FlightConfig if any.
/// @throws InputError for keys and values that are wrong, py::error_already_set for a Config that is.
py::dict read_parameters(const py::object& planner, const ConfigDocument& document);

/// What a planner's flight() returned. @throws WrongOutput
FlightConfig read_flight_config(py::handle value);

}  // namespace skein::agent::python
