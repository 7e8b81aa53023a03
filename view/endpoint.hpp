// Where a page is served: an address of this host and a port; by default on the loopback address.
// Pure except for names_of(), which asks the operating system; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace skein::view {

struct Endpoint {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6, numeric
  std::uint16_t port = 0;             ///< 0: any free port

  bool is_loopback() const;    ///< whether only programs on this host reach it
  bool is_any() const;         ///< whether it is all addresses of this host: 0.0.0.0 or ::
  std::string text() const;    ///< as in a URL: "127.0.0.1:8080", "[::1]:8080"
  Endpoint from_here() const;  ///< the endpoint at which a browser on this host reaches it
  bool operator==(const Endpoint&) const = default;
};

/// Reads [ADDRESS:]PORT: "8080", "0.0.0.0:8080", "[::1]:8080", "localhost:8080".
/// @throws InputError whose message says what is allowed
Endpoint read_endpoint(std::string_view text);

/// Host names that browsers may use for this endpoint: its address. If it is all addresses of this host, then those of
/// the host's interfaces and the host's name, also without its domain.
std::vector<std::string> names_of(const Endpoint& endpoint);

/// The two parts of a Host header such as "localhost:8080": the name in lower case, without the brackets of IPv6, and
/// the port, 80 if there is none. An empty name means that the text is invalid.
struct HostName {
  std::string name;
  std::uint16_t port = 0;
};
HostName read_host(std::string_view text);

}  // namespace skein::view
