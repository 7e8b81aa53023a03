// What became of the expectations of a fault test: each judge looks at one run and says what it saw. Pure, but for the
// runs' digests.csv.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/fault_tests/limits.hpp"
#include "core/faults/fault_plan.hpp"
#include "results/run_record.hpp"

namespace skein::cli {

/// One more run of the same test, which must have the same digest.
enum class Repeat { again, cyclonedds, fastdds, mixed, chaos, one_process };
constexpr std::array<EnumName<Repeat>, 6> enum_names(Repeat) {
  return {{{"again", Repeat::again},
           {"cyclonedds", Repeat::cyclonedds},
           {"fastdds", Repeat::fastdds},
           {"mixed", Repeat::mixed},
           {"chaos", Repeat::chaos},
           {"one_process", Repeat::one_process}}};
}

/// What a judge looks at.
struct Evidence {
  const Scenario& scenario;
  const FaultPlan& plan;
  const results::RunRecord& run;
  int exit_code = 0;                                                       ///< of `skein run`
  const results::RunRecord* fault_free = nullptr;                          ///< where an expectation asks for it
  std::vector<std::pair<std::string, const results::RunRecord*>> repeats;  ///< how they were flown, and what came of it

  double end_s() const { return value_or(run.result, "sim_time_s", 0.0); }
};

/// What a judge says of an expectation, or of a part of it.
struct Finding {
  bool holds = true;
  std::string text;  ///< "expected ..., seen ..."
  std::optional<double> at_s =
      {};                 ///< simulated time at which it was clear that it does not hold, unless `text` has it
  std::string part = {};  ///< which part, as a path below the key: "[0].uavs.changi"
};
using Findings = std::vector<Finding>;

/// "expected ..., seen ...".
Finding finding(bool holds, const std::string& expected, const std::string& seen, std::optional<double> at_s = {});
/// Of a number that is known at the end of what is looked at.
Finding finding(const Limits& wanted, double seen, double end_s, const std::string& of = "");

constexpr auto radio_counters() {
  return std::array{"sent",       "delivered", "dropped_no_los", "dropped_fault",  "dropped_overflow",
                    "duplicated", "corrupted", "sent_bytes",     "delivered_bytes"};
}
using RadioLimits = LimitsByName<radio_counters>;

constexpr auto uav_numbers() {
  return std::array{"captures", "distance_m", "max_speed_mps", "idle_s", "commands_rejected"};
}
using UavLimits = Named<LimitsByName<uav_numbers>>;

/// Somebody else does the work that a UAV had before it when it failed.
struct TakenOver {
  std::string uav;
  double within_s = 30.0;
  int points = 1;

  template <class R>
  void describe(R& r) {
    r.required("uav", uav);
    r.field("within_s", within_s, Bounds{0.0, 36000.0, true});
    r.field("points", points, at_least(1));
  }
};

enum class Custody { none, kept, exact };
constexpr std::array<EnumName<Custody>, 3> enum_names(Custody) {
  return {{{"none", Custody::none}, {"kept", Custody::kept}, {"exact", Custody::exact}}};
}

/// A plan whose faults began when they did in a run: those that waited for a condition, too.
FaultPlan as_flown(FaultPlan plan, const Json& result, const Scenario& scenario);
/// The first fault that concerns a UAV alone. In a plan as it was flown; else those that wait come last.
const Fault* first_fault_of(const std::string& uav, const FaultPlan& plan);

/// @param key  of result.json
Findings judge_text(const char* key, const std::string& wanted, const Evidence& evidence);
/// @param path  the same, as a JSON pointer
Findings judge_number(const char* path, const Limits& wanted, const Evidence& evidence);
Findings judge_vs_fault_free(const char* key, const Limits& wanted, const Evidence& evidence);
Findings judge_vs_earned(const Limits& wanted, const Evidence& evidence);
Findings judge_exit_code(const Limits& wanted, const Evidence& evidence);
Findings judge_deterministic(bool wanted, const Evidence& evidence);
Findings judge_faults_acted(bool wanted, const Evidence& evidence);
Findings judge_collisions(const Limits& wanted, const Evidence& evidence);
/// @param event  "left" or "joined", after the first step
Findings judge_members(const char* event, const std::vector<std::string>& wanted, const Evidence& evidence);
Findings judge_radio(const RadioLimits& wanted, const Evidence& evidence);
Findings judge_uavs(const UavLimits& wanted, const Evidence& evidence);
Findings judge_taken_over(const TakenOver& wanted, const Evidence& evidence);
Findings judge_custody(Custody wanted, const Evidence& evidence);
Findings judge_same_digest(const std::vector<Repeat>& wanted, const Evidence& evidence);

}  // namespace skein::cli
