// Access to the sockets of a Cyclone DDS domain. In C, because ddsi_domaingv.h does not compile as C++.
#pragma once

#include <dds/ddsi/ddsi_tran.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ddsi_domaingv;
struct ddsi_tran_conn;

/// The sockets through which a domain of Cyclone DDS sends. Sets `count` to their number.
struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count);

/// From now on, `judge` decides which addresses the domain can reach, and by which of its interfaces.
void skein_cyclone_judge_addresses(struct ddsi_domaingv* domain, ddsi_is_nearby_address_fn_t judge);

/// From now on, the domain's unicast sockets receive only packets to this IPv4 address (network byte order) or to
/// loopback addresses. Without this filter they receive packets from all of the host's networks, because Cyclone binds
/// them to no address. @returns 0, or errno
int skein_cyclone_take_only(const struct ddsi_domaingv* domain, uint32_t ipv4);

#ifdef __cplusplus
}
#endif
