// The UDP socket for greetings. For each received datagram it gives the own address at which it arrived; for datagrams
// that did not arrive, the errors that the kernel has received.   Linux. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace skein::doctor {

class GreetingSocket {
 public:
  /// The multicast group of RTPS discovery; this socket uses it on a port of its own.
  static constexpr const char* kGroup = "239.255.0.1";

  /// @throws InputError when the port is already in use.
  GreetingSocket();
  ~GreetingSocket();
  GreetingSocket(const GreetingSocket&) = delete;
  GreetingSocket& operator=(const GreetingSocket&) = delete;

  /// Also receives datagrams to the group on the interface with this address.
  void join_group(const std::string& address);
  /// Sends the bytes in one packet or not at all. @param from  own address; empty: the kernel's routes decide.
  /// @returns why the datagram was not sent; empty: it was sent.
  std::string send(const std::string& from, const std::string& to, std::span<const std::uint8_t> bytes);

  using OnDatagram =
      std::function<void(std::span<const std::uint8_t> bytes, const std::string& from, const std::string& at)>;
  using OnRefused = std::function<void(const std::string& to, const std::string& why)>;
  /// Passes on all datagrams that have arrived, and all errors of datagrams that did not arrive. Never waits.
  void take(const OnDatagram& on_datagram, const OnRefused& on_refused);

 private:
  int fd_ = -1;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace skein::doctor
