// Why a point scored less than it could: the causes of losses.csv, in the order in which people are told of them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace skein::results {

struct Cause {
  std::string_view key;    ///< in losses.csv and result.json
  std::string_view title;  ///< for people
};

inline constexpr std::array<Cause, 9> kCauses = {{{"out_of_reach", "no UAV fits there"},
                                                  {"never_in_picture", "never in the picture"},
                                                  {"below_threshold", "too poor to count"},
                                                  {"voided", "UAV collided"},
                                                  {"not_delivered", "not delivered"},
                                                  {"distance", "from too far away"},
                                                  {"tilt", "too much from the side"},
                                                  {"blur", "blurred"},
                                                  {"above_estimate", "above the estimate"}}};

/// @returns its place in kCauses; nullopt for "none" and what is no cause.
constexpr std::optional<std::size_t> cause_of(std::string_view key) {
  for (std::size_t i = 0; i < kCauses.size(); ++i) {
    if (kCauses[i].key == key) return i;
  }
  return std::nullopt;
}

}  // namespace skein::results
