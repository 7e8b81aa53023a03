// An IPv4 address as text.   Threads: any.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>

#include <array>
#include <string>

namespace skein {

/// "10.77.0.1"
inline std::string address_text(const in_addr& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address, text.data(), text.size());
  return text.data();
}

}  // namespace skein
