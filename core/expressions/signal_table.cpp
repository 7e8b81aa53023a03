#include "core/expressions/signal_table.hpp"

#include <array>

#include "core/scenario.hpp"
#include "core/text/suggestion.hpp"

namespace skein {
namespace {

using enum SignalArgument;

constexpr bool kBoolean = true, kLive = true, kAfterwards = false;

std::vector<SignalInfo> make_table() {
  const auto number = [](std::string_view name, std::vector<SignalArgument> arguments, std::size_t required, Unit unit,
                         bool live, std::string_view meaning) {
    return SignalInfo{name, std::move(arguments), required, unit, !kBoolean, live, meaning};
  };
  const auto boolean = [](std::string_view name, std::vector<SignalArgument> arguments, std::string_view meaning) {
    const std::size_t required = arguments.size();
    return SignalInfo{name, std::move(arguments), required, kPlainNumber, kBoolean, kLive, meaning};
  };
  return {
      number("time", {}, 0, kSeconds, kLive, "simulated time since the start of the run"),
      number("x", {uav}, 1, kMetres, kLive, "position of the body's centre in the world, to the east"),
      number("y", {uav}, 1, kMetres, kLive, "to the north"),
      number("z", {uav}, 1, kMetres, kLive, "above the ground"),
      number("speed", {uav}, 1, kMetresPerSecond, kLive, "over ground and upwards"),
      number("distance", {uav}, 0, kMetres, kAfterwards, "way flown since the start"),
      number("separation", {uav, uav}, 0, kMetres, kLive,
             "between the centres of two UAVs; of one, to the nearest other; without names, the least of all. Those "
             "that are out do not count; without a second one it is infinite"),
      number("clearance", {uav}, 0, kMetres, kLive,
             "from the body's centre to the structure, 100 m at most; without a name, the least of all that are not "
             "out"),
      number("charge", {uav}, 1, kPlainNumber, kLive,
             "share of the battery's capacity that is left; 1 without batteries"),
      boolean("alive", {uav}, "it has not collided, and is in the world"),
      boolean("member", {program}, "the program takes part in the run"),
      number("restarts", {program}, 0, kPlainNumber, kLive, "how often the program has come back"),
      number("leaves", {program}, 0, kPlainNumber, kLive, "how often the program has left the run"),
      boolean("link", {node, node}, "the radio link is open: line of sight, less what faults cut as a whole"),
      number("faults", {}, 0, kPlainNumber, kLive, "how many faults are in force"),
      number("captures", {uav}, 0, kPlainNumber, kLive, "captures that found something better than before"),
      number("acknowledged", {uav}, 0, kPlainNumber, kLive, "captures whose acknowledgement reached the UAV"),
      number("held", {uav}, 0, kPlainNumber, kLive, "captures on the camera's card: taken and not acknowledged"),
      number("delivered", {uav}, 0, kPlainNumber, kAfterwards, "captures that reached the station"),
      number("acknowledged_kept", {uav}, 0, kPlainNumber, kAfterwards,
             "acknowledged captures that the station had by then, and has in the end"),
      number("acknowledged_by_path", {uav}, 0, kPlainNumber, kAfterwards,
             "acknowledged captures for which there was a way: an open link to the station after they were taken, and "
             "an open link back after that, with the programs on the way taking part"),
      number("lost", {uav}, 0, kPlainNumber, kAfterwards, "messages with capture reports that a link with faults lost"),
      number("late", {uav}, 0, kPlainNumber, kAfterwards,
             "messages with capture reports that a link with faults delayed"),
      number("custody_differences", {}, 0, kPlainNumber, kAfterwards,
             "captures whose delivery by now is not the one that follows from the server's record and the faults"),
      number("score", {}, 0, kPlainNumber, kAfterwards, "of what is delivered, as the station counts it"),
      number("delivered_score", {}, 0, kPlainNumber, kAfterwards,
             "the sum, over all interest points, of the best capture that is delivered and counts"),
      number("points", {}, 0, kPlainNumber, kAfterwards, "interest points with a delivered capture that counts"),
      number("earned", {}, 0, kPlainNumber, kAfterwards, "score of all captures, delivered or not"),
      number("sent", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "radio messages sent, counted once for each target; the arguments are sender, target and topic, and an "
             "argument that is left out stands for all"),
      number("arrived", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "how many of the messages that `sent` counts have arrived; a message that arrives twice counts twice"),
      number("arrived_once", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "`arrived`, but a message that arrives twice counts once"),
      number("arrived_by_link", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "`arrived`, but only of messages that were sent while their link was open"),
      number("in_flight", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "messages that are on their way for longer than an exchange, and will arrive"),
      number("undisturbed_score", {}, 0, kPlainNumber, kAfterwards, "`score` of the same run without faults"),
      number("undisturbed_earned", {}, 0, kPlainNumber, kAfterwards, "`earned` of the same run without faults"),
      number("undisturbed_distance", {uav}, 0, kMetres, kAfterwards, "`distance` in the same run without faults"),
      number("in_hand", {uav}, 1, kPlainNumber, kAfterwards,
             "points that were the UAV's remaining work when it failed: in the same run without faults, this UAV "
             "photographs them only after that time, and no other UAV ever does. A UAV fails when its program first "
             "leaves; if its program never leaves, when the first fault of this UAV begins. 0 before it fails"),
      number("taken_over", {uav}, 1, kPlainNumber, kAfterwards,
             "how many of the points of `in_hand(uav)` other UAVs have photographed since the UAV failed"),
      number(
          "missed", {uav}, 1, kPlainNumber, kAfterwards,
          "points that a UAV whose program was away should have photographed by now, but that no UAV photographs in "
          "the whole run. Let T be the time since the program came back or the last fault ended, whichever was "
          "later, less 40 s: the points are those that this UAV photographs in the first T of the same run without "
          "faults. 0 if the program was never away, and from the UAV's next capture until its program is away again"),
      number("without_work", {uav}, 1, kSeconds, kAfterwards,
             "open time since the UAV last did a least amount of work, less excused waiting, by the referee's truth; 0 "
             "while it is out or its program is away"),
      number("debug", {uav, word}, 2, kPlainNumber, kLive,
             "what the UAV's program published last as `/<id>/debug/<name>`; 0 before"),
      number("result", {path}, 1, kPlainNumber, kAfterwards,
             "a number of `result.json`, all the time; of a list, how many entries it has"),
  };
}

constexpr std::array kResultUnits = {UnitName{"_ms", kSeconds, 1e-3}, UnitName{"_s", kSeconds},
                                     UnitName{"_mps", kMetresPerSecond}, UnitName{"_m", kMetres},
                                     UnitName{"_bytes", kBytes}};

const char* name_of_argument(SignalArgument argument) {
  switch (argument) {
    case uav:
      return "uav";
    case node:
      return "node";
    case program:
      return "program";
    case topic:
      return "topic";
    case path:
      return "path";
    case word:
      return "name";
  }
  return "";
}

}  // namespace

const std::vector<SignalInfo>& signal_table() {
  static const std::vector<SignalInfo> table = make_table();
  return table;
}

std::string SignalInfo::text() const {
  if (arguments.empty()) return std::string(name);
  std::string list;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i == required) list += "[";
    list += (i > 0 ? ", " : "") + std::string(name_of_argument(arguments[i]));
  }
  return std::string(name) + "(" + list + (required < arguments.size() ? "]" : "") + ")";
}

std::string SignalUse::text() const {
  return std::string(info->name) + (arguments.empty() ? "" : "(" + joined(arguments) + ")");
}

SignalNames::SignalNames(const Scenario& scenario) : uavs(scenario.uav_names()), nodes(uavs), programs(uavs) {
  nodes.push_back(scenario.node_name(kStationNode));
  programs.insert(programs.end(), {"station", "comm_router", scenario.node_name(kStationNode)});
}

UnitName unit_of_result(std::string_view path) {
  for (const UnitName& unit : kResultUnits) {
    if (path.ends_with(unit.name)) return unit;
  }
  return {"", kPlainNumber};
}

}  // namespace skein
