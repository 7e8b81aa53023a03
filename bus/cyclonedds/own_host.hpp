// Cyclone DDS on the loopback interface takes every other address for one that it cannot reach, this host's own ones
// included, which nodes with default settings announce. Here it learns to reach them.
#pragma once

#include "bus/cyclonedds/domain.hpp"

namespace skein::bus::cyclonedds {

/// Nothing goes in or out until reach_own_host(): who announced itself before would be passed over, and for long.
/// @throws std::runtime_error when Cyclone fails
void await_own_host(dds_entity_t domain);
/// From here on the domain reaches whoever is on this host by the loopback interface, and nobody else.
/// @param participant  in that domain. @throws std::runtime_error when Cyclone fails
void reach_own_host(dds_entity_t domain, dds_entity_t participant);

}  // namespace skein::bus::cyclonedds
