// A flight for a page that holds it itself: compressed, as text.   Pure; any thread.
#pragma once

#include <string>
#include <string_view>

namespace skein::view {

/// A zlib stream (RFC 1950) in base64; web/src/kept.js reads it.
std::string packed(std::string_view text);

}  // namespace skein::view
