// A domain's network (core/network_config.hpp) as it is on this host now: own address, others' addresses, size of a
// packet. What both vendors' settings are made of.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "core/network_config.hpp"

namespace skein::bus {

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
/// @throws InputError for an interface that this host has not; std::runtime_error when the own address stays unknown.
Reach find_reach(const DomainNetwork& network, const std::string& domain, std::chrono::milliseconds patience);

/// @throws InputError when the interface is given and this host has none such.
void check_interface(const DomainNetwork& network, const std::string& domain);

}  // namespace skein::bus
