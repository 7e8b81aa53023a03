// Compresses the flight of a self-contained page (pages.hpp), as text.   Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace skein::view {

/// @returns a zlib stream (RFC 1950) in base64; web/src/kept.js reads it. @throws std::bad_alloc
std::string packed(std::string_view text);

}  // namespace skein::view
