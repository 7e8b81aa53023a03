// In C, since ddsi_domaingv.h is no C++.
#pragma once

#include <dds/ddsi/ddsi_tran.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ddsi_domaingv;
struct ddsi_tran_conn;

/// The sockets through which a domain of Cyclone DDS sends; `count` of them.
struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count);

/// From here on `judge` tells which addresses the domain reaches, and by which of its interfaces.
void skein_cyclone_judge_addresses(struct ddsi_domaingv* domain, ddsi_is_nearby_address_fn_t judge);

/// From here on the domain's sockets take what was sent to this IPv4 address (as on the wire), or to the loopback
/// interface, and nothing else: they are bound to no address, and any network that the host is in leads to them.
/// @returns 0, or errno
int skein_cyclone_take_only(const struct ddsi_domaingv* domain, uint32_t ipv4);

#ifdef __cplusplus
}
#endif
