#include "cli/fault_expectations.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "cli/custody.hpp"
#include "cli/fault_limits.hpp"
#include "core/suggestion.hpp"

namespace skein::cli {
namespace {

using Sentences = std::vector<std::string>;

Sentences unless(bool holds, const std::string& expected, const std::string& seen) {
  return holds ? Sentences{} : Sentences{"expected " + expected + ", seen " + seen};
}

std::string list_text(const std::set<std::string>& names) {
  return names.empty() ? "nobody" : joined({names.begin(), names.end()});
}

// ---- the types of expectations beside plain values --------------------------------------------------------------

constexpr auto radio_counters() {
  return std::array{"sent",       "delivered",  "dropped_no_los", "dropped_fault", "dropped_overflow",
                    "duplicated", "sent_bytes", "delivered_bytes"};
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

// ---- checks of files --------------------------------------------------------------------------------------------

void check_known(const std::string& name, const std::vector<std::string>& known, const std::string& key,
                 const std::string& what, const ExpectationContext& context) {
  const bool found = std::find(known.begin(), known.end(), name) != known.end();
  context.errors.check(found, "expect." + key, "there is no " + what + " '" + name + "'; " + suggestion(name, known));
}

void check_members(const std::string& key, const std::vector<std::string>& names, const ExpectationContext& context) {
  std::vector<std::string> known = context.scenario.uav_names();
  known.insert(known.end(), {context.scenario.node_name(kStationNode), "station", "comm_router"});
  for (const std::string& name : names) check_known(name, known, key, "program", context);
}

void check_uavs(const std::string& key, const UavLimits& uavs, const ExpectationContext& context) {
  for (const auto& [name, limits] : uavs) check_known(name, context.scenario.uav_names(), key, "UAV", context);
}

/// The first fault that concerns a UAV alone.
const Fault* first_fault_of(const std::string& uav, const FaultPlan& plan) {
  const Fault* first = nullptr;
  for (const Fault& fault : plan.faults) {
    if (fault_target(fault) == uav && (!first || fault.at_s < first->at_s)) first = &fault;
  }
  return first;
}

void check_taken_over(const std::string& key, const TakenOver& wanted, const ExpectationContext& context) {
  check_known(wanted.uav, context.scenario.uav_names(), key + ".uav", "UAV", context);
  context.errors.check(first_fault_of(wanted.uav, context.plan) != nullptr, "expect." + key + ".uav",
                       "no fault of this file befalls '" + wanted.uav + "', so it has nothing to hand over");
}

// ---- judges -----------------------------------------------------------------------------------------------------

double number(const RunRecord& run, const char* key) { return value_or(run.result, key, 0.0); }

Sentences judge_text(const char* key, const std::string& wanted, const Evidence& evidence) {
  const std::string seen = value_or(evidence.run.result, key, "nothing");
  return unless(seen == wanted, wanted, seen);
}

Sentences judge_exit_code(const Limits& wanted, const Evidence& evidence) {
  return unless(wanted.contain(evidence.exit_code), wanted.text(), std::to_string(evidence.exit_code));
}

Sentences judge_deterministic(bool wanted, const Evidence& evidence) {
  const bool seen = value_or(evidence.run.result, "deterministic", false) &&
                    value_or(evidence.run.result, "digest", nullptr).is_string();
  return unless(seen == wanted, wanted ? "a digest" : "no digest", seen ? "one" : "none");
}

Sentences judge_faults_acted(bool wanted, const Evidence& evidence) {
  const Json entries = value_or(evidence.run.result, "faults", Json::array());
  Sentences sentences;
  for (std::size_t i = 0; i < evidence.plan.faults.size(); ++i) {
    const Fault& fault = evidence.plan.faults[i];
    const bool began = i < entries.size() && value_or(entries[i], "began_step", nullptr).is_number();
    if (began == wanted) continue;
    sentences.push_back(
        "expected that " + fault_kind(fault) + " of " + fault_target(fault) + (wanted ? " begins" : " does not begin") +
        " at " + number_text(fault.at_s) + " s, seen that it " +
        (began ? "did" : "did not; the run ended at " + number_text(number(evidence.run, "sim_time_s")) + " s"));
  }
  return sentences;
}

Sentences judge_collisions(const Limits& wanted, const Evidence& evidence) {
  const Json collisions = value_or(evidence.run.result, "collisions", Json::array());
  std::string seen = std::to_string(collisions.size());
  for (const Json& collision : collisions) {
    seen += "; " + value_or(collision, "uav", "").get<std::string>() + " with " +
            value_or(collision, "with", "").get<std::string>() + " at " +
            number_text(value_or(collision, "time_s", 0.0)) + " s";
  }
  return unless(wanted.contain(static_cast<double>(collisions.size())), wanted.text(), seen);
}

/// Members with an event after the first step.
std::set<std::string> members_with(const std::string& event, const RunRecord& run) {
  std::set<std::string> members;
  for (const EventRow& row : run.events) {
    if (row.event == event && row.step > 0) members.insert(row.subject);
  }
  return members;
}

Sentences judge_members(const char* event, const std::vector<std::string>& wanted, const Evidence& evidence) {
  const std::set<std::string> expected(wanted.begin(), wanted.end()), seen = members_with(event, evidence.run);
  return unless(seen == expected, list_text(expected), list_text(seen));
}

Sentences judge_number(const char* key, const Limits& wanted, const Evidence& evidence) {
  const double seen = number(evidence.run, key);
  return unless(wanted.contain(seen), wanted.text(), number_text(seen));
}

/// @param of  what 1 means.
Sentences judge_share(const Limits& wanted, double part, double whole, const std::string& of) {
  const double share = whole > 0.0 ? part / whole : 1.0;
  return unless(wanted.contain(share), wanted.text(),
                number_text(share) + " (" + number_text(part) + " of " + number_text(whole) + " " + of + ")");
}

Sentences judge_vs_fault_free(const char* key, const Limits& wanted, const Evidence& evidence) {
  return judge_share(wanted, number(evidence.run, key), number(*evidence.fault_free, key), "without faults");
}

Sentences judge_vs_earned(const Limits& wanted, const Evidence& evidence) {
  return judge_share(wanted, number(evidence.run, "score"), number(evidence.run, "score_earned"), "earned");
}

Sentences judge_limits(const std::map<std::string, Limits>& wanted, const Json& seen, const std::string& whose) {
  Sentences sentences;
  for (const auto& [name, limits] : wanted) {
    const double value = value_or(seen, name.c_str(), 0.0);
    const Sentences broken = unless(limits.contain(value), limits.text() + " " + whose + name, number_text(value));
    sentences.insert(sentences.end(), broken.begin(), broken.end());
  }
  return sentences;
}

Sentences judge_radio(const RadioLimits& wanted, const Evidence& evidence) {
  return judge_limits(wanted.limits, value_or(evidence.run.result, "radio", Json::object()), "");
}

Sentences judge_uavs(const UavLimits& wanted, const Evidence& evidence) {
  Sentences sentences;
  for (const auto& [name, limits] : wanted) {
    Json seen;
    for (const Json& uav : value_or(evidence.run.result, "uavs", Json::array())) {
      if (value_or(uav, "name", "") == name) seen = uav;
    }
    const Sentences broken = judge_limits(limits.limits, seen, "for " + name + "'s ");
    sentences.insert(sentences.end(), broken.begin(), broken.end());
  }
  return sentences;
}

/// The work in hand: points that, without the fault, this UAV is the first to photograph after its fault, and that
/// nobody else photographs before the time is over. Taken over is each that now somebody else photographs in time.
Sentences judge_taken_over(const TakenOver& wanted, const Evidence& evidence) {
  const double from_s = first_fault_of(wanted.uav, evidence.plan)->at_s, until_s = from_s + wanted.within_s;
  std::set<int> in_hand, others, done;
  for (const CaptureRow& row : evidence.fault_free->captures) {
    if (row.uav == wanted.uav ? row.time_s < from_s : row.time_s <= until_s) others.insert(row.point);
    if (row.uav == wanted.uav && row.time_s >= from_s) in_hand.insert(row.point);
  }
  for (const int point : others) in_hand.erase(point);
  for (const CaptureRow& row : evidence.run.captures) {
    const bool in_time = row.time_s >= from_s && row.time_s <= until_s;
    if (in_time && row.uav != wanted.uav && in_hand.contains(row.point)) done.insert(row.point);
  }
  return unless(done.size() >= static_cast<std::size_t>(wanted.points),
                "others to photograph at least " + std::to_string(wanted.points) + " of the " +
                    std::to_string(in_hand.size()) + " points that " + wanted.uav + " had before it, from " +
                    number_text(from_s) + " to " + number_text(until_s) + " s",
                std::to_string(done.size()));
}

Sentences judge_custody(Custody wanted, const Evidence& evidence) {
  if (wanted == Custody::none) return {};
  Sentences sentences = custody_losses(evidence.run, evidence.scenario);
  if (wanted == Custody::kept) return sentences;
  const Sentences differences = custody_differences(evidence.run, evidence.scenario, evidence.plan);
  sentences.insert(sentences.end(), differences.begin(), differences.end());
  return sentences;
}

Sentences judge_same_digest(const std::vector<Repeat>&, const Evidence& evidence) {
  const Json digest = value_or(evidence.run.result, "digest", nullptr);
  Sentences sentences;
  for (const auto& [how, run] : evidence.repeats) {
    const Json other = value_or(run->result, "digest", nullptr);
    const bool same = digest.is_string() && digest == other;
    const Sentences broken =
        unless(same, "the digest " + digest.dump() + " of the repetition '" + how + "' too",
               other.dump() + "; compare " + evidence.run.dir.string() + " with " + run->dir.string());
    sentences.insert(sentences.end(), broken.begin(), broken.end());
  }
  return sentences;
}

// ---- the table --------------------------------------------------------------------------------------------------

template <class T>
using Judge = std::function<Sentences(const T&, const Evidence&)>;
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

ExpectationKind number_kind(const char* key, const std::string& meaning) {
  return kind<Limits>(key, meaning, "",
                      [key](const Limits& wanted, const Evidence& e) { return judge_number(key, wanted, e); });
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
      number_kind("score", "delivered score"),
      number_kind("score_earned", "score of all captures, delivered or not"),
      number_kind("points_detected", "points with a delivered capture"),
      vs_fault_free_kind("score_vs_fault_free", "score", "delivered score / that of the same run without faults"),
      vs_fault_free_kind("earned_vs_fault_free", "score_earned", "earned score / that of the same run without faults"),
      kind<Limits>("score_vs_earned", "delivered score / earned score", "", judge_vs_earned),
      kind<RadioLimits>("radio",
                        "messages `sent`, `delivered`, `dropped_no_los`, `dropped_fault`, `dropped_overflow`, "
                        "`duplicated`, or `sent_bytes`, `delivered_bytes`, each with its limits",
                        "", judge_radio),
      kind<UavLimits>("uavs",
                      "for a UAV's name: `captures`, `distance_m`, `max_speed_mps`, `idle_s`, "
                      "`commands_rejected`, each with its limits",
                      "", judge_uavs, Needs::nothing, check_uavs),
      members_kind("left", "left", "exactly these programs left the run before its end"),
      members_kind("rejoined", "joined", "exactly these programs joined again"),
      kind<TakenOver>("taken_over", "`{uav, within_s, points}`: the work of a UAV that failed is done by others", "",
                      judge_taken_over, Needs::fault_free, check_taken_over),
      kind<Custody>("custody",
                    "`kept`: nothing that was acknowledged is missing; `exact`: what was delivered, and when, "
                    "is what ledger and links say; `none`",
                    "kept", judge_custody),
      kind<std::vector<Repeat>>("same_digest",
                                "further runs with the same digest: `again`, `cyclonedds`, `fastdds`, "
                                "`mixed`, `chaos`",
                                "[]", judge_same_digest),
  };
  return kinds;
}

std::vector<std::string> broken_expectations(const Expectations& expectations, const Evidence& evidence) {
  std::vector<std::string> broken;
  for (const Expectation& expectation : expectations.all) {
    for (const std::string& sentence : expectation.judge(evidence)) broken.push_back(expectation.key + ": " + sentence);
  }
  return broken;
}

}  // namespace skein::cli
