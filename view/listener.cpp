#include "view/listener.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/types.hpp"

namespace skein::view {
namespace {

constexpr int kWaiting = 64;

}  // namespace

Listener::Listener(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int yes = 1;  // connections of a page that was there before may linger
  ::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 && ::listen(fd_, kWaiting) == 0) {
    return;
  }
  const int reason = errno;
  ::close(fd_);
  throw InputError("--view " + std::to_string(port) + ": no page can be served there (" + std::strerror(reason) +
                   "); choose another port, or none for one that is free");
}

Listener::~Listener() { ::close(fd_); }

std::uint16_t Listener::port() const { return port_of(fd_); }

std::uint16_t port_of(int fd) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  int listens = 0;
  socklen_t listens_size = sizeof listens;
  const bool there = ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
                     address.sin_family == AF_INET &&
                     ::getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &listens_size) == 0 && listens == 1;
  if (!there || address.sin_addr.s_addr != htonl(INADDR_LOOPBACK)) {
    throw InputError("--view-fd " + std::to_string(fd) + ": is no socket that listens on the loopback");
  }
  return ntohs(address.sin_port);
}

}  // namespace skein::view
