#include "one_process/session_socket.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace skein::one_process {
namespace {

constexpr std::size_t kMaxBytes = 4096, kMaxDescriptors = 4;  // of a message

}  // namespace

std::optional<SessionMessage> SessionSocket::receive() const {
  std::array<char, kMaxBytes> text{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMaxDescriptors * sizeof(int))> control{};
  iovec part{text.data(), text.size()};
  msghdr head{};
  head.msg_iov = &part;
  head.msg_iovlen = 1;
  head.msg_control = control.data();
  head.msg_controllen = control.size();
  ssize_t size = 0;
  do {
    size = ::recvmsg(descriptor_, &head, MSG_CMSG_CLOEXEC);
  } while (size < 0 && errno == EINTR);
  if (size <= 0) return std::nullopt;
  SessionMessage message{{text.data(), static_cast<std::size_t>(size)}, {}};
  for (cmsghdr* cmsg = CMSG_FIRSTHDR(&head); cmsg != nullptr; cmsg = CMSG_NXTHDR(&head, cmsg)) {
    if (cmsg->cmsg_level != SOL_SOCKET || cmsg->cmsg_type != SCM_RIGHTS) continue;
    message.files.resize((cmsg->cmsg_len - CMSG_LEN(0)) / sizeof(int));
    std::memcpy(message.files.data(), CMSG_DATA(cmsg), message.files.size() * sizeof(int));
  }
  if ((head.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0) {  // the kernel has dropped the rest
    for (const int file : message.files) ::close(file);
    throw std::length_error("a message of this session is too long: it must have at most " + std::to_string(kMaxBytes) +
                            " bytes and " + std::to_string(kMaxDescriptors) + " descriptors");
  }
  return message;
}

void SessionSocket::send(std::string_view text) const {
  while (::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

void SessionSocket::become(int descriptor) const {
  ::dup3(descriptor, descriptor_, O_CLOEXEC);
  ::close(descriptor);
}

}  // namespace skein::one_process
