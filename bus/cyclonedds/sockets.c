#include "bus/cyclonedds/sockets.h"

#include <dds/ddsi/ddsi_domaingv.h>

struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count) {
  *count = (size_t)domain->n_interfaces;
  return domain->xmit_conns;
}

void skein_cyclone_judge_addresses(struct ddsi_domaingv* domain, ddsi_is_nearby_address_fn_t judge) {
  __atomic_store_n(&domain->m_factory->m_is_nearby_address_fn, judge, __ATOMIC_RELEASE);
}
