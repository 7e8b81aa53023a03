// The hash FNV-1a with 32 bits, of bytes or of larger numbers. Different contents may have the same hash.
// Pure; threads: any.
#pragma once

#include <cstdint>

namespace skein::agent {

class FnvHash {
 public:
  void add(std::uint32_t value) { hash_ = (hash_ ^ value) * 16777619U; }  // format: FNV's prime
  std::uint32_t value() const { return hash_; }
  /// The hash, folded to 16 bits.
  std::uint16_t folded() const { return static_cast<std::uint16_t>(hash_ ^ hash_ >> 16); }

 private:
  std::uint32_t hash_ = 2166136261U;  ///< format: FNV's offset basis
};

}  // namespace skein::agent
