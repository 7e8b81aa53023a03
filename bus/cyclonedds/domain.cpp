#include "bus/cyclonedds/domain.hpp"

#include <map>
#include <mutex>
#include <stdexcept>

#include "bus/cyclonedds/own_host.hpp"
#include "bus/cyclonedds/security.hpp"
#include "bus/own_host.hpp"
#include "bus/wire.hpp"
#include "core/text/xml_text.hpp"

namespace skein::bus::cyclonedds {

namespace {

constexpr std::size_t kFragmentHeaders = 128;  // bytes: RTPS message, timestamp, destination, fragment, reserve

/// The domains of this process. Static, because a domain of Cyclone belongs to the whole process and cannot be created
/// twice. The lock is held while a domain is deleted, so that no thread joins it meanwhile.
struct Register {
  struct Entry {
    dds_entity_t entity = 0;
    int members = 0;
  };
  std::mutex mutex;
  std::map<int, Entry> domains;
};

Register& domain_register() {
  static Register domains;
  return domains;
}

/// On loopback, multicast serves only to discover nodes with default settings: Skein's own participants use fixed ports
/// and announce themselves to all of these. Datagrams have UDP's largest size, and a fragment fills one: otherwise, a
/// 4 MB sample would consist of thousands of datagrams.
/// Elsewhere, a datagram fits into a packet: if IP fragmented it, the loss of one fragment would lose it all.
void add_network(pugi::xml_node domain, const Reach& reach, bool with_default_nodes) {
  pugi::xml_node general = domain.append_child("General");
  pugi::xml_node interface;
  if (reach.host_only || !reach.address.empty()) {
    interface = general.append_child("Interfaces").append_child("NetworkInterface");
    if (reach.host_only) {
      interface.append_attribute("name") = "lo";
    } else {
      interface.append_attribute("address") = reach.address.c_str();
    }
  }
  if (reach.host_only || reach.by_peers()) {
    const bool multicast = with_default_nodes && multicast_on_loopback();
    if (interface) interface.append_attribute("multicast") = multicast;
    add_element(general, "AllowMulticast", multicast ? "spdp" : "false");
  }
  const std::size_t largest = reach.largest_datagram;
  const std::size_t fragment = reach.host_only ? 60000 : largest - kFragmentHeaders;
  add_element(general, "MaxMessageSize", std::to_string(largest) + "B");
  add_element(general, "FragmentSize", std::to_string(fragment) + "B");
}

void add_discovery(pugi::xml_node domain, const BusConfig& config, const Reach& reach) {
  pugi::xml_node discovery = domain.append_child("Discovery");
  if (reach.host_only || reach.by_peers()) {
    const int most = reach.host_only ? kMaxLocalParticipants : kMaxPeerParticipants;
    add_element(discovery, "ParticipantIndex", "auto");
    add_element(discovery, "MaxAutoParticipantIndex", std::to_string(most - 1));
    pugi::xml_node peers = discovery.append_child("Peers");
    if (reach.host_only) peers.append_child("Peer").append_attribute("address") = "127.0.0.1";
    for (const std::string& peer : reach.peers) {
      peers.append_child("Peer").append_attribute("address") = peer.c_str();
    }
  }
  add_element(discovery, "SPDPInterval", std::to_string(announce_period_s(config.lease_s)) + "s");
  add_element(discovery, "LeaseDuration", std::to_string(config.lease_s) + "s");
}

/// Watermarks: a writer blocks while its unacknowledged bytes exceed WhcHigh. The KEEP_LAST history bounds these bytes
/// already, so WhcHigh is set out of reach, and a stopped reader blocks no writer.
/// Heartbeats: each requests an answer from all readers. On one host a datagram is lost only when a buffer overflows,
/// so the period is longer: in a fleet of 100 UAVs, whose rounds take about as long as the shorter period, heartbeats
/// and their answers took an eighth of the time (docs/decisions/0044-what-made-it-fast.md).
void add_internals(pugi::xml_node domain, bool one_host) {
  pugi::xml_node internal = domain.append_child("Internal");
  pugi::xml_node watermarks = internal.append_child("Watermarks");
  add_element(watermarks, "WhcHigh", "2000MB");
  add_element(watermarks, "WhcHighInit", "2000MB");
  add_element(watermarks, "WhcAdaptive", "false");
  pugi::xml_node heartbeat = internal.append_child("HeartbeatInterval");
  heartbeat.append_attribute("min") = "5ms";
  heartbeat.append_attribute("minsched") = "10ms";
  heartbeat.append_attribute("max") = "8s";
  heartbeat.text() = one_host ? "200ms" : "50ms";
  add_element(internal, "NackDelay", "5ms");
  add_element(internal, "GenerateKeyhash", "true");
  add_element(internal, "WriterLingerDuration", "50ms");
  pugi::xml_node buffer = internal.append_child("SocketReceiveBufferSize");
  buffer.append_attribute("min") = "default";
  buffer.append_attribute("max") = "4MB";
}

}  // namespace

std::string domain_configuration(const BusConfig& config, const Reach& reach) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("CycloneDDS");
  root.append_attribute("xmlns") = "https://cdds.io/config";
  pugi::xml_node domain = root.append_child("Domain");
  domain.append_attribute("Id") = "any";
  add_network(domain, reach, meets_default_nodes(config, reach));
  add_discovery(domain, config, reach);
  add_internals(domain, reach.host_only);
  if (!config.security.empty()) add_security(domain, config.security);
  return xml_line(document);
}

dds_return_t check(dds_return_t result, const std::string& what) {
  if (result < 0) throw std::runtime_error("Cyclone DDS: " + what + ": " + dds_strretcode(result));
  return result;
}

Domain::Domain(int id, const BusConfig& config, const Reach& reach) : id_(id) {
  if (!config.security.empty()) log_refusals();
  Register& known = domain_register();
  const std::scoped_lock lock(known.mutex);
  Register::Entry& entry = known.domains[id];
  if (entry.members == 0)
    entry.entity =
        check(dds_create_domain(static_cast<dds_domainid_t>(id), domain_configuration(config, reach).c_str()),
              "cannot create domain " + std::to_string(id));
  const bool opens_later = meets_default_nodes(config, reach) || !reach.address.empty();
  if (entry.members == 0 && opens_later) await_own_host(entry.entity);
  entity_ = entry.entity;
  ++entry.members;
}

Domain::~Domain() {
  Register& known = domain_register();
  const std::scoped_lock lock(known.mutex);
  Register::Entry& entry = known.domains[id_];
  if (--entry.members == 0) dds_delete(entry.entity);
}

}  // namespace skein::bus::cyclonedds
