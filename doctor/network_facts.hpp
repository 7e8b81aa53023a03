// The network of this host, as a fleet's domains use it. The functions below read facts from /proc and from the kernel,
// without the bus. doctor/checks_program.cpp adds the facts that need the bus.
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

/// A network interface with an IPv4 address.
struct InterfaceFacts {
  std::string name{}, address{};
  std::size_t mtu = 0;
  bool up = false;  ///< enabled, and its link is up (IFF_UP, IFF_RUNNING)
};

struct PeerFacts {
  std::string name{};                    ///< name in the network's configuration
  std::optional<std::string> address{};  ///< nullopt: the look-up failed
  std::optional<std::string> source{};   ///< own address from which packets to it leave; nullopt: no route
  bool ourselves() const { return address && source == address; }
};

/// All domains with the same network.
struct DomainNetworkFacts {
  std::vector<std::string> domains{};
  DomainNetwork network{};
  std::string no_interface{};  ///< why the configured interface is wrong; empty: it is not
  std::string address{};       ///< own address in it; empty: the vendor chooses, or it is unknown
  std::vector<PeerFacts> peers{};
};

struct PortFacts {
  std::set<int> taken{};                       ///< UDP ports to which sockets of this host are bound
  int first_ephemeral = 32768;                 ///< first port that the kernel assigns to clients
  std::map<int, std::optional<pid_t>> held{};  ///< domains that fleets of this host hold; the process, if visible
};

/// Sets `mtu` and `up` of the interface with this name.
void look_at(InterfaceFacts& interface);
PortFacts read_ports();

/// UDP ports of one domain by RTPS's rule: multicast ports, and the unicast ports of this number of participants.
struct DomainPorts {
  int first = 0, last = 0;
};
DomainPorts ports_of(int domain, int participants);

}  // namespace skein::doctor
