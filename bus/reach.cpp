#include "bus/reach.hpp"

#include <arpa/inet.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>

#include "bus/own_host.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "process/host/address_text.hpp"

namespace skein::bus {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kIpAndUdpHeaders = 28;
constexpr std::size_t kEthernet = 1500;
constexpr std::chrono::milliseconds kAskAgain{200};

std::optional<in_addr> address_in(const std::string& text) {
  in_addr address{};
  if (::inet_pton(AF_INET, text.c_str(), &address) != 1) return std::nullopt;
  return address;
}

/// Whether a text denotes this interface: by its name, its address, or a subnet that contains its address.
bool is_meant(const OwnInterface& own, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return own.name == text || address_text(own.address) == text;
  const auto subnet = address_in(text.substr(0, slash));
  const auto bits = parse_whole<unsigned>(std::string_view(text).substr(slash + 1));
  if (!subnet || !bits || *bits > 32) return false;
  const std::uint32_t mask = *bits == 0 ? 0 : ~std::uint32_t{0} << (32 - *bits);
  return ((ntohl(subnet->s_addr) ^ ntohl(own.address.s_addr)) & mask) == 0;
}

OwnInterface interface_of(const std::string& text, const std::string& domain) {
  const std::vector<OwnInterface> all = own_interfaces();
  const auto found = std::ranges::find_if(all, [&](const OwnInterface& own) { return is_meant(own, text); });
  if (found != all.end()) return *found;
  std::vector<std::string> known;
  for (const OwnInterface& own : all) known.push_back(own.name + " (" + address_text(own.address) + ")");
  throw InputError(
      "--network " + text + " (" + domain +
      "): this host has no network interface of that name, address or subnet with an IPv4 address; it has " +
      joined(known) + ", and \"all\" leaves the choice to the DDS vendor");
}

bool is_loopback(const in_addr& address) { return (ntohl(address.s_addr) >> 24) == 127; }

std::size_t mtu_of(const std::string& address) {
  const std::vector<OwnInterface> all = own_interfaces();
  const auto own = std::ranges::find(all, address, [](const OwnInterface& i) { return address_text(i.address); });
  if (own == all.end()) return kEthernet;
  ifreq request{};
  std::strncpy(request.ifr_name, own->name.c_str(), IFNAMSIZ - 1);
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool known = fd >= 0 && ::ioctl(fd, SIOCGIFMTU, &request) == 0;
  if (fd >= 0) ::close(fd);
  return known ? static_cast<std::size_t>(request.ifr_mtu) : kEthernet;
}

/// Result of a look-up of all peers.
struct Known {
  std::vector<std::string> peers;    ///< addresses
  std::vector<std::string> unknown;  ///< names without a known address
  std::string own;  ///< own address: source of packets to a peer; else address of an own name in the list; may be empty
};

Known addresses_of(const std::vector<std::string>& hosts, const Addresses& addresses) {
  Known known;
  std::string by_name;
  for (const std::string& host : hosts) {
    const auto peer = addresses.find(host);
    if (peer == addresses.end()) {
      known.unknown.push_back(host);
      continue;
    }
    const in_addr& address = peer->second;
    known.peers.push_back(address_text(address));
    const auto source = source_towards(address);
    const bool ourselves = source && source->s_addr == address.s_addr;
    if (source && !ourselves && known.own.empty()) known.own = address_text(*source);
    if (ourselves && !is_loopback(address)) by_name = address_text(address);
  }
  if (known.own.empty()) known.own = by_name;
  return known;
}

/// Looks up the peers; repeatedly, until the own address is known, if only a peer can determine it. Peers that are not
/// found yet will contact this host when they start. @throws std::runtime_error after `patience`.
Known find_peers(const DomainNetwork& network, const std::string& domain, std::chrono::milliseconds patience,
                 const std::optional<Addresses>& asked) {
  const bool by_route = !network.names_interface();
  const auto deadline = Clock::now() + patience;
  Known known = addresses_of(network.peers, asked ? *asked : look_up_all(network.peers));
  while (by_route && !network.peers.empty() && known.own.empty()) {
    if (Clock::now() >= deadline) {
      throw std::runtime_error("network of " + domain + ": none of its peers (" + joined(network.peers) +
                               ") has an address that this host knows a way to; do they run, and in a common " +
                               "network? `interface:` would tell the own one without them");
    }
    ::poll(nullptr, 0, static_cast<int>(kAskAgain.count()));  // no event reports that a name has become known
    known = addresses_of(network.peers, look_up_all(network.peers));
  }
  if (!known.unknown.empty()) {
    spdlog::info("network of {}: {} cannot be found yet; hosts that join later will find this one", domain,
                 joined(known.unknown));
  }
  if (!by_route) known.own.clear();
  return known;
}

}  // namespace

std::optional<in_addr> look_up(const std::string& host) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* first = nullptr;
  if (::getaddrinfo(host.c_str(), nullptr, &hints, &first) != 0) return std::nullopt;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> found(first, &::freeaddrinfo);
  sockaddr_in address;
  std::memcpy(&address, found->ai_addr, sizeof address);
  return address.sin_addr;
}

Addresses look_up_all(std::vector<std::string> hosts) {
  std::ranges::sort(hosts);
  hosts.erase(std::ranges::unique(hosts).begin(), hosts.end());
  std::vector<std::future<std::optional<in_addr>>> answers;
  for (const std::string& host : hosts)
    answers.push_back(std::async(std::launch::async, [&host] { return look_up(host); }));
  Addresses addresses;
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    if (const auto address = answers[i].get()) addresses[hosts[i]] = *address;
  }
  return addresses;
}

std::optional<in_addr> source_towards(const in_addr& peer) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return std::nullopt;
  sockaddr_in there{}, here{};
  there.sin_family = AF_INET;
  there.sin_port = htons(7400);
  there.sin_addr = peer;
  socklen_t size = sizeof here;
  const bool known = ::connect(fd, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
                     ::getsockname(fd, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  ::close(fd);
  return known ? std::optional(here.sin_addr) : std::nullopt;
}

void check_interface(const DomainNetwork& network, const std::string& domain) {
  if (network.names_interface()) interface_of(network.interface, domain);
}

Reach find_reach(const DomainNetwork& network, const std::string& domain, std::chrono::milliseconds patience,
                 const std::optional<Addresses>& asked) {
  Reach reach;
  if (network.host_only()) return reach;
  reach.host_only = false;
  Known known = find_peers(network, domain, patience, asked);
  reach.address = network.names_interface() ? address_text(interface_of(network.interface, domain).address) : known.own;
  reach.peers = std::move(known.peers);
  // No peer's address is known yet. An entry keeps Reach::by_peers() true, and so multicast off.
  if (!network.peers.empty() && reach.peers.empty()) {
    reach.peers.push_back(reach.address.empty() ? "127.0.0.1" : reach.address);
  }
  // The loopback interface has an MTU of 65536, which no UDP datagram fills.
  reach.largest_datagram = std::min(reach.largest_datagram, mtu_of(reach.address) - kIpAndUdpHeaders);
  return reach;
}

}  // namespace skein::bus
