#include "doctor/checks_program.hpp"

#include <algorithm>
#include <chrono>

#include "bus/own_host.hpp"
#include "bus/wire.hpp"
#include "core/types.hpp"
#include "doctor/machine_judges.hpp"
#include "doctor/network_judges.hpp"
#include "doctor/software_judges.hpp"
#include "process/host/address_text.hpp"

namespace skein::doctor {
namespace {

std::vector<InterfaceFacts> read_interfaces() {
  std::vector<InterfaceFacts> interfaces;
  for (const bus::OwnInterface& own : bus::own_interfaces()) {
    interfaces.push_back({.name = own.name, .address = address_text(own.address)});
    look_at(interfaces.back());
  }
  return interfaces;
}

DomainNetworkFacts read_network_of(const std::string& domain, const DomainNetwork& network) {
  DomainNetworkFacts facts{.domains = {domain}, .network = network};
  if (network.host_only()) return facts;
  const bus::Addresses addresses = bus::look_up_all(network.peers);
  facts.peers = peers_of(network.peers, addresses);
  try {
    facts.address = bus::find_reach(network, domain, std::chrono::milliseconds(0), addresses).address;
  } catch (const InputError& error) {
    facts.no_interface = error.what();
  } catch (const std::exception&) {
    // No peer determines the interface: the findings about the peers say why.
  }
  return facts;
}

/// Groups the domains by network, in the order of each group's first domain.
std::vector<DomainNetworkFacts> read_networks(const Visit& visit) {
  std::vector<DomainNetworkFacts> networks;
  for (const std::string& domain : visit.domains) {
    const DomainNetwork& network = visit.network.of(domain);
    const auto known = std::ranges::find(networks, network, &DomainNetworkFacts::network);
    if (known != networks.end()) {
      known->domains.push_back(domain);
    } else {
      networks.push_back(read_network_of(domain, network));
    }
  }
  return networks;
}

void add(Findings& all, Findings some) { std::ranges::move(some, std::back_inserter(all)); }

}  // namespace

Findings examine(const Visit& visit) {
  const FleetNeeds needs{visit.uavs};
  const MachineFacts machine = read_machine();
  const DiskFacts disk = read_disk(visit.results);
  Findings findings = {judge_container(machine)};
  const std::vector<InterfaceFacts> interfaces = read_interfaces();
  add(findings, judge_interfaces(interfaces, bus::multicast_on_loopback()));
  bool host_only = true;
  for (const DomainNetworkFacts& network : read_networks(visit)) {
    host_only = host_only && network.network.host_only();
    add(findings, judge_network(network, interfaces));
  }
  add(findings,
      judge_ports(read_ports(), {.base = visit.base,
                                 .size = static_cast<int>(needs.domains()),
                                 .participants = host_only ? bus::kMaxLocalParticipants : bus::kMaxPeerParticipants}));
  add(findings,
      {judge_open_files(machine, needs), judge_processes(machine, needs), judge_buffers(machine),
       judge_memory(machine, needs), judge_cpus(machine), judge_disk(disk), judge_shared_memory(read_shared_memory())});
  add(findings, judge_clocks(read_clocks()));
  add(findings, judge_variables(read_variables()));
  findings.push_back(judge_docker(ask_docker()));
  return findings;
}

std::vector<PeerFacts> peers_of(const std::vector<std::string>& names, const bus::Addresses& addresses) {
  std::vector<PeerFacts> peers;
  for (const std::string& name : names) {
    PeerFacts& peer = peers.emplace_back(PeerFacts{.name = name});
    const auto address = addresses.find(name);
    if (address == addresses.end()) continue;
    peer.address = address_text(address->second);
    if (const auto source = bus::source_towards(address->second)) peer.source = address_text(*source);
  }
  return peers;
}

}  // namespace skein::doctor
