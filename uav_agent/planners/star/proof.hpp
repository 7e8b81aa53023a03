// How much proof of free space a UAV of STAR asks for: less and less, for a while, when it cannot get anywhere.
// Threads: one.
#pragma once

#include <algorithm>
#include <array>

#include "core/types.hpp"

namespace skein::agent {

class StarProof {
 public:
  /// Rays that must have passed an unknown place.
  /// @param roomy  the site has a box that is too large to be one piece of structure.
  int rays(bool roomy) const { return (roomy ? kRoomyRays : kRays)[boldness_]; }
  void ask_less(Tick now) {
    boldness_ = std::min(boldness_ + 1, kRays.size() - 1);
    bold_until_ = now + ticks(kBoldS);
  }
  /// All of it again, when the while is over.
  void settle(Tick now) {
    if (now >= bold_until_) boldness_ = 0;
  }

 private:
  static constexpr std::array kRays = {8, 6, 4};
  static constexpr std::array kRoomyRays = {16, 12, 8};
  static constexpr double kBoldS = 40.0;  ///< the while, since the last time it asked for less

  std::size_t boldness_ = 0;
  Tick bold_until_ = 0;
};

}  // namespace skein::agent
