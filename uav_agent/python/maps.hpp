// The maps for Python; the module skein.maps documents their functions.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "uav_agent/python/call.hpp"

namespace skein::agent::python {

/// Registers the classes of the maps. Call it once.
void register_maps(py::module_& module);

/// The maps of a call; None if the planner has no such map.
py::object occupancy_map_of(const std::shared_ptr<Call>& call);
py::object world_map_of(const std::shared_ptr<Call>& call);
py::object free_space_of(const std::shared_ptr<Call>& call);

}  // namespace skein::agent::python
