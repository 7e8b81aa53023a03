// The bus over Eclipse Cyclone DDS 0.10. One set of Cyclone's threads for each domain that the process has joined.
#pragma once

#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

/// Several buses of one process share a domain; its settings are those of the first that joined.
std::unique_ptr<Bus> make_cyclonedds_bus(const BusConfig& config);

}  // namespace skein::bus
