// What a domain of Cyclone DDS hears of the host's networks, and what it reaches.
//
// Cyclone DDS on the loopback interface takes every other address for one that it cannot reach, this host's own ones
// included, which nodes with default settings announce. Here it learns to reach them.
#pragma once

#include <string>

#include "bus/cyclonedds/domain.hpp"

namespace skein::bus::cyclonedds {

/// Nothing goes in or out until one of the two below: who announced itself before would be passed over, and for long.
/// @throws std::runtime_error when Cyclone fails
void await_own_host(dds_entity_t domain);
/// From here on the domain reaches whoever is on this host by the loopback interface, and nobody else.
/// @param participant  in that domain. @throws std::runtime_error when Cyclone fails
void reach_own_host(dds_entity_t domain, dds_entity_t participant);

/// From here on the domain hears what was sent to this address of ours, and not what came by another network: its
/// sockets are bound to no address. @throws as above
void hear_own_address(dds_entity_t domain, dds_entity_t participant, const std::string& ipv4);

}  // namespace skein::bus::cyclonedds
