#include "doctor/greeting_socket.hpp"

#include <arpa/inet.h>
#include <linux/errqueue.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "core/types.hpp"
#include "doctor/greeting.hpp"
#include "process/host/address_text.hpp"

namespace skein::doctor {
namespace {

constexpr std::size_t kLargestDatagram = 65536;
constexpr std::size_t kControlBytes = 512;
constexpr int kMostAtOnce = 1000;  ///< datagrams read before the program looks at the time again

in_addr address_of(const std::string& text) {
  in_addr address{};
  if (!text.empty()) ::inet_pton(AF_INET, text.c_str(), &address);
  return address;
}

void set(int fd, int option, int value) { ::setsockopt(fd, IPPROTO_IP, option, &value, sizeof value); }

/// One message with its ancillary data.
struct Message {
  alignas(cmsghdr) std::array<char, kControlBytes> control{};
  sockaddr_in other{};
  iovec part{};
  msghdr header{};

  Message(void* bytes, std::size_t size) : part{bytes, size} {
    header.msg_name = &other;
    header.msg_namelen = sizeof other;
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
  }
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;

  /// Gets the ancillary data of one type. @returns false if there is none.
  bool find(int type, auto& data) {
    for (cmsghdr* part_of = CMSG_FIRSTHDR(&header); part_of != nullptr; part_of = CMSG_NXTHDR(&header, part_of)) {
      if (part_of->cmsg_level != IPPROTO_IP || part_of->cmsg_type != type) continue;
      std::memcpy(&data, CMSG_DATA(part_of), sizeof data);
      return true;
    }
    return false;
  }
};

}  // namespace

GreetingSocket::GreetingSocket()
    : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), buffer_(kLargestDatagram) {
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(kGreetingPort);
  if (fd_ < 0 || ::bind(fd_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) {
    const std::string reason = std::strerror(errno);
    if (fd_ >= 0) ::close(fd_);
    throw InputError("UDP port " + std::to_string(kGreetingPort) + ": " + reason +
                     "; does another `skein doctor net` run on this host? One is enough");
  }
  set(fd_, IP_PKTINFO, 1);
  set(fd_, IP_RECVERR, 1);
  set(fd_, IP_MTU_DISCOVER, IP_PMTUDISC_PROBE);  // never fragment, whatever the known path MTU
  set(fd_, IP_MULTICAST_ALL, 0);
}

GreetingSocket::~GreetingSocket() { ::close(fd_); }

void GreetingSocket::join_group(const std::string& address) {
  ip_mreq group{};
  group.imr_multiaddr = address_of(kGroup);
  group.imr_interface = address_of(address);
  ::setsockopt(fd_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group);  // on failure, no multicast arrives
}

std::string GreetingSocket::send(const std::string& from, const std::string& to, std::span<const std::uint8_t> bytes) {
  const in_addr own = address_of(from);
  if (to == kGroup) ::setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_IF, &own, sizeof own);
  Message message(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
  message.other.sin_family = AF_INET;
  message.other.sin_port = htons(kGreetingPort);
  message.other.sin_addr = address_of(to);
  message.header.msg_controllen = CMSG_SPACE(sizeof(in_pktinfo));
  cmsghdr* info = CMSG_FIRSTHDR(&message.header);
  info->cmsg_level = IPPROTO_IP;
  info->cmsg_type = IP_PKTINFO;
  info->cmsg_len = CMSG_LEN(sizeof(in_pktinfo));
  in_pktinfo source{};
  source.ipi_spec_dst = own;
  std::memcpy(CMSG_DATA(info), &source, sizeof source);
  // The first call may report an error of an earlier datagram instead of sending.
  if (::sendmsg(fd_, &message.header, 0) >= 0 || ::sendmsg(fd_, &message.header, 0) >= 0) return {};
  return std::strerror(errno);
}

void GreetingSocket::take(const OnDatagram& on_datagram, const OnRefused& on_refused) {
  bool more = true;
  for (int turn = 0; more && turn < kMostAtOnce; ++turn) {
    more = false;
    Message arrived(buffer_.data(), buffer_.size());
    const ssize_t size = ::recvmsg(fd_, &arrived.header, 0);
    in_pktinfo info{};
    if (size >= 0) {
      more = true;
      if (arrived.find(IP_PKTINFO, info)) {
        on_datagram({buffer_.data(), static_cast<std::size_t>(size)}, address_text(arrived.other.sin_addr),
                    address_text(info.ipi_spec_dst));
      }
    }
    Message refused(buffer_.data(), buffer_.size());
    sock_extended_err error{};
    if (::recvmsg(fd_, &refused.header, MSG_ERRQUEUE) >= 0) {
      more = true;
      if (refused.find(IP_RECVERR, error)) {
        on_refused(address_text(refused.other.sin_addr), std::strerror(static_cast<int>(error.ee_errno)));
      }
    }
  }
}

}  // namespace skein::doctor
