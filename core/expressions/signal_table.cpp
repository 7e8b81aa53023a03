#include "core/expressions/signal_table.hpp"

#include <array>

#include "core/scenario/scenario.hpp"
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
      number("x", {uav}, 1, kMetres, kLive, "position of the centre of the UAV's body in the world, to the east"),
      number("y", {uav}, 1, kMetres, kLive, "the same, to the north"),
      number("z", {uav}, 1, kMetres, kLive, "height of the centre of the UAV's body above the ground"),
      number("speed", {uav}, 1, kMetresPerSecond, kLive,
             "magnitude of the UAV's velocity, including its vertical component"),
      number("distance", {uav}, 0, kMetres, kAfterwards, "length of the path that the UAV has flown"),
      number("separation", {uav, uav}, 0, kMetres, kLive,
             "distance between the centres of two UAVs; with one name, between this UAV and the nearest other one; "
             "without names, the smallest between any two. UAVs that are not `alive` are left out; if this leaves no "
             "pair, the value is infinite"),
      number("clearance", {uav}, 0, kMetres, kLive,
             "distance between the centre of the UAV's body and the structure, at most 100 m; without a name, the "
             "smallest of all UAVs that are `alive`"),
      number("charge", {uav}, 1, kPlainNumber, kLive,
             "share of the battery's capacity that is left, from 0 to 1; always 1 if the UAVs have no batteries"),
      boolean("alive", {uav}, "the UAV has not collided, and has not left the world"),
      boolean("member", {program},
              "the program takes part in the run. A program that is killed, paused or lost does not, until it is back"),
      number("restarts", {program}, 0, kPlainNumber, kLive,
             "how often the program has joined the run again after it had left"),
      number("leaves", {program}, 0, kPlainNumber, kLive,
             "how often the program has left the run, because it was killed, paused or lost"),
      boolean("link", {node, node},
              "the radio link from the first node to the second is open: the nodes are in line of sight and in range, "
              "and no fault cuts the link. A fault that only loses or delays messages leaves the link open"),
      number("faults", {}, 0, kPlainNumber, kLive, "number of faults that act at this time"),
      number(
          "captures", {uav}, 0, kPlainNumber, kLive,
          "captures that the UAV has taken. A picture is a capture only if it improves the UAV's own best quality of "
          "at least one interest point"),
      number("acknowledged", {uav}, 0, kPlainNumber, kLive,
             "captures whose acknowledgement by the station has reached the UAV"),
      number("held", {uav}, 0, kPlainNumber, kLive,
             "captures whose reports the UAV's camera keeps: taken, but not yet `acknowledged`"),
      number("delivered", {uav}, 0, kPlainNumber, kAfterwards, "captures whose report the station has received"),
      number("acknowledged_and_delivered", {uav}, 0, kPlainNumber, kAfterwards,
             "those of the `acknowledged` captures whose report the station had received by the time the "
             "acknowledgement reached the UAV, and still has at the end of the run"),
      number("acknowledged_with_path", {uav}, 0, kPlainNumber, kAfterwards,
             "those of the `acknowledged` captures whose report and acknowledgement had a path: some time after the "
             "capture, the link from the UAV to the station was open, and after that the link back. A link counts as "
             "open only while sender, router and receiver take part in the run"),
      number("lost", {uav}, 0, kPlainNumber, kAfterwards,
             "messages with capture reports that a link with a fault has lost, counted when the UAV sends the message"),
      number("late", {uav}, 0, kPlainNumber, kAfterwards,
             "messages with capture reports that a link with a fault delays, counted when the UAV sends the message"),
      number(
          "custody_differences", {}, 0, kPlainNumber, kAfterwards,
          "number of captures about which the station and the rules of custody disagree: the station has received the "
          "capture, but by the rules it should not have yet, or the other way round. The rules derive the deliveries "
          "from the server's record and the faults"),
      number("score", {}, 0, kPlainNumber, kAfterwards,
             "the score of the captures that the station has received, as the station counts it"),
      number("delivered_score", {}, 0, kPlainNumber, kAfterwards,
             "the same score, computed from `captures.csv`: the sum, over all interest points, of the best `delivered` "
             "capture that counts"),
      number("points", {}, 0, kPlainNumber, kAfterwards,
             "number of interest points with a `delivered` capture that counts"),
      number("earned", {}, 0, kPlainNumber, kAfterwards,
             "the score if the station had received all captures taken so far"),
      number("sent", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "radio messages that the first node has sent to the second on the topic. A message to several nodes "
             "counts once for each of them"),
      number("arrived", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "those of the `sent` messages that have arrived; a message that arrives twice counts twice"),
      number("arrived_once", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "as `arrived`, but a message that arrives twice counts once"),
      number("arrived_over_open_link", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "as `arrived`, but only of messages whose link was open when they were sent"),
      number("in_flight", {node, node, topic}, 0, kPlainNumber, kAfterwards,
             "delayed messages: sent one exchange ago or earlier, not yet arrived, but arriving later in the run"),
      number("undisturbed_score", {}, 0, kPlainNumber, kAfterwards,
             "final `score` of the same run without faults, the same number in all exchanges"),
      number("undisturbed_earned", {}, 0, kPlainNumber, kAfterwards,
             "final `earned` of the same run without faults, the same number in all exchanges"),
      number("undisturbed_distance", {uav}, 0, kMetres, kAfterwards,
             "`distance` at this time in the same run without faults"),
      number("work_at_failure", {uav}, 1, kPlainNumber, kAfterwards,
             "number of interest points that the UAV still had to photograph when it failed: in the same run without "
             "faults, this UAV photographs them only after that time, and no other UAV photographs them at all. A UAV "
             "fails when its program first leaves the run; if its program never leaves, when the first fault of this "
             "UAV begins. 0 before the failure"),
      number("taken_over", {uav}, 1, kPlainNumber, kAfterwards,
             "how many of the points of `work_at_failure(uav)` other UAVs have photographed since the failure"),
      number("missed", {uav}, 1, kPlainNumber, kAfterwards,
             "number of interest points that the UAV, whose program was away, should have photographed by now, but "
             "that no UAV photographs in the whole run. These are the points that this UAV photographs in the first T "
             "seconds of the same run without faults. T is the time since the program came back, or since the last "
             "fault ended if that was later, less 40 s for the flight back to work. 0 if the program was never away; "
             "also 0 from the UAV's next capture until its program is away again"),
      number(
          "without_work", {uav}, 1, kSeconds, kAfterwards,
          "time since the UAV last did a least amount of work, by the referee's truth. Only seconds in which there was "
          "open work for the UAV count, without excused waiting ([results.md](results.md#work) defines all of "
          "this). 0 while the UAV is not `alive` or its program is away"),
      number("debug", {uav, word}, 2, kPlainNumber, kLive,
             "the last value that the UAV's program has published as `/<id>/debug/<name>`; 0 before the first"),
      number(
          "result", {path}, 1, kPlainNumber, kAfterwards,
          "the number at this key of `result.json`, the same in all exchanges; for a list, the number of its entries"),
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
