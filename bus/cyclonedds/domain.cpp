#include "bus/cyclonedds/domain.hpp"

#include <map>
#include <mutex>
#include <stdexcept>

#include "bus/cyclonedds/own_host.hpp"
#include "bus/cyclonedds/security.hpp"
#include "bus/own_host.hpp"
#include "bus/wire.hpp"

namespace skein::bus::cyclonedds {

namespace {

/// Cyclone keeps its domains for the whole process and refuses to create one twice: hence the static register. Its
/// lock is held while a domain is taken down, so that nobody joins the remains.
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

}  // namespace

std::string domain_configuration(const BusConfig& config) {
  const std::string last_index = std::to_string(kMaxLocalParticipants - 1);
  // Loopback: no need of multicast, since participants take fixed ports and announce themselves to all of these; but
  // nodes with default settings are found by it. Datagrams as large as UDP has them; fragments fill one, or else a 4 MB
  // sample is thousands of them.
  const bool multicast = meets_default_nodes(config) && multicast_on_loopback();
  const std::string network =
      config.loopback_only
          ? std::string("<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"") +
                (multicast ? "true" : "false") + "\"/></Interfaces><AllowMulticast>" + (multicast ? "spdp" : "false") +
                "</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize><FragmentSize>60000B</FragmentSize></General>"
      : config.interface.empty()
          ? ""
          : "<General><Interfaces><NetworkInterface name=\"" + config.interface + "\"/></Interfaces></General>";
  const std::string peers = config.loopback_only
                                ? "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" + last_index +
                                      "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers>"
                                : "";
  // Watermarks: a writer waits once its unacknowledged bytes exceed WhcHigh. History is KEEP_LAST and bounds them
  // already, so the mark is put out of reach and a stopped reader holds nobody up.
  return "<CycloneDDS xmlns=\"https://cdds.io/config\"><Domain Id=\"any\">" + network + "<Discovery>" + peers +
         "<SPDPInterval>" + std::to_string(announce_period_s(config.lease_s)) + "s</SPDPInterval><LeaseDuration>" +
         std::to_string(config.lease_s) +
         "s</LeaseDuration></Discovery>"
         "<Internal><Watermarks><WhcHigh>2000MB</WhcHigh><WhcHighInit>2000MB</WhcHighInit>"
         "<WhcAdaptive>false</WhcAdaptive></Watermarks>"
         "<HeartbeatInterval min=\"5ms\" minsched=\"10ms\" max=\"8s\">50ms</HeartbeatInterval>"
         "<NackDelay>5ms</NackDelay><GenerateKeyhash>true</GenerateKeyhash>"
         "<WriterLingerDuration>50ms</WriterLingerDuration>"
         "<SocketReceiveBufferSize min=\"default\" max=\"4MB\"/></Internal>" +
         security_configuration(config.security) + "</Domain></CycloneDDS>";
}

dds_return_t check(dds_return_t result, const std::string& what) {
  if (result < 0) throw std::runtime_error("Cyclone DDS: " + what + ": " + dds_strretcode(result));
  return result;
}

Domain::Domain(int id, const BusConfig& config) : id_(id) {
  if (!config.security.empty()) log_refusals();
  Register& known = domain_register();
  const std::scoped_lock lock(known.mutex);
  Register::Entry& entry = known.domains[id];
  if (entry.members == 0)
    entry.entity = check(dds_create_domain(static_cast<dds_domainid_t>(id), domain_configuration(config).c_str()),
                         "cannot create domain " + std::to_string(id));
  if (entry.members == 0 && meets_default_nodes(config)) await_own_host(entry.entity);
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
