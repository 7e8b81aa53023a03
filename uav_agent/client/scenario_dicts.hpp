// A scenario as Python's dicts and lists, for the module _skein_client.   Pure; any thread that holds Python's lock.
#pragma once

#include <pybind11/pybind11.h>

#include "core/ids.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::agent {

/// The fields of skein.planner.AgentConfig. At the ground station `index` is None and there is no vehicle.
pybind11::dict to_python(const Scenario& scenario, Node node);

/// The scenario's radio topics at a node, except those that carry captures and their acknowledgements, as tuples of ROS
/// topic, ROS type, and whether the node may send on the topic.
pybind11::list radio_of(const Scenario& scenario, Node node);

}  // namespace skein::agent
