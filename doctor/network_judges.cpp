#include "doctor/network_judges.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/text/suggestion.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostDomains = 5;  ///< named in a message

std::string text_of(const InterfaceFacts& interface) {
  return fmt::format("{} {} (MTU {}{})", interface.name, interface.address, interface.mtu,
                     interface.up ? "" : ", down");
}

Finding judge_peer(const DomainNetworkFacts& network, const PeerFacts& peer) {
  const std::string what = "peer " + peer.name, of = " (" + joined_first(network.domains, kMostDomains) + ")";
  if (!peer.address) {
    return failure(
        what, "its name has no address" + of,
        "start it, if it gets its name when it starts, or write its address; a container can resolve only names in "
        "its own networks");
  }
  if (peer.ourselves()) return fine(what, *peer.address + " is this host" + of);
  if (!peer.source) {
    return failure(what, "there is no route to " + *peer.address + of,
                   "join its network (`ip route get " + *peer.address + "` shows the route)");
  }
  if (network.address.empty() || network.address == *peer.source) {
    return fine(what, *peer.address + ", through " + *peer.source + of);
  }
  return failure(
      what, "packets to " + *peer.address + " leave through " + *peer.source + ", not through " + network.address + of,
      "write the peer's address in the network of " + network.address + ", or `interface: " + *peer.source + "`");
}

/// "; other fleets use 8..14 (process 4711)": ranges of successive domains that one process holds; empty if none.
std::string held_text(const PortFacts& ports) {
  std::vector<std::string> blocks;
  for (auto first = ports.held.begin(); first != ports.held.end();) {
    auto last = first, next = std::next(first);
    while (next != ports.held.end() && next->first == last->first + 1 && next->second == first->second) last = next++;
    const std::string who = first->second ? " (process " + std::to_string(*first->second) + ")" : "";
    blocks.push_back(fmt::format("{}..{}{}", first->first, last->first, who));
    first = next;
  }
  return blocks.empty() ? "" : "; other fleets use " + joined(blocks);
}

Finding judge_block(const PortFacts& ports, const BlockWish& wish, int base) {
  const int last = base + wish.size - 1;
  const auto taken = ports.held.lower_bound(base);
  const std::string found =
      wish.base ? fmt::format("{}..{}", base, last) : fmt::format("{}..{}, the first free block", base, last);
  if (taken == ports.held.end() || taken->first > last) return fine("domains", found + held_text(ports));
  return failure("domains", found + held_text(ports) + ": not free",
                 "choose another --domain, or leave it out for the first free block");
}

/// The first block of domains of which no fleet holds any: the launcher would choose the same block.
std::optional<int> free_block(const PortFacts& ports, int size) {
  for (int base = kFirstDomain; base + size - 1 <= kLastDomain; ++base) {
    const auto held = ports.held.lower_bound(base);
    if (held == ports.held.end() || held->first >= base + size) return base;
  }
  return std::nullopt;
}

/// "3 (7 ports), 5 (2 ports)": domains of the block that no fleet holds, but whose ports are in use.
std::vector<std::string> visited(const PortFacts& ports, const BlockWish& wish, int base) {
  std::vector<std::string> domains;
  for (int domain = base; domain < base + wish.size; ++domain) {
    const DomainPorts range = ports_of(domain, wish.participants);
    const auto count = std::distance(ports.taken.lower_bound(range.first), ports.taken.upper_bound(range.last));
    if (count > 0 && !ports.held.contains(domain)) domains.push_back(fmt::format("{} ({} ports)", domain, count));
  }
  return domains;
}

}  // namespace

Findings judge_interfaces(const std::vector<InterfaceFacts>& interfaces, bool multicast) {
  Findings findings;
  std::vector<std::string> all;
  for (const InterfaceFacts& interface : interfaces) all.push_back(text_of(interface));
  const bool loopback =
      std::ranges::any_of(interfaces, [](const InterfaceFacts& i) { return i.up && i.address.starts_with("127."); });
  const std::string there = all.empty() ? "none has an IPv4 address" : joined(all);
  findings.push_back(loopback ? fine("interfaces", there)
                              : failure("interfaces", there + "; there is no loopback interface that is up",
                                        "as root: ip link set lo up"));
  // This is only a warning: a fleet's programs find each other without multicast. But ROS 2 nodes with default settings
  // then use ports on which the fleet may not find them.
  findings.push_back(multicast
                         ? fine("loopback multicast", "programs can join groups")
                         : warning("loopback multicast",
                                   "programs cannot join groups; the fleet flies without, but may not find some ROS 2 "
                                   "nodes beside it (docs/ros2.md)",
                                   "as root: ip link set lo multicast on; some sandboxes have no multicast at all"));
  return findings;
}

Findings judge_network(const DomainNetworkFacts& network, const std::vector<InterfaceFacts>& interfaces) {
  const std::string what = "network of " + joined_first(network.domains, kMostDomains);
  if (network.network.host_only()) return {fine(what, "no message leaves this host")};
  Findings findings;
  const auto own = std::ranges::find(interfaces, network.address, &InterfaceFacts::address);
  if (!network.no_interface.empty()) {
    findings.push_back(
        failure(what, network.no_interface, "name another interface of this host, or bring this one up"));
  } else if (own == interfaces.end()) {
    findings.push_back(network.peers.empty() || network.network.interface == DomainNetwork::kAll
                           ? fine(what, "the DDS vendors choose the interface")
                           : failure(what, "no interface is known: there is no route to any peer with a known address",
                                     "start the peers, or set `interface:`"));
  } else if (!own->up) {
    findings.push_back(failure(what, text_of(*own), "as root: ip link set " + own->name + " up"));
  } else {
    const bool alone = own->address == kLoopback;
    findings.push_back(
        alone ? warning(what, text_of(*own) + ": it does not reach other hosts", "choose another interface")
              : fine(what, text_of(*own)));
  }
  for (const PeerFacts& peer : network.peers) findings.push_back(judge_peer(network, peer));
  return findings;
}

Findings judge_ports(const PortFacts& ports, const BlockWish& wish) {
  const std::optional<int> base = wish.base ? wish.base : free_block(ports, wish.size);
  if (!base) {
    return {failure("domains",
                    fmt::format("no {} successive domains are free; other fleets on this host use them", wish.size),
                    "end one of these fleets")};
  }
  Findings findings = {judge_block(ports, wish, *base)};
  const std::vector<std::string> others = visited(ports, wish, *base);
  findings.push_back(
      others.empty()
          ? fine("ports", fmt::format("UDP {}..{}: only fleets use them", ports_of(*base, 1).first,
                                      ports_of(*base + wish.size - 1, wish.participants).last))
          : warning("ports", "programs that belong to no fleet use UDP ports of the domains " + joined(others),
                    "`ss -ulpn` names these programs; if they are ROS 2 nodes, choose another --domain"));
  const int last = ports_of(*base + wish.size - 1, wish.participants).last;
  if (last < ports.first_ephemeral) {
    findings.push_back(fine("client ports", fmt::format("begin at {}, above the fleet's", ports.first_ephemeral)));
  } else {
    findings.push_back(warning("client ports",
                               fmt::format("the kernel gives ports from {} on to clients; the fleet's ports end at {}",
                                           ports.first_ephemeral, last),
                               "choose a lower --domain, or as root: sysctl -w net.ipv4.ip_local_port_range='" +
                                   std::to_string(last + 1) + " 60999'"));
  }
  return findings;
}

}  // namespace skein::doctor
