#include "run/planner_spec.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "core/planners/python_spec.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "run/ros_command.hpp"

namespace skein::cli {
namespace {

constexpr std::string_view kGround = "gcs";
constexpr char kAt = '@';
constexpr std::size_t kLongestLabel = 100;

/// Whether the item after a comma may still belong to this planner.
bool goes_on(const std::string& spec, bool item_has_key) {
  return is_command(spec) || (item_has_key && has_parameters(spec));
}

InputError wrong(const std::string& text, const std::string& what) {
  return InputError("--planner " + text + ": " + what);
}

void check_spec(const std::string& text, const std::string& spec) {
  if (spec.empty() || spec.front() == kAt) throw wrong(text, "a planner's name is missing; write NAME or UAV=NAME,...");
  const auto command = exec_command(spec);
  if (command && command->find_first_not_of(' ') == std::string::npos) {
    throw wrong(text, "a command must follow 'exec:', such as exec:./my_planner");
  }
}

/// Parameters may be left out, but not behind a colon: "hover:" and "hover" would be two texts of one planner.
void check_parameters(const std::string& text, const std::string& spec) {
  if (!spec.ends_with(':')) return;
  const auto python = python_spec(spec);
  const bool has_none = python ? python->parameters.empty() : spec.find(':') == spec.size() - 1;
  if (!has_none) return;
  const std::string name = spec.substr(0, spec.size() - 1);
  throw wrong(text, "parameters must follow '" + spec + "', such as " + spec + "KEY=VALUE; without any, write " + name);
}

/// @param spec  the complete text of the planner: with all parameters, and the agent's path if any.
UavPlanner read_planner(const std::string& text, const std::string& node, const std::string& spec) {
  if (exec_command(spec)) return {node, spec};
  const std::size_t at = spec.rfind(kAt);
  const std::string name = spec.substr(0, at);
  check_parameters(text, name);
  if (at == std::string::npos) return {node, spec};
  const std::string agent = spec.substr(at + 1);
  if (agent.empty()) {
    throw wrong(text, "the file of an agent program must follow '@', such as " + spec + "build/my_agent");
  }
  return {node, name, agent};
}

}  // namespace

std::optional<std::string> exec_command(const std::string& spec) {
  if (!spec.starts_with(kExec)) return ros_command(spec);
  return spec.substr(kExec.size());
}

Planners parse_planners(const std::string& text, const std::vector<std::string>& fleet) {
  std::vector<std::string> nodes = fleet;
  nodes.emplace_back(kGround);
  std::map<std::string, std::string> named;
  std::string fallback;
  std::string* last = nullptr;  // the planner that a following parameter belongs to
  for (const std::string& item : split(text)) {
    const std::size_t equals = key_end(item);
    const bool has_key = equals != std::string::npos;
    const std::string key = has_key ? item.substr(0, equals) : "";
    const bool is_uav = has_key && std::find(nodes.begin(), nodes.end(), key) != nodes.end();
    if (!is_uav && last != nullptr && goes_on(*last, has_key)) {
      *last += "," + item;
      continue;
    }
    if (has_key && !is_uav) {
      throw wrong(text, "no UAV is called '" + key + "'; " + suggestion(key, nodes));
    }
    const std::string spec = is_uav ? item.substr(equals + 1) : item;
    check_spec(text, spec);
    last = is_uav ? &named[key] : &fallback;
    if (!last->empty()) {
      throw wrong(text, "two planners for " + (is_uav ? "'" + key + "'" : "the same UAVs") + "; give one");
    }
    *last = spec;
  }
  if (fallback.empty()) fallback = kDefaultPlanner;

  const std::string ground(kGround);
  Planners planners{{}, std::nullopt, read_planner(text, ground, fallback)};
  for (const std::string& uav : fleet) {
    const auto found = named.find(uav);
    planners.uavs.push_back(read_planner(text, uav, found == named.end() ? fallback : found->second));
  }
  if (const auto found = named.find(ground); found != named.end()) {
    planners.ground = read_planner(text, ground, found->second);
    const bool is_none = planners.ground->spec == kNoGround;
    if (is_none && planners.ground->agent) throw wrong(text, "'none' takes no agent program; write gcs=none");
  }
  return planners;
}

std::string planners_rewritten(const std::string& text, const std::vector<std::string>& fleet,
                               const std::function<UavPlanner(const UavPlanner& planner)>& rewrite) {
  const Planners planners = parse_planners(text, fleet);
  const std::string fallback = written(planners.fallback);
  std::string again = fallback;
  bool any = false;
  for (const UavPlanner& planner : planners.uavs) {
    const std::string before = written(planner), now = written(rewrite(planner));
    any = any || now != before;
    if (now != fallback) again += "," + planner.uav + "=" + now;
  }
  if (planners.ground) again += "," + planners.ground->uav + "=" + written(*planners.ground);
  return any ? again : text;
}

bool has_parameters(const std::string& spec) {
  // The colons of py:FILE:CLASS do not start parameters.
  if (const auto python = python_spec(spec.substr(0, spec.rfind(kAt)))) return !python->parameters.empty();
  const std::size_t end_of_name = spec.find_first_of(":@");
  return end_of_name != std::string::npos && spec[end_of_name] == ':';
}

std::size_t key_end(const std::string& item) {
  const std::size_t end_of_key = item.find_first_of("=:@");
  return end_of_key != std::string::npos && item[end_of_key] == '=' ? end_of_key : std::string::npos;
}

std::string with_agents_named(const std::string& text, const NameOfAgent& name_of) {
  std::vector<std::string> items = split(text);
  for (std::string& item : items) {
    const std::size_t equals = key_end(item);
    if (is_command(std::string_view(item).substr(equals == std::string::npos ? 0 : equals + 1))) break;
    const std::size_t path = item.rfind(kAt) + 1;
    const bool has_agent = path != 0 && path < item.size();
    if (has_agent)
      item.replace(path, item.npos, name_of(std::filesystem::absolute(item.substr(path)).lexically_normal()));
  }
  return joined(items, ",");
}

std::string planner_label(const std::string& text) {
  std::string label = text.substr(0, kLongestLabel);
  for (char& c : label) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '_' && c != kAt) c = '_';
  }
  return label;
}

}  // namespace skein::cli
