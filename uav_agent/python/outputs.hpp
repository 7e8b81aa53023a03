// Reads and checks the PlannerOutput that Python returns (skein.planner.PlannerOutput).
#pragma once

#include <pybind11/pybind11.h>

#include "uav_agent/python/module.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// The limits against which an output is checked.
struct OutputRules {
  const Order& order;
  bool flown = false;                         ///< the flight core flies the UAV: goals are allowed, motion is not
  std::vector<std::string> debug_names = {};  ///< names that the planner declared
};

/// @param value  what plan() returned. @throws WrongOutput for anything that cannot be flown.
PlannerOutput read_output(py::handle value, const OutputRules& rules);

}  // namespace skein::agent::python
