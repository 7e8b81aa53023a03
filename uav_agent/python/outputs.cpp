#include "uav_agent/python/outputs.hpp"

#include <algorithm>
#include <string_view>

#include "core/text/suggestion.hpp"
#include "uav_agent/python/interpreter.hpp"
#include "uav_agent/python/values.hpp"

namespace skein::agent::python {
namespace {

bool is_a(py::handle value, const py::object& type) {
  if (Py_TYPE(value.ptr()) == reinterpret_cast<PyTypeObject*>(type.ptr())) return true;
  return py::isinstance(value, type);
}

Waypoint read_waypoint(py::handle value, const Place& place) {
  if (!is_a(value, words().waypoint)) place.refuse("a skein.planner.Waypoint", value);
  const Place speed(place, "speed_mps");
  const py::object speed_mps = value.attr("speed_mps");
  const Waypoint waypoint{read_vector(value.attr("p_WB"), Place(place, "p_WB")), read_number(speed_mps, speed)};
  if (waypoint.speed_mps <= 0.0) speed.refuse("above 0", speed_mps);
  return waypoint;
}

std::vector<Waypoint> read_way(py::handle value, const Place& place) {
  const py::tuple items = read_list(value, place, "Waypoints");
  if (items.empty()) place.refuse("at least one Waypoint", value);
  std::vector<Waypoint> way;
  for (std::size_t i = 0; i < items.size(); ++i) way.push_back(read_waypoint(items[i], Place(place, i)));
  return way;
}

Motion read_motion(py::handle value, const Place& place) {
  const auto vector = [&](const char* name) { return read_vector(value.attr(name), Place(place, name)); };
  const auto number = [&](const char* name) { return read_number(value.attr(name), Place(place, name)); };
  if (value.is_none()) return std::monostate{};
  if (is_a(value, words().path)) return Path{read_way(value.attr("waypoints"), Place(place, "waypoints"))};
  if (is_a(value, words().hold)) return Hold{};
  if (is_a(value, words().setpoint)) return Setpoint{vector("p_WB"), number("yaw"), vector("v_WB"), vector("a_WB")};
  if (is_a(value, words().trajectory_command)) {
    return TrajectoryCommand{vector("p_WB"), vector("v_WB"), vector("a_WB"), number("yaw"), number("yaw_rate")};
  }
  place.refuse("a Path, Setpoint, Hold or TrajectoryCommand of skein.planner, or None", value);
}

GimbalAim read_gimbal(py::handle value, const Place& place) {
  if (value.is_none()) return std::monostate{};
  if (!is_a(value, words().gimbal_command)) {
    try {
      return read_vector(value, place);
    } catch (const WrongOutput&) {
      place.refuse("a GimbalCommand of skein.planner, a point of three finite numbers, or None", value);
    }
  }
  const Place mode_place(place, "mode");
  const py::object mode = value.attr("mode");
  GimbalCommand command{GimbalMode::freeze, read_number(value.attr("pitch"), Place(place, "pitch")),
                        read_number(value.attr("yaw"), Place(place, "yaw"))};
  const std::string name = read_text(mode, mode_place);
  if (name == "angle") {
    command.mode = GimbalMode::angle;
  } else if (name == "rate") {
    command.mode = GimbalMode::rate;
  } else if (name != "freeze") {
    mode_place.refuse("'angle', 'rate' or 'freeze'", mode);
  }
  return command;
}

std::optional<double> read_yaw(py::handle value, const Place& place) {
  if (value.is_none()) return std::nullopt;
  return read_number(value, place);
}

std::vector<Goal> read_goals(py::handle value, const Place& place) {
  const py::tuple items = read_list(value, place, "Goals, or None");
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const py::handle item = items[i];
    const Place here(place, i);
    if (!is_a(item, words().goal)) here.refuse("a skein.planner.Goal", item);
    goals.push_back({read_integer(item.attr("id"), Place(here, "id")), read_way(item.attr("way"), Place(here, "way")),
                     read_yaw(item.attr("yaw"), Place(here, "yaw")),
                     read_gimbal(item.attr("gimbal"), Place(here, "gimbal"))});
  }
  return goals;
}

Stake read_stake(py::handle value, const Place& place) {
  if (!is_a(value, words().stake)) place.refuse("a skein.planner.Stake or None", value);
  const auto number = [&](const char* name) {
    const py::object given = value.attr(name);
    const Place here(place, name);
    const double read = read_number(given, here);
    if (read < 0.0) here.refuse("0 or more", given);
    return read;
  };
  return {number("value"), number("gain_per_s")};
}

std::vector<RadioMessage> read_radio(py::handle value, const Place& place, const std::vector<std::string>& topics) {
  std::vector<RadioMessage> messages;
  const py::tuple items = read_list(value, place, "RadioMessages");
  for (std::size_t i = 0; i < items.size(); ++i) {
    const py::handle item = items[i];
    const Place here(place, i), topic_place(here, "topic");
    if (!is_a(item, words().radio_message)) here.refuse("a skein.planner.RadioMessage", item);
    const py::object topic = item.attr("topic");
    std::string name = read_text(topic, topic_place);
    if (std::ranges::find(topics, name) == topics.end()) {
      throw WrongOutput(topic_place.text() + ": this UAV may not send on '" + name + "'; " + suggestion(name, topics));
    }
    messages.push_back({std::move(name), read_text(item.attr("text"), Place(here, "text")), std::nullopt});
  }
  return messages;
}

std::optional<std::size_t> read_mate(py::handle value, const Place& place, const AgentConfig& agent) {
  if (value.is_none()) return std::nullopt;
  std::vector<std::string> names;
  for (const FleetMember& member : agent.fleet) names.push_back(member.name);
  std::size_t mate = 0;
  if (PyUnicode_Check(value.ptr()) != 0) {
    const std::string name = read_text(value, place);
    mate = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (mate == names.size()) {
      throw WrongOutput(place.text() + ": no UAV is called '" + name + "'; " + suggestion(name, names));
    }
  } else {
    const std::int64_t index = read_integer(value, place);
    if (index < 0 || index >= static_cast<std::int64_t>(names.size())) {
      place.refuse("a UAV's name, or its index within [0, " + std::to_string(names.size() - 1) + "]", value);
    }
    mate = static_cast<std::size_t>(index);
  }
  if (mate == agent.self) place.refuse("another UAV than this one", value);
  return mate;
}

std::vector<DebugValue> read_debug(py::handle value, const Place& place, const std::vector<std::string>& names) {
  if (PyDict_Check(value.ptr()) == 0) place.refuse("a dictionary of numbers by name", value);
  std::vector<DebugValue> values;
  // A copy, because reading numbers may run the user's code, which may change the dictionary.
  const auto own = py::reinterpret_steal<py::dict>(PyDict_Copy(value.ptr()));
  for (const auto& [key, number] : own) {
    const std::string name = read_text(key, Place(place, "key"));
    if (std::ranges::find(names, name) == names.end()) {
      throw WrongOutput(place.text() + ": debug_names() does not have '" + name + "'; " + suggestion(name, names));
    }
    values.push_back({name, read_number(number, Place(place, name.c_str()))});
  }
  return values;
}

}  // namespace

