// Writes bytes to a file descriptor, as many write(2) calls as that takes. Any thread.
#pragma once

#include <string_view>

namespace skein {

/// Writes all bytes to a descriptor that blocks. @returns false if the system refuses some; errno tells why, also when
/// only a part was written (a full disk).
bool write_whole(int fd, std::string_view bytes);

}  // namespace skein
