// What a vendor has to say in a secured fleet: its refusals of strangers reach the program's own log.
#pragma once

#include <string>
#include <string_view>

namespace skein::bus {

/// Warns of it in the program's log, once for each text; after some dozens of texts that is all, so that nobody fills
/// a disk by knocking at the door. Any thread.
void log_refusal(std::string_view vendor, std::string_view text);

}  // namespace skein::bus
