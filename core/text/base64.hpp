// Bytes as text of letters, digits, + and / (RFC 4648).   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// With padding, in one line.
std::string base64(std::span<const std::uint8_t> bytes);
/// @returns nullopt when `text` is none, with its padding and without line breaks.
std::optional<std::vector<std::uint8_t>> read_base64(std::string_view text);

}  // namespace skein
