#include "process/host/host_lock.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace skein {
namespace {

struct Address {
  sockaddr_un name{};
  socklen_t size = 0;
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&name); }
};

/// The address of an abstract socket: its name begins with a zero byte, and it is not a file.
Address abstract_address(const std::string& name) {
  Address address;
  address.name.sun_family = AF_UNIX;
  if (name.size() + 1 > sizeof address.name.sun_path) throw std::invalid_argument("too long for a lock: " + name);
  std::copy(name.begin(), name.end(), address.name.sun_path + 1);
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

int open_socket() {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), "socket");
  return fd;
}

}  // namespace

std::optional<HostLock> HostLock::try_take(const std::string& name) {
  const Address address = abstract_address(name);
  HostLock lock(open_socket());
  if (::bind(lock.fd_, address.get(), address.size) != 0) {
    if (errno == EADDRINUSE) return std::nullopt;
    throw std::system_error(errno, std::generic_category(), "lock " + name);
  }
  // From here on the lock is held. The socket listens only so that holder() can connect and get the process id. Until
  // it listens, or when its queue is full of connections that nothing has accepted, holder() gets none, which only
  // leaves the id out of a message.
  if (::listen(lock.fd_, SOMAXCONN) != 0) throw std::system_error(errno, std::generic_category(), "lock " + name);
  return lock;
}

std::optional<pid_t> HostLock::holder(const std::string& name) {
  const Address address = abstract_address(name);
  const HostLock visitor(open_socket());
  ucred credentials{};
  socklen_t size = sizeof credentials;
  const bool known = ::connect(visitor.fd_, address.get(), address.size) == 0 &&
                     ::getsockopt(visitor.fd_, SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0 &&
                     credentials.pid > 0;
  return known ? std::optional(credentials.pid) : std::nullopt;
}

void HostLock::forget_visitors() const {
  for (int visitor = 0; (visitor = ::accept4(fd_, nullptr, nullptr, SOCK_CLOEXEC)) >= 0;) ::close(visitor);
}

HostLock::HostLock(HostLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

HostLock& HostLock::operator=(HostLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

HostLock::~HostLock() {
  if (fd_ >= 0) ::close(fd_);
}

std::string domain_lock_name(int domain) { return "skein-domain-" + std::to_string(domain); }

}  // namespace skein
