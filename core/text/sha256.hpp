// SHA-256 over named little-endian fields: the digest of a run, and the key of every random stream.
// Numbers are hashed by their bits (doubles: IEEE 754), so -0.0 and 0.0 give different digests, as do different NaNs. A
// text is hashed with its length, so that ("ab", "c") and ("a", "bc") give different digests.
// One thread at a time; copying copies the state.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/types.hpp"

struct evp_md_ctx_st;

namespace skein {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256& other);
  Sha256& operator=(const Sha256& other);
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  /// Eight bytes of any integer or bool; signed ones in two's complement.
  template <class Integer>
  requires std::is_integral_v<Integer> Sha256& add(Integer value) {
    return add_word(static_cast<std::uint64_t>(value));
  }
  template <class Tag>
  Sha256& add(Id<Tag> id) {
    return add(static_cast<std::size_t>(id));
  }
  /// Accepts doubles only, no types that convert to double.
  Sha256& add(std::same_as<double> auto value) { return add_double(value); }
  Sha256& add(const Vector3d& value);     ///< x, y, z
  Sha256& add(const Quaterniond& value);  ///< w, x, y, z; q and -q give different digests
  /// The length, then the bytes.
  Sha256& add(std::string_view text);
  Sha256& add(const std::string& text) { return add(std::string_view(text)); }
  Sha256& add(const char* text) { return add(std::string_view(text)); }
  /// The bytes alone.
  Sha256& add(std::span<const std::uint8_t> bytes);

  /// Digest of everything added so far; more may be added afterwards.
  std::array<std::uint8_t, 32> digest() const;
  /// The same as 64 lower-case hexadecimal digits.
  std::string hex() const;

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };

  Sha256& add_word(std::uint64_t value);
  Sha256& add_double(double value);
  void update(const void* data, std::size_t size);

  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// Lower-case hexadecimal digits of some bytes.
std::string to_hex(std::span<const std::uint8_t> bytes);

}  // namespace skein
