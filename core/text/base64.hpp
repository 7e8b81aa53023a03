// Bytes as text of letters, digits, + and / (RFC 4648).   Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// Encodes bytes, with padding and without line breaks.
std::string base64(std::span<const std::uint8_t> bytes);
/// Decodes a text. @returns nullopt unless `text` is valid Base64 with padding and without line breaks.
std::optional<std::vector<std::uint8_t>> read_base64(std::string_view text);

}  // namespace skein
