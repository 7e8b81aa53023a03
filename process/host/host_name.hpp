// The name of this host.   Threads: any.
#pragma once

#include <unistd.h>

#include <array>
#include <string>

namespace skein {

/// The name that gethostname() returns. @param unknown  the result if it returns none.
inline std::string host_name(const char* unknown = "") {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : unknown;
}

}  // namespace skein
