// A PlannerInput for Python (skein.planner.PlannerInput). Each field is converted only when Python reads it.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "uav_agent/python/call.hpp"

namespace skein::agent::python {

/// Registers the class from which Python reads the fields. Call it once.
void register_inputs(py::module_& module);

/// The inputs of a call as a skein.planner.PlannerInput.
py::object inputs_of(const std::shared_ptr<Call>& call);

/// The configuration as a skein.planner.AgentConfig.
py::object to_python(const AgentConfig& agent);

}  // namespace skein::agent::python
