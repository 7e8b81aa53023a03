// The network as it is here, for a fleet's domains. Reads from /proc what has no need of the bus; what has, its program
// adds (doctor/checks_program.cpp).
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/config/network_config.hpp"

namespace skein::doctor {

/// With an IPv4 address.
struct InterfaceFacts {
  std::string name{}, address{};
  std::size_t mtu = 0;
  bool up = false;  ///< and its cable, or what it has for one, plugged in
};

struct PeerFacts {
  std::string name{};                    ///< as the network's text has it
  std::optional<std::string> address{};  ///< nullopt: not known
  std::optional<std::string> source{};   ///< own address from which packets to it leave; nullopt: there is no way
  bool ourselves() const { return address && source == address; }
};

/// Of all domains that have the same network.
struct DomainNetworkFacts {
  std::vector<std::string> domains{};
  DomainNetwork network{};
  std::string no_interface{};  ///< what is wrong with the interface that it names; empty: nothing
  std::string address{};       ///< own one in it; empty: the vendor chooses, or there is none
  std::vector<PeerFacts> peers{};
};

struct PortFacts {
  std::set<int> taken{};                       ///< UDP ports that somebody here is bound to
  int first_ephemeral = 32768;                 ///< first of those that the kernel gives to clients
  std::map<int, std::optional<pid_t>> held{};  ///< domains that fleets of this host hold, and by which process
};

/// Fills in `mtu` and `up`.
void look_at(InterfaceFacts& interface);
PortFacts read_ports();

/// UDP ports of one domain by RTPS's rule: groups, and the unicast ports of so many participants.
struct DomainPorts {
  int first = 0, last = 0;
};
DomainPorts ports_of(int domain, int participants);

}  // namespace skein::doctor
