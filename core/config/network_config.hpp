// Which network carries each of a fleet's domains. By default nothing leaves the host; in containers each UAV's domain
// has a network of its own, which only the server and the router share with it.
//
//   usual: host                                          # of all domains that are not named
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

/// How the programs in one domain reach each other.
struct DomainNetwork {
  static constexpr const char* kHost = "host";  ///< nothing leaves the host
  static constexpr const char* kAll = "all";    ///< as the DDS vendor chooses

  /// One of the above; or the only interface that is used, by its name, its IPv4 address, or the subnet in which it has
  /// one. Empty: the one that leads to the peers, as is "all" then; without peers, the host.
  std::string interface;
  /// Names or IPv4 addresses of the hosts on which others may run, the own one among them or not. Then nothing is sent
  /// to groups (multicast).
  std::vector<std::string> peers;

  bool host_only() const { return peers.empty() && (interface.empty() || interface == kHost); }
  /// Whether `interface` says which one it is.
  bool names_interface() const { return !interface.empty() && interface != kHost && interface != kAll; }
  bool operator==(const DomainNetwork&) const = default;
};

struct NetworkConfig {
  DomainNetwork usual;
  std::vector<std::pair<std::string, DomainNetwork>> domains;  ///< by name: "world", "gcs", a UAV's

  const DomainNetwork& of(std::string_view domain) const;
  /// @throws InputError when a domain is named that is not among `known`.
  void check_names(const std::vector<std::string>& known) const;
  bool operator==(const NetworkConfig&) const = default;
};

/// What `--network` and SKEIN_NETWORK say: an interface (in any of its forms) for all domains, a YAML file, or its text
/// in braces.
/// @throws InputError
NetworkConfig read_network(const std::string& text);

}  // namespace skein
