// A PlannerOutput as Python gave it (skein.planner.PlannerOutput).
#pragma once

#include <pybind11/pybind11.h>

#include "uav_agent/python/module.hpp"

namespace skein::agent::python {

namespace py = pybind11;

/// The limits against which an output is checked.
struct OutputRules {
  const Order& order;
  bool flown = false;                         ///< by the flight core: goals count, motion does not
  std::vector<std::string> debug_names = {};  ///< that were declared
};

/// @param value  what plan() returned. @throws WrongOutput for anything that cannot be flown.
PlannerOutput read_output(py::handle value, const OutputRules& rules);

}  // namespace skein::agent::python
