// Where a page is served: an address of this host and a port. On the loopback, unless somebody asks for more.
// Pure but for names_of(), which asks the system; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace skein::view {

struct Endpoint {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6, in numbers
  std::uint16_t port = 0;             ///< 0: any that is free

  bool is_loopback() const;    ///< only programs of this host reach it
  bool is_any() const;         ///< all addresses of this host: 0.0.0.0 or ::
  std::string text() const;    ///< as an address of the web has it: "127.0.0.1:8080", "[::1]:8080"
  Endpoint from_here() const;  ///< where a browser of this host finds it
  bool operator==(const Endpoint&) const = default;
};

/// Of [ADDRESS:]PORT: "8080", "0.0.0.0:8080", "[::1]:8080", "localhost:8080".
/// @throws InputError that says what would be right
Endpoint read_endpoint(std::string_view text);

/// By which names browsers elsewhere may ask for what is served there: that address; of all addresses those of this
/// host's interfaces, and its name.
std::vector<std::string> names_of(const Endpoint& endpoint);

/// The two parts of what a browser calls a host, "localhost:8080": without brackets, in small letters. An empty name
/// means that it is none. Without a port it is the web's, 80.
struct HostName {
  std::string name;
  std::uint16_t port = 0;
};
HostName read_host(std::string_view text);

}  // namespace skein::view
