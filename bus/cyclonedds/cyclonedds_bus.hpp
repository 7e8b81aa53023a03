// The bus over Eclipse Cyclone DDS 0.10. One set of Cyclone's threads for each domain that the process has joined.
#pragma once

#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

/// All buses of a process share each domain that they join; the settings of the first bus to join apply.
std::unique_ptr<Bus> make_cyclonedds_bus(const BusConfig& config);

}  // namespace skein::bus