PlannerOutput read_output(py::handle value, const OutputRules& rules) {
  PlannerOutput output;
  if (value.is_none()) return output;
  const auto field = [&](const char* name) { return value.attr(name); };
  if (!is_a(value, words().planner_output)) {
    Place("plan()").refuse("a skein.planner.PlannerOutput or None", value);
  }
  output.motion = read_motion(field("motion"), Place("motion"));
  output.yaw = read_yaw(field("yaw"), Place("yaw"));
  output.gimbal = read_gimbal(field("gimbal"), Place("gimbal"));
  output.trigger = read_bool(field("trigger"), Place("trigger"));
  output.radio = read_radio(field("radio"), Place("radio"), rules.order.radio_topics);
  if (const py::object goals = field("goals"); !goals.is_none()) {
    if (!rules.flown) throw WrongOutput("goals: need the flight core: let flight() return a FlightConfig");
    output.goals = read_goals(goals, Place("goals"));
  }
  if (const py::object stake = field("stake"); !stake.is_none()) {
    if (!rules.flown) throw WrongOutput("stake: needs the flight core: let flight() return a FlightConfig");
    output.stake = read_stake(stake, Place("stake"));
  }
  const py::tuple heard = read_list(field("heard_maps"), Place("heard_maps"), "bytes");
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const Place maps("heard_maps");
    output.heard_maps.push_back(read_bytes(heard[i], Place(maps, i)));
  }
  if (const py::object going = field("going_to_W"); !going.is_none()) {
    output.going_to_W = read_vector(going, Place("going_to_W"));
  }
  output.no_way = read_text(field("no_way"), Place("no_way"));
  output.waits_for = read_mate(field("waits_for"), Place("waits_for"), rules.order.agent);
  output.debug = read_debug(field("debug"), Place("debug"), rules.debug_names);
  if (rules.flown && !std::holds_alternative<std::monostate>(output.motion)) {
    throw WrongOutput("motion: not allowed if flight() returns a FlightConfig; return goals");
  }
  return output;
}

}  // namespace skein::agent::python
