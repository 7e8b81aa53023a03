#include "bus/own_host.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace skein::bus {

std::vector<OwnInterface> own_interfaces() {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> addresses(first, &::freeifaddrs);
  std::vector<OwnInterface> own;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address;
    std::memcpy(&address, entry->ifa_addr, sizeof address);
    own.push_back({entry->ifa_name, address.sin_addr});
  }
  return own;
}

bool is_own_address(std::span<const std::uint8_t, 4> ipv4) {
  if (ipv4[0] == 127) return true;
  return std::ranges::any_of(own_interfaces(), [&](const OwnInterface& own) {
    return std::memcmp(&own.address, ipv4.data(), ipv4.size()) == 0;
  });
}

bool multicast_on_loopback() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  ip_mreq group{};
  group.imr_multiaddr.s_addr = ::inet_addr("239.255.0.1");  // RTPS's group for discovery
  group.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
  const bool joined = ::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0 &&
                      ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &group.imr_interface, sizeof(in_addr)) == 0;
  ::close(fd);
  return joined;
}

}  // namespace skein::bus
