#include "page_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>
#include <regex>
#include <stdexcept>

#include "child_process.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/wire.hpp"

namespace skein::test {

PageClient::PageClient(const std::filesystem::path& door) {
  const std::string text = text_of(door);
  std::smatch found;
  if (!std::regex_search(text, found, std::regex("127\\.0\\.0\\.1:(\\d+)/enter.*value=\"([0-9a-f]+)\""))) {
    throw std::runtime_error(door.string() + ": is not a door");
  }
  port_ = static_cast<std::uint16_t>(std::stoul(found[1]));
  key_ = found[2];
  open();
}

PageClient::~PageClient() { close(); }

void PageClient::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

/// Connects and sends the request. While no station runs, the connection waits to be accepted.
void PageClient::open() {
  close();
  heard_.clear();
  lines_.clear();
  fd_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval limit{kPatience.count(), 0};
  ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port_);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  over_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0;
  if (over_) return;
  const std::string host = "127.0.0.1:" + std::to_string(port_);
  const std::string request = "GET /flight HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                              "\r\nCookie: skein_" + std::to_string(port_) + "=" + key_ +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  ::send(fd_, request.data(), request.size(), MSG_NOSIGNAL);
  std::size_t end = std::string::npos;
  while ((end = heard_.find("\r\n\r\n")) == std::string::npos) {
    if (!read_more()) return;
  }
  heard_.erase(0, end + 4);
}

bool PageClient::read_more() {
  char buffer[1 << 16];
  const ssize_t size = ::recv(fd_, buffer, sizeof buffer, 0);
  if (size > 0) heard_.append(buffer, static_cast<std::size_t>(size));
  return size > 0;
}

/// Processes one frame; a message has one or several. @returns false when the bytes so far hold no whole frame.
bool PageClient::take_frame() {
  const auto byte = [this](std::size_t at) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(heard_[at]));
  };
  if (heard_.size() < 2) return false;
  const std::uint64_t code = byte(0) & 0x0f, small = byte(1) & 0x7f;
  const std::size_t header = small < 126 ? 2 : small == 126 ? 4 : 10;
  if (heard_.size() < header) return false;
  std::uint64_t size = header == 2 ? small : 0;
  for (std::size_t i = 2; i < header; ++i) size = size << 8 | byte(i);
  if (heard_.size() < header + size) return false;
  const bool whole = (byte(0) & 0x80) != 0;
  if (code == 1) message_.clear();
  if (code <= 1) message_ += heard_.substr(header, size);
  heard_.erase(0, header + size);
  if (code > 1 || !whole) return true;
  const Json message = Json::parse(message_);
  if (message.contains("scene")) over_ = message["scene"].value("mode", "") == "replay";
  if (message.contains("state")) state_ = message["state"];
  for (const Json& line : message.value("lines", Json::array())) lines_.push_back(line);
  return true;
}

void PageClient::ask(const Json& order) {
  const std::string bytes = test::frame(order.dump());
  ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

bool PageClient::wait(const std::function<bool()>& holds) {
  while (!over_) {
    while (take_frame()) {
    }
    if (over_) break;
    if (holds()) return true;
    if (!read_more()) open();
  }
  return false;
}

}  // namespace skein::test
