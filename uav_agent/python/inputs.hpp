// A PlannerInput as Python reads it: each field when it is asked for (skein.planner.PlannerInput).
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "uav_agent/python/call.hpp"

namespace skein::agent::python {

/// Its class, once.
void register_inputs(py::module_& module);

/// The inputs of a call.
py::object inputs_of(const std::shared_ptr<Call>& call);

/// skein.planner.AgentConfig
py::object to_python(const AgentConfig& agent);

}  // namespace skein::agent::python
