// A TCP port of 127.0.0.1 for a test, so that test programs that run at the same time never take the same one.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "process/host/host_lock.hpp"

namespace skein::test {

/// A port on which no program listens at construction, and which no other test takes while this lives.
class FreePort {
 public:
  FreePort() {
    constexpr int kFirst = 20'000, kCount = 10'000;  // below the ephemeral ports
    for (int i = 0; i < kCount; ++i) {
      number_ = kFirst + static_cast<int>((::getpid() * 7L + i) % kCount);
      lock_ = HostLock::try_take("skein-test-port-" + std::to_string(number_));
      if (lock_ && is_free(number_)) return;
    }
    throw std::runtime_error("no TCP port is free");
  }

  std::string text() const { return std::to_string(number_); }

 private:
  static bool is_free(int port) {
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool bound = ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(fd);
    return bound;
  }

  int number_ = 0;
  std::optional<HostLock> lock_;
};

}  // namespace skein::test
