// Raw bytes to and from a TCP server on this host, for tests of requests that a browser does not make.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace skein::test {

/// A TCP connection. If it cannot be established, it counts as closed and receives nothing.
class Wire {
 public:
  explicit Wire(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_open_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Wire() { ::close(fd_); }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  int fd() const { return fd_; }
  void send(const std::string& bytes) const { ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }
  /// Reads until the server closes the connection. @returns all bytes received so far
  std::string all() {
    return until([](const std::string&) { return false; });
  }
  /// Reads until `enough` of all bytes received so far, or until the server closes. @returns these bytes
  std::string until(const auto& enough) {
    while (!enough(heard_) && read()) continue;
    return heard_;
  }
  const std::string& heard() const { return heard_; }
  /// Waits for more. @returns false when the server has closed the connection.
  bool read() {
    char buffer[4096];
    const ssize_t size = is_open_ ? ::recv(fd_, buffer, sizeof buffer, 0) : 0;
    if (size > 0) heard_.append(buffer, static_cast<std::size_t>(size));
    return size > 0;
  }
  /// Whether the server has closed the connection; reads the pending bytes without waiting.
  bool is_closed() {
    while (is_open_) {
      pollfd one{fd_, POLLIN, 0};
      if (::poll(&one, 1, 0) == 0) return false;
      if (!read()) return true;
    }
    return true;
  }

 private:
  int fd_;
  bool is_open_ = false;
  std::string heard_;
};

/// Payloads of a WebSocket server's frames, concatenated.
class Unframed {
 public:
  /// @param heard  all bytes received since the start, including the response to the request
  const std::string& after(const std::string& heard) {
    if (at_ == 0) {
      const std::size_t end = heard.find("\r\n\r\n");
      if (end == std::string::npos) return text_;
      at_ = end + 4;
    }
    while (heard.size() >= at_ + 2) {
      std::size_t size = heard[at_ + 1] & 0x7f;
      const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0, begin = at_ + 2 + more;
      if (heard.size() < begin) break;
      if (more > 0) size = 0;
      for (std::size_t i = at_ + 2; i < begin; ++i) size = size << 8 | static_cast<unsigned char>(heard[i]);
      if (heard.size() < begin + size) break;
      text_.append(heard, begin, size);
      at_ = begin + size;
    }
    return text_;
  }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

/// A masked WebSocket frame, as a browser sends it. @param first  its first byte: 0x81 is a text
inline std::string frame(const std::string& payload, unsigned char first = 0x81) {
  std::string bytes{static_cast<char>(first)};
  if (payload.size() < 126) {
    bytes += static_cast<char>(0x80 | payload.size());
  } else {
    const bool is_long = payload.size() > 0xffff;
    bytes += static_cast<char>(0x80 | (is_long ? 127 : 126));
    for (int shift = is_long ? 56 : 8; shift >= 0; shift -= 8) {
      bytes += static_cast<char>(payload.size() >> shift & 0xff);
    }
  }
  return bytes + std::string(4, '\0') + payload;
}

/// The header lines that ask a server for a WebSocket.
inline const char* const kUpgrade =
    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

}  // namespace skein::test
