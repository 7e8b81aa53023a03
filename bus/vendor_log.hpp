// In a secured fleet, copies the DDS vendor's messages about rejected participants to the program's own log.
#pragma once

#include <string>
#include <string_view>

namespace skein::bus {

/// Logs a warning, once for each text. After 48 different texts it logs no more, so that attempts to join cannot fill
/// the disk. Any thread.
void log_refusal(std::string_view vendor, std::string_view text);

}  // namespace skein::bus
