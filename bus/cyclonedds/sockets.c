#include "bus/cyclonedds/sockets.h"

#include <arpa/inet.h>
#include <dds/ddsi/ddsi_domaingv.h>
#include <errno.h>
#include <linux/filter.h>
#include <sys/socket.h>

struct ddsi_tran_conn* const* skein_cyclone_sockets(const struct ddsi_domaingv* domain, size_t* count) {
  *count = (size_t)domain->n_interfaces;
  return domain->xmit_conns;
}

void skein_cyclone_judge_addresses(struct ddsi_domaingv* domain, ddsi_is_nearby_address_fn_t judge) {
  __atomic_store_n(&domain->m_factory->m_is_nearby_address_fn, judge, __ATOMIC_RELEASE);
}

int skein_cyclone_take_only(const struct ddsi_domaingv* domain, uint32_t ipv4) {
  enum { kDestination = 16, kLoopback = 127 };
  struct sock_filter steps[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)SKF_NET_OFF + kDestination),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ntohl(ipv4), 2, 0),
      BPF_STMT(BPF_ALU | BPF_RSH | BPF_K, 24),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kLoopback, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, UINT32_MAX),
      BPF_STMT(BPF_RET | BPF_K, 0),
  };
  const struct sock_fprog filter = {.len = sizeof steps / sizeof steps[0], .filter = steps};
  struct ddsi_tran_conn* const sockets[] = {domain->disc_conn_uc, domain->data_conn_uc};
  for (size_t i = 0; i < sizeof sockets / sizeof sockets[0]; ++i) {
    if (sockets[i] == NULL) continue;
    const int fd = (int)ddsi_conn_handle(sockets[i]);
    if (setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) != 0) return errno;
  }
  return 0;
}
