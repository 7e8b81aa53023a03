// Adds columns to messages that name only a line. Programs write capsules (docs/how-to-hunt.md) in long lines with
// many keys, so a line alone does not show the place.   Pure.
#pragma once

#include <string>

#include "core/config/config_node.hpp"

namespace skein::cli {

/// "FILE:LINE: KEY: WHAT" becomes "FILE:LINE:COLUMN: KEY: WHAT", line by line: where the key stands, or the first
/// letter of the line, if it does not stand there. Other lines do not change.
std::string with_columns(const std::string& said, const ConfigDocument& document);

}  // namespace skein::cli
