#include "view/packed.hpp"

#include <zlib.h>

#include <new>
#include <span>
#include <vector>

#include "core/text/base64.hpp"

namespace skein::view {

std::string packed(std::string_view text) {
  uLongf size = ::compressBound(text.size());
  std::vector<std::uint8_t> bytes(size);
  const auto* from = reinterpret_cast<const Bytef*>(text.data());
  if (::compress2(bytes.data(), &size, from, text.size(), Z_BEST_COMPRESSION) != Z_OK) throw std::bad_alloc();
  return base64(std::span(bytes).first(size));
}

}  // namespace skein::view
