// The UDP socket for greetings: which address a datagram came to, and what the kernel heard of those that did not
// arrive.   Linux. One thread.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace skein::doctor {

class GreetingSocket {
 public:
  /// Of RTPS's discovery; on a port of our own.
  static constexpr const char* kGroup = "239.255.0.1";

  /// @throws InputError when somebody has the port.
  GreetingSocket();
  ~GreetingSocket();
  GreetingSocket(const GreetingSocket&) = delete;
  GreetingSocket& operator=(const GreetingSocket&) = delete;

  /// Also hears what is sent to the group on the interface with this address.
  void join_group(const std::string& address);
  /// In one packet or not at all. @param from  own address; empty: as routes lead. @returns why it was not sent, or
  /// nothing.
  std::string send(const std::string& from, const std::string& to, std::span<const std::uint8_t> bytes);

  using OnDatagram =
      std::function<void(std::span<const std::uint8_t> bytes, const std::string& from, const std::string& at)>;
  using OnRefused = std::function<void(const std::string& to, const std::string& why)>;
  /// Takes all that has arrived, and all refusals.
  void take(const OnDatagram& on_datagram, const OnRefused& on_refused);

 private:
  int fd_ = -1;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace skein::doctor
