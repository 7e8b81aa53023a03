#include "bus/fastdds/settings.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <memory>

#include "bus/fastdds/security.hpp"
#include "bus/fastdds/transports.hpp"
#include "bus/own_host.hpp"
#include "bus/wire.hpp"

namespace skein::bus::fastdds {

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::uint32_t kSocketBufferBytes = 4 * 1024 * 1024;
constexpr int kAllocatedSamples = 16;  // initially; Fast DDS allocates more when it needs them

Locator_t locator_of(const std::string& ipv4, std::uint32_t port) {
  Locator_t locator;
  IPLocator::setIPv4(locator, ipv4);
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = port;
  return locator;
}

Duration_t milliseconds(std::uint32_t ms) { return {static_cast<std::int32_t>(ms / 1000), ms % 1000 * 1'000'000}; }

/// Configures discovery without multicast: the ports on which a participant listens, and the peers to which it
/// announces itself. The ports are explicit, because Fast DDS would otherwise derive them from the number of
/// participants that this process has ever created in any domain. These ports would soon be outside the range to which
/// peers announce themselves. If a port is in use, Fast DDS tries the following ones. Since discovery has a unicast
/// locator but no multicast locator, Fast DDS uses no multicast.
/// @param max_participants  number of participants per host that can be discovered.
void discover_by_unicast(DomainParticipantQos& qos, int domain, const std::string& own_address,
                         const std::vector<std::string>& peers, int max_participants) {
  auto& wire = qos.wire_protocol();
  const auto domain_id = static_cast<std::uint32_t>(domain);
  const std::uint32_t first_port = wire.port.getUnicastPort(domain_id, 0);
  for (const std::string& peer : peers) {
    wire.builtin.initialPeersList.push_back(locator_of(peer, 0));  // port 0: the RTPS ports of this domain
  }
  wire.builtin.metatrafficUnicastLocatorList.push_back(locator_of(own_address, first_port));
  wire.default_unicast_locator_list.push_back(
      locator_of(own_address, first_port + wire.port.offsetd3 - wire.port.offsetd1));
  wire.builtin.mutation_tries = static_cast<std::uint32_t>(max_participants - 1);
}

}  // namespace

DomainParticipantQos participant_qos(int domain, const BusConfig& config, const Reach& reach) {
  DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
  const bool meets_default = meets_default_nodes(config, reach);

  // UDP only: a process that is killed would leave its shared-memory segments behind.
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = udp->receiveBufferSize = kSocketBufferBytes;
  const std::string address = reach.host_only ? kLoopback : reach.address;
  if (!address.empty()) udp->interfaceWhiteList.push_back(address);
  if (reach.host_only) {
    udp->maxInitialPeersRange = kMaxLocalParticipants;
    discover_by_unicast(qos, domain, address, {kLoopback}, kMaxLocalParticipants);
    if (meets_default && multicast_on_loopback()) {
      auto& wire = qos.wire_protocol();
      const Locator_t group = locator_of("239.255.0.1", wire.port.getMulticastPort(static_cast<std::uint32_t>(domain)));
      wire.builtin.metatrafficMulticastLocatorList.push_back(group);
      wire.builtin.initialPeersList.push_back(group);
    }
  } else {
    udp->maxInitialPeersRange = kMaxPeerParticipants;
    if (reach.by_peers()) discover_by_unicast(qos, domain, address, reach.peers, kMaxPeerParticipants);
  }
  qos.transport().use_builtin_transports = false;
  auto& transports = qos.transport().user_transports;
  if (meets_default) {
    transports.push_back(own_host_transport(udp));
  } else if (reach.host_only) {
    transports.push_back(udp);
  } else {
    // In a secured fleet, datagrams may be larger than a network packet: handshake messages contain a certificate and
    // permissions, and Fast DDS does not fragment these messages.
    transports.push_back(config.security.empty() ? packet_transport(udp, reach.largest_datagram) : udp);
  }

  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = {config.lease_s, 0};
  discovery.leaseDuration_announcementperiod = {announce_period_s(config.lease_s), 0};
  // The first announcements follow each other quickly, because other programs may be starting at the same time.
  discovery.initial_announcements.count = 10;
  discovery.initial_announcements.period = milliseconds(20);
  if (!config.security.empty()) {
    qos.properties() = security_properties(config.security);
    log_refusals();
  }
  return qos;
}

DataWriterQos writer_qos(const Qos& qos, bool one_host) {
  DataWriterQos dds = DATAWRITER_QOS_DEFAULT;
  dds.reliability().kind = qos.reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  dds.reliability().max_blocking_time = milliseconds(10);
  dds.durability().kind = qos.latched ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  dds.history().kind = KEEP_LAST_HISTORY_QOS;
  dds.history().depth = qos.depth;
  dds.resource_limits().max_instances = 1;
  dds.resource_limits().max_samples = dds.resource_limits().max_samples_per_instance = qos.depth;
  dds.resource_limits().allocated_samples = std::min(qos.depth, kAllocatedSamples);
  dds.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  dds.data_sharing().off();
  dds.publish_mode().kind = SYNCHRONOUS_PUBLISH_MODE;
  // A reader notices a lost sample when the next heartbeat arrives, so the default period of 3 s would stall a
  // lock-step round for up to 3 s. If all programs are on one host, 200 ms is short enough: there, samples are lost
  // only when a buffer overflows, and a heartbeat and its answer cost two datagrams. Latched topics always need the
  // short period, because a reader that joins late receives the latched sample only after a heartbeat.
  dds.reliable_writer_qos().times.heartbeatPeriod = milliseconds(one_host && !qos.latched ? 200 : 20);
  dds.reliable_writer_qos().times.nackResponseDelay = milliseconds(1);
  // No reader monitors liveliness. But with this kind, FastWriter (fastdds_bus.cpp) can assert liveliness at any time,
  // which makes Fast DDS send a heartbeat.
  dds.liveliness().kind = MANUAL_BY_TOPIC_LIVELINESS_QOS;
  return dds;
}

DataReaderQos reader_qos(const Qos& qos) {
  DataReaderQos dds = DATAREADER_QOS_DEFAULT;
  dds.reliability().kind = qos.reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  dds.durability().kind = qos.latched ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  // The listener takes each sample when it arrives, so the history contains only samples that wait for an earlier one
  // that was lost. A limit of `depth` would apply to all writers together: samples of one could evict those of another.
  dds.history().kind = KEEP_ALL_HISTORY_QOS;
  dds.resource_limits().max_instances = 1;
  dds.resource_limits().max_samples = dds.resource_limits().max_samples_per_instance = LENGTH_UNLIMITED;
  dds.resource_limits().allocated_samples = std::min(qos.depth, kAllocatedSamples);
  dds.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  dds.data_sharing().off();
  dds.reliable_reader_qos().times.initialAcknackDelay = milliseconds(10);
  dds.reliable_reader_qos().times.heartbeatResponseDelay = milliseconds(1);
  return dds;
}

}  // namespace skein::bus::fastdds
