// The listening socket for browsers, on the loopback address unless the user asks for another one. The launcher opens
// it before the flight, so a taken port is reported as bad input. The program that serves the page uses the same
// socket: the station (also a restarted one) inherits it while the fleet flies, and the launcher serves afterwards. A
// browser that connects in between waits. In a container there is no launcher: the station opens its own socket.
#pragma once

#include <cstdint>

#include "view/endpoint.hpp"

namespace skein::view {

class Listener {
 public:
  /// @throws InputError when the endpoint is taken or unavailable.
  explicit Listener(const Endpoint& endpoint);
  /// Listens on the loopback address. @param port  0: any free port.
  explicit Listener(std::uint16_t port) : Listener(Endpoint{.port = port}) {}
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int fd() const { return fd_; }
  /// The socket's endpoint, with its actual port.
  Endpoint endpoint() const;
  std::uint16_t port() const { return endpoint().port; }

 private:
  int fd_ = -1;
};

/// Endpoint of a listening TCP socket. @throws InputError when `fd` is not one.
Endpoint endpoint_of(int fd);

/// Resolves NAME:PORT, where NAME is one of this host's own names: in a container the name selects one of its networks.
/// @throws InputError when the name cannot be resolved.
Endpoint resolved(const std::string& text);

}  // namespace skein::view
