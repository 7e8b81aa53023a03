#include "view/endpoint.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "process/host/host_name.hpp"

namespace skein::view {
namespace {

constexpr std::uint16_t kHttpPort = 80;

/// The address in the form in which inet_ntop() and browsers write it; empty if it is not an address of this family.
std::string canonical(int family, const std::string& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  in6_addr bytes{};  // large enough for IPv4, too
  if (::inet_pton(family, address.c_str(), &bytes) != 1) return {};
  ::inet_ntop(family, &bytes, text.data(), text.size());
  return text.data();
}

/// Splits a text at its last colon into address and port. An IPv6 address must be in brackets. The address is empty if
/// it is invalid.
std::pair<std::string, std::string_view> split_endpoint(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::string name(text.substr(0, colon));
  const std::string_view port = text.substr(colon + 1);
  if (name == "localhost") return {"127.0.0.1", port};
  if (name.starts_with('[') && name.ends_with(']')) {
    return {canonical(AF_INET6, name.substr(1, name.size() - 2)), port};
  }
  return {canonical(AF_INET, name), port};
}

std::string lower_case(std::string_view text) {
  std::string letters(text);
  std::ranges::transform(letters, letters.begin(),
                         [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return letters;
}

std::vector<std::string> interface_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return addresses;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    const int family = one->ifa_addr->sa_family;
    if (family != AF_INET && family != AF_INET6) continue;
    std::array<char, NI_MAXHOST> text{};
    const socklen_t size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
    if (::getnameinfo(one->ifa_addr, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0) continue;
    const std::string address = text.data();
    if (address.find('%') == std::string::npos) addresses.push_back(address);  // browsers accept no scope ("%eth0")
  }
  ::freeifaddrs(all);
  return addresses;
}

}  // namespace

bool Endpoint::is_loopback() const { return address.starts_with("127.") || address == "::1"; }

bool Endpoint::is_any() const { return address == "0.0.0.0" || address == "::"; }

std::string Endpoint::text() const {
  const bool brackets = address.find(':') != std::string::npos;
  return (brackets ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

Endpoint Endpoint::from_here() const {
  if (address == "0.0.0.0") return {"127.0.0.1", port};
  if (address == "::") return {"::1", port};
  return *this;
}

Endpoint read_endpoint(std::string_view text) {
  Endpoint endpoint;
  std::string_view port_text = text;
  if (text.find(':') != std::string_view::npos) {
    std::tie(endpoint.address, port_text) = split_endpoint(text);
  }
  const std::optional<std::uint16_t> port = parse_whole<std::uint16_t>(port_text);
  if (!port || endpoint.address.empty()) {
    throw InputError(std::string(text) +
                     ": must be a port (0 to 65535), or an address of this host and a port, such as 8080, "
                     "0.0.0.0:8080, 192.0.2.7:8080 or [::1]:8080");
  }
  endpoint.port = *port;
  return endpoint;
}

std::vector<std::string> names_of(const Endpoint& endpoint) {
  if (!endpoint.is_any()) return {endpoint.address};
  std::vector<std::string> names = interface_addresses();
  if (const std::string name = lower_case(host_name()); !name.empty()) {
    names.push_back(name);
    const std::string first = name.substr(0, name.find('.'));
    if (first != name) names.push_back(first);
  }
  return names;
}

HostName read_host(std::string_view text) {
  std::string_view name = text, port;
  const std::size_t colon = text.rfind(':');
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return {};
    name = text.substr(1, end - 1);
    port = text.substr(end + 1);
    if (name.find(':') == std::string_view::npos) return {};
  } else if (colon != std::string_view::npos) {
    name = text.substr(0, colon);
    port = text.substr(colon);
    if (name.find(':') != std::string_view::npos) return {};
  }
  if (port.empty()) return {lower_case(name), kHttpPort};
  const std::optional<std::uint16_t> number =
      port.starts_with(':') ? parse_whole<std::uint16_t>(port.substr(1)) : std::nullopt;
  return number && *number != 0 ? HostName{lower_case(name), *number} : HostName{};
}

}  // namespace skein::view
