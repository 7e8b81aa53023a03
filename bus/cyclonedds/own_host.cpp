#include "bus/cyclonedds/own_host.hpp"

// Before all other headers of Cyclone: see raw_sertype.hpp.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <arpa/inet.h>
#include <dds/ddsi/ddsi_locator.h>
#include <dds/ddsi/ddsi_tran.h>

#include <system_error>

#include "bus/cyclonedds/sockets.h"
#include "bus/own_host.hpp"

namespace skein::bus::cyclonedds {

namespace {

constexpr std::size_t kIpv4At = 12;  // offset in a locator's 16 bytes

/// Replaces Cyclone's own decision, which uses the netmasks of the domain's interfaces: here only the loopback's.
ddsi_nearby_address_result is_nearby(const ddsi_locator_t* locator, std::size_t, const nn_interface*,
                                     std::size_t* interface) {
  if (locator->kind != NN_LOCATOR_KIND_UDPv4 ||
      !is_own_address(std::span<const std::uint8_t, 4>(locator->address + kIpv4At, 4)))
    return DNAR_DISTANT;
  if (interface != nullptr) *interface = 0;
  return DNAR_LOCAL;
}

/// Cyclone's internal object of a domain; can be reached only through a type that is registered in the domain.
ddsi_domaingv* inside_of(dds_entity_t participant) {
  ddsi_sertype* type = make_raw_sertype("skein");
  const dds_entity_t topic = dds_create_topic_sertype(participant, "skein", &type, nullptr, nullptr, nullptr);
  if (topic < 0) ddsi_sertype_unref(type);
  check(topic, "cannot look into a domain");
  auto* const domain = static_cast<ddsi_domaingv*>(ddsrt_atomic_ldvoidp(&type->gv));
  dds_delete(topic);
  return domain;
}

void open(dds_entity_t domain) {
  check(dds_domain_set_deafmute(domain, false, false, DDS_INFINITY), "cannot open a domain");
}

}  // namespace

void await_own_host(dds_entity_t domain) {
  check(dds_domain_set_deafmute(domain, true, true, DDS_INFINITY), "cannot silence a domain");
}

void reach_own_host(dds_entity_t domain, dds_entity_t participant) {
  skein_cyclone_judge_addresses(inside_of(participant), is_nearby);
  open(domain);
}

void hear_own_address(dds_entity_t domain, dds_entity_t participant, const std::string& ipv4) {
  in_addr address{};
  ::inet_pton(AF_INET, ipv4.c_str(), &address);
  if (const int reason = skein_cyclone_take_only(inside_of(participant), address.s_addr); reason != 0) {
    throw std::system_error(reason, std::generic_category(), "Cyclone DDS: cannot keep other networks out");
  }
  open(domain);
}

}  // namespace skein::bus::cyclonedds
