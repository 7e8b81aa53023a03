// What a fault test expects of a run beside its properties: how it ended, its digest, the counters of its radio, and
// that its faults began. docs/how-to-test-faults.md lists the keys. Pure, but for the runs' digests.csv.
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

constexpr auto radio_counters() {
  return std::array{"sent",       "delivered", "dropped_no_los", "dropped_fault",  "dropped_overflow",
                    "duplicated", "corrupted", "sent_bytes",     "delivered_bytes"};
}

/// Whether a fleet in one process cannot fly this way.
constexpr bool needs_dds(Repeat repeat) {
  return repeat == Repeat::cyclonedds || repeat == Repeat::fastdds || repeat == Repeat::mixed;
}

/// A file's `expect`, with what a test expects where its file does not say.
struct Expectations {
  std::string status = "completed";
  std::optional<Limits> exit_code = Limits{0.0, 0.0};
  bool deterministic = true, faults_acted = true;
  LimitsByName<radio_counters> radio;
  std::vector<Repeat> same_digest;

  void describe(auto& r) {
    r.field("status", status);
    read_limits(r, "exit_code", exit_code);
    r.field("deterministic", deterministic);
    r.field("faults_acted", faults_acted);
    r.field("radio", radio);
    r.field("same_digest", same_digest);
  }
};

/// The runs that are judged.
struct Evidence {
  const FaultPlan& plan;
  const results::RunRecord& run;
  int exit_code = 0;                                                       ///< of `skein run`
  std::vector<std::pair<std::string, const results::RunRecord*>> repeats;  ///< how each was flown, and its record
};

/// The outcome of an expectation, or of a part of it.
struct Judgement {
  std::string path;  ///< of its key in the file: "expect.radio.sent"
  bool holds = true;
  std::string text;  ///< "expected ..., seen ...", with the simulated time at which it failed if that is known
};

std::vector<Judgement> judged(const Expectations& expectations, const Evidence& evidence);

}  // namespace skein::cli
