// The socket that browsers connect to: on the loopback, unless somebody asks for more. The launcher opens it before
// anything flies, so that a port that is taken is bad input, and whoever serves a run's page inherits it: the station
// while the fleet flies, one that was started again, and the launcher afterwards. Who connects in between waits. In a
// container there is no launcher: the station opens its own.
#pragma once

#include <cstdint>

#include "view/endpoint.hpp"

namespace skein::view {

class Listener {
 public:
  /// @throws InputError when it is taken or not to be had.
  explicit Listener(const Endpoint& endpoint);
  /// On the loopback. @param port  0: any that is free.
  explicit Listener(std::uint16_t port) : Listener(Endpoint{.port = port}) {}
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int fd() const { return fd_; }
  /// With the port that it has.
  Endpoint endpoint() const;
  std::uint16_t port() const { return endpoint().port; }

 private:
  int fd_ = -1;
};

/// Of a socket that listens. @throws InputError when it is none.
Endpoint endpoint_of(int fd);

/// NAME:PORT, where a name is one of this host's own: in a container it tells which of its networks is meant.
/// @throws InputError when there is no such name.
Endpoint resolved(const std::string& text);

}  // namespace skein::view
