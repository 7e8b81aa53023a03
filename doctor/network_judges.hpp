// What facts of the network (doctor/network_facts.hpp) mean for a fleet.   Pure; safe from any thread.
#pragma once

#include <optional>

#include "doctor/finding.hpp"
#include "doctor/network_facts.hpp"

namespace skein::doctor {

/// @param multicast  whether groups can be joined on the loopback interface.
Findings judge_interfaces(const std::vector<InterfaceFacts>& interfaces, bool multicast);

/// The interface that carries some domains, and one of each of their peers that there is something to say of.
Findings judge_network(const DomainNetworkFacts& network, const std::vector<InterfaceFacts>& interfaces);

/// Which domains a fleet would have.
struct BlockWish {
  std::optional<int> base{};  ///< --domain; without, the launcher takes the first block that is free
  int size = 0;
  int participants = 32;  ///< of a domain that are announced to, and so many ports
};
/// One of the block, one of who else uses its ports, one of ports that the kernel gives to clients.
Findings judge_ports(const PortFacts& ports, const BlockWish& wish);

}  // namespace skein::doctor
