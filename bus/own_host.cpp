#include "bus/own_host.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <memory>

namespace skein::bus {

namespace {

/// The first interface with an IPv4 address that fits.
template <class Fits>
std::optional<std::string> find_address(Fits fits) {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> addresses(first, &::freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in own;
    std::memcpy(&own, entry->ifa_addr, sizeof own);
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &own.sin_addr, text.data(), text.size());
    if (fits(std::string(entry->ifa_name), own.sin_addr)) return std::string(text.data());
  }
  return std::nullopt;
}

}  // namespace

bool is_own_address(std::span<const std::uint8_t, 4> ipv4) {
  if (ipv4[0] == 127) return true;
  return find_address(
             [&](const std::string&, const in_addr& own) { return std::memcmp(&own, ipv4.data(), ipv4.size()) == 0; })
      .has_value();
}

std::optional<std::string> address_of(const std::string& interface) {
  return find_address([&](const std::string& name, const in_addr&) { return name == interface; });
}

bool multicast_on_loopback() {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  ip_mreq group{};
  group.imr_multiaddr.s_addr = ::inet_addr("239.255.0.1");  // the one that RTPS discovers by
  group.imr_interface.s_addr = htonl(INADDR_LOOPBACK);
  const bool joined = ::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) == 0 &&
                      ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &group.imr_interface, sizeof(in_addr)) == 0;
  ::close(fd);
  return joined;
}

}  // namespace skein::bus
