// A domain's network (core/config/network_config.hpp) as it is on this host now: own address, others' addresses, size
// of a packet. What both vendors' settings are made of.
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

/// Of hosts, by name; those that are known.
using Addresses = std::map<std::string, in_addr>;

struct Reach {
  bool host_only = true;                 ///< nothing leaves the host
  std::string address;                   ///< own IPv4 in that network; empty: whichever the vendor chooses
  std::vector<std::string> peers;        ///< IPv4 of other hosts; if there are any, groups (multicast) are not used
  std::size_t largest_datagram = 65500;  ///< bytes that UDP carries in one packet: what is larger, IP cuts to pieces

  bool by_peers() const { return !peers.empty(); }
};

/// @param domain    names it in messages.
/// @param patience  At most so long names are asked for until one tells the own address: that of another peer, or one
///                  of ours. Peers that are not known yet are left out: who comes later finds those that are there, and
///                  they find it by that.
/// @param asked  what look_up_all() has already told of them, if it was asked.
/// @throws InputError for an interface that this host has not; std::runtime_error when the own address stays unknown.
Reach find_reach(const DomainNetwork& network, const std::string& domain, std::chrono::milliseconds patience,
                 const std::optional<Addresses>& asked = {});

/// @throws InputError when the interface is given and this host has none such.
void check_interface(const DomainNetwork& network, const std::string& domain);

/// The IPv4 address of a host, by name or as it is; nullopt when none is known. The system's resolver takes its time.
std::optional<in_addr> look_up(const std::string& host);

/// The same for many at once: who is not known yet may cost seconds.
Addresses look_up_all(std::vector<std::string> hosts);

/// The own address from which packets to `peer` leave; nullopt when there is no way.
std::optional<in_addr> source_towards(const in_addr& peer);

/// "10.77.0.1"
std::string text_of(const in_addr& address);

}  // namespace skein::bus
