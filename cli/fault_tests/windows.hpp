// What may be expected of a part of a run: how far a UAV flew in it, what it photographed, what reached the station.
#pragma once

#include "cli/fault_tests/judges.hpp"

namespace skein::cli {

/// Of all UAVs together; `score` is what the delivered score gained.
constexpr auto window_numbers() {
  return std::array{"distance_m", "captures", "delivered", "acknowledged", "lost", "late", "score"};
}
constexpr auto window_uav_numbers() {
  return std::array{"distance_m", "captures", "delivered", "acknowledged", "lost", "late"};
}

/// One entry of `during`.
struct Window {
  double after_s = 0.0;
  std::optional<double> until_s;  ///< none: to the end of the run
  LimitsByName<window_numbers> all;
  Named<LimitsByName<window_uav_numbers>> uavs;

  template <class R>
  void describe(R& r) {
    r.field("after_s", after_s, Bounds{0.0, 36000.0, false});
    r.field("until_s", until_s, Bounds{0.0, 36000.0, true});
    all.describe(r);
    r.field("uavs", uavs);
    r.check(!until_s || *until_s > after_s, "until_s", "must be later than after_s");
    r.check(!all.limits.empty() || !uavs.empty(), "after_s", "nothing is expected of this time");
  }
};

Findings judge_during(const std::vector<Window>& windows, const Evidence& evidence);

}  // namespace skein::cli
