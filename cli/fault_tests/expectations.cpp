#include "cli/fault_tests/expectations.hpp"

#include <algorithm>

#include "cli/fault_tests/windows.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "results/run_folder.hpp"
#include "results/run_tables.hpp"

namespace skein::cli {
namespace {

// ---- checks of files --------------------------------------------------------------------------------------------

void check_known(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                 const std::string& what, const ExpectationContext& context) {
  const bool found = std::find(known.begin(), known.end(), name) != known.end();
  context.errors.check(found, "expect." + key, "there is no " + what + " '" + name + "'; " + suggestion(name, known));
}

void check_members(const std::string& key, const std::vector<std::string>& names, const ExpectationContext& context) {
  std::vector<std::string> known = context.scenario.uav_names();
  known.insert(known.end(), {context.scenario.node_name(kStationNode), programs::kStation, programs::kCommRouter});
  for (const std::string& name : names) check_known(name, known, key, "program", context);
}

void check_uavs(const std::string& key, const UavLimits& uavs, const ExpectationContext& context) {
  for (const auto& [name, limits] : uavs) check_known(name, context.scenario.uav_names(), key, "UAV", context);
}

void check_during(const std::string& key, const std::vector<Window>& windows, const ExpectationContext& context) {
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const std::string path = key + "[" + std::to_string(i) + "]";
    // The clock before take-off counts in times, so a run is longer than its mission; but nobody waits for minutes.
    context.errors.check(windows[i].after_s < context.scenario.duration_s, "expect." + path + ".after_s",
                         "is after the end: the mission lasts " + number_text(context.scenario.duration_s) + " s");
    for (const auto& [name, limits] : windows[i].uavs) {
      check_known(name, context.scenario.uav_names(), path + ".uavs." + name, "UAV", context);
    }
  }
}

void check_taken_over(const std::string& key, const TakenOver& wanted, const ExpectationContext& context) {
  check_known(wanted.uav, context.scenario.uav_names(), key + ".uav", "UAV", context);
  context.errors.check(first_fault_of(wanted.uav, context.plan) != nullptr, "expect." + key + ".uav",
                       "no fault of this file befalls '" + wanted.uav + "', so it has nothing to hand over");
}

// ---- the table --------------------------------------------------------------------------------------------------

template <class T>
using Judge = std::function<Findings(const T&, const Evidence&)>;
template <class T>
using Check = std::function<void(const std::string& key, const T&, const ExpectationContext&)>;

enum class Needs { nothing, fault_free };

template <class T>
void read_wanted(ConfigReader& r, const std::string& key, std::optional<T>& wanted) {
  if constexpr (std::is_same_v<T, Limits>) {
    read_limits(r, key, wanted);
  } else {
    r.field(key, wanted);
  }
}

/// What holds where a file says nothing, spelled as in a file.
template <class T>
struct Usual {
  std::optional<T> value;

  template <class R>
  void describe(R& r) {
    read_wanted(r, "usual", value);
  }
};

template <class T>
ExpectationKind kind(const std::string& key, const std::string& meaning, const std::string& usual, Judge<T> judge,
                     Needs needs = Needs::nothing, Check<T> check = {}) {
  return {key, meaning, usual, [=](ConfigReader& r) -> std::optional<Expectation> {
            std::optional<T> wanted;
            if (!usual.empty()) wanted = read_config<Usual<T>>(parse_config_document("usual: " + usual, key)).value;
            read_wanted(r, key, wanted);
            if (!wanted) return std::nullopt;
            Expectation expectation{key, needs == Needs::fault_free, {}, {}, {}};
            if constexpr (std::is_same_v<T, std::vector<Repeat>>) expectation.repeats = *wanted;
            if (check) expectation.check = [=](const ExpectationContext& context) { check(key, *wanted, context); };
            expectation.judge = [=](const Evidence& evidence) { return judge(*wanted, evidence); };
            return expectation;
          }};
}

/// @param path  in result.json, as a JSON pointer.
ExpectationKind number_kind(const char* key, const char* path, const std::string& meaning) {
  return kind<Limits>(key, meaning, "",
                      [path](const Limits& wanted, const Evidence& e) { return judge_number(path, wanted, e); });
}

ExpectationKind vs_fault_free_kind(const std::string& key, const char* of, const std::string& meaning) {
  return kind<Limits>(
      key, meaning, "", [of](const Limits& wanted, const Evidence& e) { return judge_vs_fault_free(of, wanted, e); },
      Needs::fault_free);
}

ExpectationKind members_kind(const std::string& key, const char* event, const std::string& meaning) {
  return kind<std::vector<std::string>>(
      key, meaning, "",
      [event](const std::vector<std::string>& wanted, const Evidence& e) { return judge_members(event, wanted, e); },
      Needs::nothing, check_members);
}

}  // namespace

