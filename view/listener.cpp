#include "view/listener.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/types.hpp"

namespace skein::view {
namespace {

constexpr int kWaiting = 128;

/// An endpoint as the operating system represents it.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  sockaddr_in& v4() { return reinterpret_cast<sockaddr_in&>(storage); }
  sockaddr_in6& v6() { return reinterpret_cast<sockaddr_in6&>(storage); }
};

SocketAddress address_of(const Endpoint& endpoint) {
  SocketAddress address;
  if (::inet_pton(AF_INET, endpoint.address.c_str(), &address.v4().sin_addr) == 1) {
    address.v4().sin_family = AF_INET;
    address.v4().sin_port = htons(endpoint.port);
    address.size = sizeof(sockaddr_in);
  } else {
    ::inet_pton(AF_INET6, endpoint.address.c_str(), &address.v6().sin6_addr);
    address.v6().sin6_family = AF_INET6;
    address.v6().sin6_port = htons(endpoint.port);
    address.size = sizeof(sockaddr_in6);
  }
  return address;
}

Endpoint endpoint_of(SocketAddress& address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool is_v4 = address.storage.ss_family == AF_INET;
  const void* const bytes = is_v4 ? static_cast<void*>(&address.v4().sin_addr) : &address.v6().sin6_addr;
  ::inet_ntop(address.storage.ss_family, bytes, text.data(), text.size());
  return {text.data(), ntohs(is_v4 ? address.v4().sin_port : address.v6().sin6_port)};
}

}  // namespace

Listener::Listener(const Endpoint& endpoint) {
  SocketAddress address = address_of(endpoint);
  fd_ = ::socket(address.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;  // connections of a former page on this port may linger
  if (fd_ >= 0 && ::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
      ::bind(fd_, address.get(), address.size) == 0 && ::listen(fd_, kWaiting) == 0) {
    return;
  }
  const int reason = errno;
  if (fd_ >= 0) ::close(fd_);
  throw InputError("--view " + endpoint.text() + ": no page can be served there (" + std::strerror(reason) + "); " +
                   (reason == EADDRNOTAVAIL || reason == EAFNOSUPPORT
                        ? "choose an address of this host"
                        : "choose another port, or 0 for one that is free"));
}

Listener::~Listener() { ::close(fd_); }

Endpoint Listener::endpoint() const { return endpoint_of(fd_); }

Endpoint endpoint_of(int fd) {
  SocketAddress address;
  int listens = 0;
  socklen_t listens_size = sizeof listens;
  const bool there = ::getsockname(fd, address.get(), &address.size) == 0 &&
                     (address.storage.ss_family == AF_INET || address.storage.ss_family == AF_INET6) &&
                     ::getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &listens_size) == 0 && listens == 1;
  if (!there) throw InputError("--view-fd " + std::to_string(fd) + ": is not a socket that listens to browsers");
  return endpoint_of(address);
}

Endpoint resolved(const std::string& text) {
  const HostName host = read_host(text);
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (host.name.empty() || ::getaddrinfo(host.name.c_str(), nullptr, &hints, &found) != 0) {
    throw InputError("--view-listen " + text + ": there is no such host");
  }
  SocketAddress address;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  ::freeaddrinfo(found);
  Endpoint endpoint = endpoint_of(address);
  endpoint.port = host.port;
  return endpoint;
}

}  // namespace skein::view
