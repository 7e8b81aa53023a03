// Judges the facts of the network (doctor/network_facts.hpp) for a fleet.   Pure; safe from any thread.
#pragma once

#include <optional>

#include "doctor/finding.hpp"
#include "doctor/network_facts.hpp"

namespace skein::doctor {

/// @param multicast  whether multicast groups can be joined on the loopback interface.
Findings judge_interfaces(const std::vector<InterfaceFacts>& interfaces, bool multicast);

/// One finding about the interface that carries these domains, and one about each of their peers.
Findings judge_network(const DomainNetworkFacts& network, const std::vector<InterfaceFacts>& interfaces);

/// The block of domains that a fleet would use.
struct BlockWish {
  std::optional<int> base{};  ///< --domain; nullopt: the launcher takes the first free block
  int size = 0;               ///< number of domains
  int participants = 32;      ///< participants per domain and host to which others announce themselves
};
/// Findings about the block, about other programs on its ports, and about the ports that the kernel assigns to clients;
/// only the first if no block is free.
Findings judge_ports(const PortFacts& ports, const BlockWish& wish);

}  // namespace skein::doctor