const std::vector<ExpectationKind>& expectation_kinds() {
  static const std::vector<ExpectationKind> kinds = {
      kind<std::string>("status", "how the run ended, as in result.json", "completed",
                        [](const std::string& wanted, const Evidence& e) { return judge_text("status", wanted, e); }),
      kind<Limits>("exit_code", "of `skein run`", "0", judge_exit_code),
      kind<bool>("deterministic", "the run has a digest", "true", judge_deterministic),
      kind<bool>("faults_acted", "every fault of the file began before the run ended", "true", judge_faults_acted),
      kind<Limits>("collisions", "UAVs that collided", "0", judge_collisions),
      number_kind("score", "/score", "delivered score"),
      number_kind("score_earned", "/score_earned", "score of all captures, delivered or not"),
      number_kind("points_detected", "/points_detected", "points with a delivered capture"),
      number_kind("scans", "/timing/scans", "LiDAR scans of all explorers that were looked at"),
      vs_fault_free_kind("score_vs_fault_free", "score", "delivered score / that of the same run without faults"),
      vs_fault_free_kind("earned_vs_fault_free", "score_earned", "earned score / that of the same run without faults"),
      kind<Limits>("score_vs_earned", "delivered score / earned score", "", judge_vs_earned),
      kind<RadioLimits>("radio",
                        "messages `sent`, `delivered`, `dropped_no_los`, `dropped_fault`, `dropped_overflow`, "
                        "`duplicated`, `corrupted`, or `sent_bytes`, `delivered_bytes`, each with its limits",
                        "", judge_radio),
      kind<UavLimits>("uavs",
                      "for a UAV's name: `captures`, `distance_m`, `max_speed_mps`, `idle_s`, "
                      "`commands_rejected`, each with its limits",
                      "", judge_uavs, Needs::nothing, check_uavs),
      kind<std::vector<Window>>(
          "during",
          "a list of parts of the run, `{after_s, until_s}`, each with limits for `distance_m`, `captures`, "
          "`delivered`, "
          "`acknowledged`, `lost`, `late` and `score`, and in `uavs` for a UAV's name, all but `score`",
          "", judge_during, Needs::nothing, check_during),
      members_kind("left", run_tables::kLeft, "exactly these programs left the run before its end"),
      members_kind("rejoined", run_tables::kJoined, "exactly these programs joined again"),
      kind<TakenOver>("taken_over", "`{uav, within_s, points}`: the work of a UAV that failed is done by others", "",
                      judge_taken_over, Needs::fault_free, check_taken_over),
      kind<Custody>("custody",
                    "`kept`: nothing that was acknowledged is missing; `exact`: what was delivered, and when, "
                    "is what ledger and links say; `none`",
                    "kept", judge_custody),
      kind<std::vector<Repeat>>("same_digest",
                                "further runs with the same digest: `again`, `cyclonedds`, `fastdds`, "
                                "`mixed`, `chaos`, `one_process`",
                                "[]", judge_same_digest),
  };
  return kinds;
}

std::vector<Judgement> judged(const Expectations& expectations, const Evidence& evidence) {
  std::vector<Judgement> all;
  for (const Expectation& expectation : expectations.all) {
    for (Finding& finding : expectation.judge(evidence)) all.push_back({expectation.key, std::move(finding)});
  }
  return all;
}

}  // namespace skein::cli
