// The table of all signals that expressions in fault files (`when`) and in properties may name, with units and
// meaning. A signal is a step function of simulated time: it has one value in each exchange. signals/ computes the
// values. docs/properties.md lists the signals for users; a test compares the two lists. Pure.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

#include "core/expressions/unit.hpp"

namespace skein {

struct Scenario;

/// Kinds of arguments of a signal.
enum class SignalArgument {
  uav,
  node,     ///< a UAV, or "gcs"
  program,  ///< a UAV, "station", "comm_router" or "gcs"
  topic,    ///< "/plan", which also means "/plan/..."
  path,     ///< of a number in result.json: "radio.sent", "uavs.changi.idle_s"
  word      ///< a name that a planner has chosen
};

struct SignalInfo {
  std::string_view name;
  std::vector<SignalArgument> arguments;
  std::size_t required = 0;  ///< how many arguments must be given; an omitted argument, or `all`, means all
  Unit unit;                 ///< with a `path`: see unit_of_result()
  bool is_boolean = false;   ///< true or false, as 1 or 0
  bool is_live = false;      ///< known during a run, so `when` may name it
  std::string_view meaning;

  /// "link(node, node)", "captures([uav])".
  std::string text() const;
};

const std::vector<SignalInfo>& signal_table();

/// The largest value of the signal `clearance` [m], also of UAVs that are farther from all structure.
inline constexpr double kFarClearance_m = 100.0;

/// A signal as an expression names it, with the run's names as arguments.
struct SignalUse {
  const SignalInfo* info = nullptr;  ///< its entry in the table
  std::vector<std::string> arguments;

  bool is(std::string_view name) const { return info->name == name; }
  /// The argument at an index; "" if it was omitted.
  std::string argument(std::size_t place) const { return place < arguments.size() ? arguments[place] : std::string(); }
  std::string text() const;
  bool operator==(const SignalUse&) const = default;
};

/// The names that arguments may have in a run.
struct SignalNames {
  explicit SignalNames(const Scenario& scenario);

  std::vector<std::string> uavs, nodes, programs;
};

/// The suffix of a key of result.json gives its unit: `_s`, `_ms`, `_m`, `_mps`, `_bytes`.
UnitName unit_of_result(std::string_view path);

}  // namespace skein
