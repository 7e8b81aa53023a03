// Why a point scored less than it could: the causes of losses.csv.   Pure; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/types.hpp"

namespace skein::results {

/// In the order of tables and reports.
enum class LossCause {
  none,              ///< nothing is lost
  out_of_reach,      ///< a camera could photograph it, but no UAV fits there
  never_in_picture,  ///< no camera ever had it both in its picture and in sight
  below_threshold,   ///< cameras had it in picture and in sight, but always with too low a quality to count
  voided,            ///< its best picture is void, because the UAV collided
  not_delivered,     ///< its best picture did not reach the station
  distance,          ///< its best picture counts; the worst part of its quality is the distance
  tilt,              ///< the same; the worst part is the angle to the surface
  blur,              ///< the same; the worst part is the motion blur
  drift,             ///< it would have a better picture if the UAV had been where it believed to be
  wind,              ///< it would have a better picture without wind
  energy,            ///< a UAV's empty battery cost its best picture; or none counts, and batteries kept all UAVs down
  above_estimate,    ///< it scored better than the estimate: the loss is negative
};

struct Cause {
  const char* key;    ///< in losses.csv and result.json
  const char* title;  ///< for people
};

/// All of LossCause except `none`, in the same order.
inline constexpr std::array<Cause, 12> kCauses = {{{"out_of_reach", "no UAV fits there"},
                                                   {"never_in_picture", "never in the picture"},
                                                   {"below_threshold", "too poor to count"},
                                                   {"voided", "UAV collided"},
                                                   {"not_delivered", "not delivered"},
                                                   {"distance", "from too far away"},
                                                   {"tilt", "too much from the side"},
                                                   {"blur", "blurred"},
                                                   {"drift", "position was off"},
                                                   {"wind", "pushed by wind"},
                                                   {"energy", "battery empty"},
                                                   {"above_estimate", "above the estimate"}}};

constexpr std::array<EnumName<LossCause>, kCauses.size() + 1> enum_names(LossCause) {
  std::array<EnumName<LossCause>, kCauses.size() + 1> names{{{"none", LossCause::none}}};
  for (std::size_t i = 0; i < kCauses.size(); ++i) names[i + 1] = {kCauses[i].key, static_cast<LossCause>(i + 1)};
  return names;
}
static_assert(enum_names(LossCause{}).back().value == LossCause::above_estimate);

/// @returns the index of a key in kCauses; nullopt for "none" and unknown keys.
constexpr std::optional<std::size_t> cause_of(std::string_view key) {
  for (std::size_t i = 0; i < kCauses.size(); ++i) {
    if (kCauses[i].key == key) return i;
  }
  return std::nullopt;
}

/// The parts of a picture's quality by which `below_threshold` is split, in the order of tables. The keys of all but
/// the last are those of LossCauses. The last is for points of which the run has not recorded the parts.
inline constexpr std::array<Cause, 4> kPoorParts = {kCauses[*cause_of("distance")], kCauses[*cause_of("tilt")],
                                                    kCauses[*cause_of("blur")], Cause{"unsplit", "part not known"}};

}  // namespace skein::results
