// Signals of radio messages, from the recording.
#include <algorithm>
#include <set>

#include "core/radio/link_effect.hpp"
#include "core/radio/radio_routes.hpp"
#include "signals/run_signals.hpp"

namespace skein::signals {
namespace {

/// Target nodes of each stream: those of the scenario's routes, and those at which messages arrived.
std::map<RadioStream, std::set<std::string>> targets_of(const RadioLog& radio, const Scenario& scenario) {
  std::map<RadioStream, std::set<std::string>> targets;
  for (const RadioRoute& route : radio_routes(scenario)) {
    for (const RadioTarget& target : route.targets) {
      targets[{scenario.node_name(route.source), route.ros_topic}].insert(scenario.node_name(target.node));
    }
  }
  for (const RadioArrival& arrival : radio.arrivals) targets[arrival.stream].insert(arrival.target);
  return targets;
}

}  // namespace

FolderSignals::Values FolderSignals::of_messages(const SignalUse& signal) {
  const std::string from = signal.argument(0), to = signal.argument(1), topic = signal.argument(2);
  const auto is_meant = [&](const RadioStream& stream, const std::string& target) {
    return (from.empty() || stream.source == from) && (to.empty() || target == to) &&
           (topic.empty() || names_topic({topic}, stream.topic));
  };
  std::vector<std::size_t> exchanges;
  if (signal.is("sent")) {
    const auto targets = targets_of(radio(), scenario_);
    for (const auto& [stream, steps] : radio().sent) {
      const auto found = targets.find(stream);
      if (found == targets.end()) continue;
      for (const std::string& target : found->second) {
        if (is_meant(stream, target)) exchanges.insert(exchanges.end(), steps.begin(), steps.end());
      }
    }
    return counted(exchanges);
  }
  if (signal.is("in_flight")) {
    Values values = constant(0.0);
    for (const RadioArrival& arrival : radio().arrivals) {
      if (!is_meant(arrival.stream, arrival.target)) continue;
      for (std::size_t k = arrival.sent + 1; k < std::min<std::size_t>(arrival.arrives, exchanges_); ++k) ++values[k];
    }
    return values;
  }
  std::map<std::pair<std::string, std::string>, const std::vector<double>*> links;
  const auto was_open = [&](const RadioArrival& arrival) {
    const std::vector<double>*& link = links[{arrival.stream.source, arrival.target}];
    if (link == nullptr) link = &use("link", {arrival.stream.source, arrival.target});
    return arrival.sent < exchanges_ && (*link)[arrival.sent] > 0.0;
  };
  for (const RadioArrival& arrival : radio().arrivals) {
    if (!is_meant(arrival.stream, arrival.target)) continue;
    if (signal.is("arrived_once") && arrival.again) continue;
    if (signal.is("arrived_over_open_link") && !was_open(arrival)) continue;
    exchanges.push_back(arrival.arrives);
  }
  return counted(exchanges);
}

const std::vector<double>& FolderSignals::use(const std::string& name, std::vector<std::string> arguments) {
  const auto& table = signal_table();
  const auto info = std::ranges::find(table, name, &SignalInfo::name);
  return values({&*info, std::move(arguments)});
}

}  // namespace skein::signals
