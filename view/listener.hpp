// The socket that browsers connect to: on the loopback, and nowhere else. The launcher opens it before anything flies,
// so that a port that is taken is bad input, and whoever serves a run's page inherits it: the station while the fleet
// flies, one that was started again, and the launcher afterwards. Who connects in between waits.
#pragma once

#include <cstdint>
#include <string>

namespace skein::view {

class Listener {
 public:
  /// @param port  0: any that is free. @throws InputError when it is taken or not to be had.
  explicit Listener(std::uint16_t port);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  int fd() const { return fd_; }
  std::uint16_t port() const;

 private:
  int fd_ = -1;
};

/// Of a listening socket on the loopback. @throws InputError when it is none.
std::uint16_t port_of(int fd);

}  // namespace skein::view
