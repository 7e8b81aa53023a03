// In C, since ddsi_domaingv.h is no C++.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ddsi_domaingv;
struct ddsi_tran_conn;

/// The sockets through which a domain of Cyclone DDS sends; `count` of them.
struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count);

#ifdef __cplusplus
}
#endif
