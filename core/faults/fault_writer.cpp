#include "core/faults/fault_writer.hpp"

#include <algorithm>
#include <cctype>

#include "core/config/config_writer.hpp"
#include "core/overloaded.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

ConfigNode time_node(double time_s) { return ConfigNode::make_scalar(shortest(time_s)); }

ConfigNode written(const auto& value) { return ConfigWriter::node_of(value).value_or(ConfigNode{}); }

/// An effect without the keys that have their default values.
ConfigNode link_node(const LinkEffect& effect) {
  const ConfigNode usual = written(LinkEffect{}), all = written(effect);
  ConfigNode node = ConfigNode::make_map();
  for (std::size_t i = 0; i < all.keys.size(); ++i) {
    const ConfigNode* same = usual.find(all.keys[i]);
    const bool queues = all.keys[i] == "queue_bytes" && effect.bandwidth_bit_s;
    if (queues || same == nullptr || flow_text(*same) != flow_text(all.items[i])) node.add(all.keys[i], all.items[i]);
  }
  return node;
}

ConfigNode action_node(const FaultAction& action) {
  return std::visit(
      Overloaded{[](const LinkEffect& f) { return link_node(f); }, [](const Partition& f) { return written(f.groups); },
                 [](const StationOutage&) { return written(true); }, [](const Kill& f) { return written(f.member); },
                 [](const Pause& f) { return written(f.member); }, [](const MotorFailure& f) { return written(f); },
                 [](const CommandDelay& f) { return written(f); }, [](const OdometryJump& f) { return written(f); },
                 [](const Gust& f) { return written(f); }, [](const BatteryLoss& f) { return written(f); },
                 [](const ConditionsChange& f) { return f.values; }, [](const auto& f) { return written(f.uav); }},
      action);
}

/// The scalar, in quotes if a reader could take it for another kind of value.
std::string flow_scalar(const ConfigNode& node) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '.' || c == '-' || c == '+';
  };
  const bool plain =
      !node.scalar.empty() && node.scalar != "null" && std::all_of(node.scalar.begin(), node.scalar.end(), is_plain);
  if (plain && !node.quoted) return node.scalar;
  std::string text = "'";
  for (const char c : node.scalar) text += c == '\'' ? std::string("''") : std::string(1, c);
  return text + "'";
}

}  // namespace

ConfigNode to_node(const Fault& fault) {
  ConfigNode node = ConfigNode::make_map();
  if (fault.waits && fault.when) node.add("when", ConfigNode::make_scalar(fault.when->text, true));
  if (!fault.waits || fault.at_s > 0.0) node.add("at_s", time_node(fault.at_s));
  if (fault.waits && fault.for_s) node.add("for_s", time_node(*fault.for_s));
  if (fault.until_s) node.add("until_s", time_node(*fault.until_s));
  node.add(fault_kind(fault), action_node(fault.action));
  return node;
}

std::string fault_line(const Fault& fault) { return flow_text(to_node(fault)); }

std::string by_hand_text(const std::string& description, const std::vector<std::string>& lines) {
  std::string text = "name: by-hand\ndescription: " + flow_scalar(ConfigNode::make_scalar(description, true)) +
                     "\nby_hand: true  # times count from the start of the run, so they may exceed the mission time\n";
  if (lines.empty()) return text + "faults: []\n";
  text += "faults:\n";
  for (const std::string& line : lines) text += "  - " + line + "\n";
  return text;
}

std::string flow_text(const ConfigNode& node) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  switch (node.kind) {
    case ConfigNode::Kind::null:
      return "~";
    case ConfigNode::Kind::scalar:
      return flow_scalar(node);
    case ConfigNode::Kind::list:
      for (const ConfigNode& item : node.items) add(flow_text(item));
      return "[" + text + "]";
    case ConfigNode::Kind::map:
      for (std::size_t i = 0; i < node.keys.size(); ++i) add(node.keys[i] + ": " + flow_text(node.items[i]));
      return "{" + text + "}";
  }
  return text;
}

}  // namespace skein
