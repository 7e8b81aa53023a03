// The bus over eProsima Fast DDS 2.9.
#pragma once

#include <memory>

#include "bus/bus.hpp"

namespace skein::bus {

std::unique_ptr<Bus> make_fastdds_bus(const BusConfig& config);

}  // namespace skein::bus
