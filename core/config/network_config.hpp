// The network that carries each DDS domain of a fleet. By default no message leaves the host. In containers, each UAV's
// domain has a network of its own, to which only the UAV's programs, sim_server and the router are connected.
//
//   usual: host                                          # for all domains that are not listed
//   world: {peers: [comm_router, station]}
//   jurong: {interface: 172.20.3.0/24, peers: [uav-jurong, router.jurong]}
//
// Pure; safe from any thread.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace skein {

/// The way in which the programs in one domain reach each other.
struct DomainNetwork {
  static constexpr const char* kHost = "host";  ///< no message leaves the host
  static constexpr const char* kAll = "all";    ///< the DDS vendor chooses the interfaces

  /// kHost, kAll, or the single interface to use: its name, its IPv4 address, or the subnet of its address. If empty:
  /// with peers, the interface that routes to them (with peers, kAll means the same); without peers, as kHost.
  std::string interface;
  /// Names or IPv4 addresses of the hosts on which other programs may run; this host may be listed, too. If any peer is
  /// listed, DDS uses no multicast.
  std::vector<std::string> peers;

  bool host_only() const { return peers.empty() && (interface.empty() || interface == kHost); }
  /// Whether `interface` names a particular interface.
  bool names_interface() const { return !interface.empty() && interface != kHost && interface != kAll; }
  bool operator==(const DomainNetwork&) const = default;
};

struct NetworkConfig {
  DomainNetwork usual;
  std::vector<std::pair<std::string, DomainNetwork>> domains;  ///< by domain name: "world", "gcs" or a UAV's name

  const DomainNetwork& of(std::string_view domain) const;
  /// @throws InputError if `domains` lists a domain that is not among `known`.
  void check_names(const std::vector<std::string>& known) const;
  bool operator==(const NetworkConfig&) const = default;
};

/// Parses the value of `--network` or SKEIN_NETWORK: an interface for all domains (any form of
/// DomainNetwork::interface), the path of a YAML file, or the content of such a file in braces.
/// @throws InputError if the file or text is wrong.
NetworkConfig read_network(const std::string& text);

}  // namespace skein
