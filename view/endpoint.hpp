// The endpoint at which this host serves a page: one of its addresses, by default the loopback address, and a port.
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

  bool is_loopback() const;  ///< whether only programs on this host can reach the endpoint
  bool is_any() const;       ///< whether the address stands for all addresses of this host: 0.0.0.0 or ::
  std::string text() const;  ///< as in a URL: "127.0.0.1:8080", "[::1]:8080"
  /// The endpoint that a browser on this host opens: this one, but with the loopback address if is_any().
  Endpoint from_here() const;
  bool operator==(const Endpoint&) const = default;
};

/// Reads [ADDRESS:]PORT: "8080", "0.0.0.0:8080", "[::1]:8080", "localhost:8080". Without ADDRESS: on 127.0.0.1.
/// @throws InputError for any other text; its message says what is allowed.
Endpoint read_endpoint(std::string_view text);

/// The names by which browsers may address this endpoint in URLs, besides localhost (door.hpp). If the endpoint has a
/// single address: this address. If it stands for all addresses: the addresses of the host's network interfaces, the
/// host's name, and the host's name without its domain.
std::vector<std::string> names_of(const Endpoint& endpoint);

/// The two parts of a Host header such as "localhost:8080": the name in lower case, without the brackets of IPv6, and
/// the port, 80 if there is none. An empty name means that the text is invalid.
struct HostName {
  std::string name;
  std::uint16_t port = 0;
};
HostName read_host(std::string_view text);

}  // namespace skein::view
