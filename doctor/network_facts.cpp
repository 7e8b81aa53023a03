#include "doctor/network_facts.hpp"

#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

#include "process/host/host_lock.hpp"
#include "process/program.hpp"

namespace skein::doctor {
namespace {

/// Reads lines such as " 12: 0100007F:1CE8 00000000:0000 07 ...": the second word is address and port, in hexadecimal.
std::set<int> bound_ports() {
  std::set<int> ports;
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream in(table);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string slot, local;
      if (!(words >> slot >> local)) continue;
      int port = 0;
      const std::size_t colon = local.rfind(':');
      if (colon == std::string::npos) continue;
      std::from_chars(local.data() + colon + 1, local.data() + local.size(), port, 16);
      ports.insert(port);
    }
  }
  return ports;
}

/// Names of abstract sockets, which /proc marks with an '@'. A held lock shows up here; trying to take the locks could
/// make a fleet fail that starts at that moment.
std::set<std::string> abstract_sockets() {
  std::set<std::string> names;
  std::ifstream in("/proc/net/unix");
  for (std::string line; std::getline(in, line);) {
    if (const std::size_t at = line.find('@'); at != std::string::npos) names.insert(line.substr(at + 1));
  }
  return names;
}

}  // namespace

void look_at(InterfaceFacts& interface) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return;
  ifreq request{};
  std::strncpy(request.ifr_name, interface.name.c_str(), IFNAMSIZ - 1);
  if (::ioctl(fd, SIOCGIFFLAGS, &request) == 0) {
    interface.up = (request.ifr_flags & IFF_UP) != 0 && (request.ifr_flags & IFF_RUNNING) != 0;
  }
  if (::ioctl(fd, SIOCGIFMTU, &request) == 0) interface.mtu = static_cast<std::size_t>(request.ifr_mtu);
  ::close(fd);
}

PortFacts read_ports() {
  PortFacts facts;
  facts.taken = bound_ports();
  std::ifstream("/proc/sys/net/ipv4/ip_local_port_range") >> facts.first_ephemeral;
  const std::set<std::string> sockets = abstract_sockets();
  for (int domain = kFirstDomain; domain <= kLastDomain; ++domain) {
    const std::string lock = domain_lock_name(domain);
    if (sockets.contains(lock)) facts.held[domain] = HostLock::holder(lock);
  }
  return facts;
}

DomainPorts ports_of(int domain, int participants) {
  const int first = 7400 + 250 * domain;
  return {first, first + 11 + 2 * (participants - 1)};
}

}  // namespace skein::doctor
