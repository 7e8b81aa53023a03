// In C, since ddsi_domaingv.h is no C++.
#pragma once

#include <dds/ddsi/ddsi_tran.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ddsi_domaingv;
struct ddsi_tran_conn;

/// The sockets through which a domain of Cyclone DDS sends; `count` of them.
struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count);

/// From here on `judge` tells which addresses the domain reaches, and by which of its interfaces.
void skein_cyclone_judge_addresses(struct ddsi_domaingv* domain, ddsi_is_nearby_address_fn_t judge);

#ifdef __cplusplus
}
#endif
