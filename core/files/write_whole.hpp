// Writes bytes to a file descriptor, with as many calls of write(2) as necessary. Any thread.
#pragma once

#include <string_view>

namespace skein {

/// Writes all bytes to a blocking descriptor. @returns false if the system refuses some; errno tells why, also when
/// only a part was written (a full disk).
bool write_whole(int fd, std::string_view bytes);

}  // namespace skein
