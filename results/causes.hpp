// Why a point scored less than it could: the causes of losses.csv.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/types.hpp"

namespace skein::results {

/// In the order in which people are told of them.
enum class LossCause {
  none,              ///< nothing is lost
  out_of_reach,      ///< a camera alone could get there, a whole UAV cannot
  never_in_picture,  ///< no camera ever had it in the picture and in sight
  below_threshold,   ///< some had, but not well enough to count
  voided,            ///< the best picture was of a UAV that collided
  not_delivered,     ///< the best picture never came to the station
  distance,          ///< the best picture counts; it was taken from too far away,
  tilt,              ///< too much from the side,
  blur,              ///< or in too much motion, whichever is worst
  above_estimate,    ///< it scored better than the estimate: the loss is negative
};

struct Cause {
  const char* key;    ///< in losses.csv and result.json
  const char* title;  ///< for people
};

/// Those of LossCause but `none`, in its order.
inline constexpr std::array<Cause, 9> kCauses = {{{"out_of_reach", "no UAV fits there"},
                                                  {"never_in_picture", "never in the picture"},
                                                  {"below_threshold", "too poor to count"},
                                                  {"voided", "UAV collided"},
                                                  {"not_delivered", "not delivered"},
                                                  {"distance", "from too far away"},
                                                  {"tilt", "too much from the side"},
                                                  {"blur", "blurred"},
                                                  {"above_estimate", "above the estimate"}}};

constexpr std::array<EnumName<LossCause>, kCauses.size() + 1> enum_names(LossCause) {
  std::array<EnumName<LossCause>, kCauses.size() + 1> names{{{"none", LossCause::none}}};
  for (std::size_t i = 0; i < kCauses.size(); ++i) names[i + 1] = {kCauses[i].key, static_cast<LossCause>(i + 1)};
  return names;
}
static_assert(enum_names(LossCause{}).back().value == LossCause::above_estimate);

/// @returns its place in kCauses; nullopt for "none" and what is no cause.
constexpr std::optional<std::size_t> cause_of(std::string_view key) {
  for (std::size_t i = 0; i < kCauses.size(); ++i) {
    if (kCauses[i].key == key) return i;
  }
  return std::nullopt;
}

}  // namespace skein::results
