// The network of a domain (core/config/network_config.hpp), resolved on this host: own address, addresses of peers,
// size of a packet. Both vendors' settings are derived from it.
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/network_config.hpp"

namespace skein::bus {

/// Addresses of hosts, by name; only of those whose address is known.
using Addresses = std::map<std::string, in_addr>;

struct Reach {
  bool host_only = true;                 ///< no message leaves the host
  std::string address;                   ///< own IPv4 address in that network; empty: the vendor chooses
  std::vector<std::string> peers;        ///< IPv4 addresses of hosts; if there are any, multicast is not used
  std::size_t largest_datagram = 65500;  ///< UDP payload of one packet [bytes]; IP fragments larger datagrams

  bool by_peers() const { return !peers.empty(); }
};

/// Resolves a network.
/// @param domain    name of the domain, for messages.
/// @param patience  If the own address is needed, the longest time for which peers' names are looked up until one of
///                  them determines it: a route to another peer, or a name of this host. Peers whose address is still
///                  unknown are left out: when they start later, they contact the hosts that run already.
/// @param asked  a recent result of look_up_all() for the peers, if there is one.
/// @throws InputError for an interface that this host does not have; std::runtime_error if the own address stays
///   unknown.
Reach find_reach(const DomainNetwork& network, const std::string& domain, std::chrono::milliseconds patience,
                 const std::optional<Addresses>& asked = {});

/// @throws InputError if `network` names an interface that this host does not have.
void check_interface(const DomainNetwork& network, const std::string& domain);

/// The IPv4 address of a host, given by name or as an address; nullopt if it is unknown. May block for seconds in the
/// system's resolver.
std::optional<in_addr> look_up(const std::string& host);

/// Looks up many hosts in parallel, because an unknown name may take seconds.
Addresses look_up_all(std::vector<std::string> hosts);

/// The own address from which packets to `peer` are sent; nullopt if there is no route.
std::optional<in_addr> source_towards(const in_addr& peer);

}  // namespace skein::bus
