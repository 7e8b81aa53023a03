// Restricts a domain of Cyclone DDS to this host, or to one of its networks.
//
// On the loopback interface, Cyclone DDS considers all other addresses unreachable, including the host's own addresses,
// which nodes with default settings announce. reach_own_host() makes Cyclone DDS send to these.
#pragma once

#include <string>

#include "bus/cyclonedds/domain.hpp"

namespace skein::bus::cyclonedds {

/// Makes the domain deaf and mute until one of the two functions below is called. Otherwise Cyclone would ignore, for a
/// long time, a node that announces itself before that call.
/// @throws std::runtime_error when Cyclone fails
void await_own_host(dds_entity_t domain);
/// From now on the domain reaches all nodes on this host, over the loopback interface, and no other nodes.
/// @param participant  in that domain. @throws std::runtime_error when Cyclone fails
void reach_own_host(dds_entity_t domain, dds_entity_t participant);

/// From now on the domain receives only packets to this address of the host, or to the loopback. Otherwise it would
/// receive from all networks, because Cyclone binds its sockets to no address. @throws std::exception on failure
void hear_own_address(dds_entity_t domain, dds_entity_t participant, const std::string& ipv4);

}  // namespace skein::bus::cyclonedds
