// Which topics of a node belong to the lock-step, and the node's endpoints on them.
#include <algorithm>

#include "fleet_topics.hpp"
#include "member.hpp"
#include "real_rmw.hpp"
#include "say.hpp"

namespace skein_ros {
namespace {

const FleetTopic* fleet_topic(const std::string& topic, const std::string& uav) {
  for (const FleetTopic& entry : kFleetTopics) {
    if (named(entry.pattern, uav) == topic) return &entry;
  }
  return nullptr;
}

}  // namespace

Member::Role Member::role_of_reading(const std::string& topic) const {
  Role role;
  const FleetTopic* const entry = fleet_topic(topic, setup_.uav);
  if (entry != nullptr && entry->way == Way::to_node) {
    if (entry->explorers_only && !setup_.explorer) return role;  // no program writes it
    role = {Counterpart::server, entry->depth, entry->latched};
  } else if (setup_.radio_hears.count(topic) != 0) {
    role = {Counterpart::router, kArrivalDepth, false};
  }
  if (role.counterpart != Counterpart::none && declared_ && !over_) {
    role.refusal = "a subscription to " + topic +
                   " made after the node's first wait: the fleet has been told what it "
                   "reads; make it in the node's constructor";
  }
  return role;
}

Member::Role Member::role_of_writing(const std::string& topic) const {
  Role role;
  const std::string debug = "/" + setup_.uav + "/debug/";
  const FleetTopic* const entry = fleet_topic(topic, setup_.uav);
  if (entry != nullptr && entry->way == Way::to_node) {
    role.refusal = "a publisher on " + topic + ": sim_server alone writes that";
  } else if (entry != nullptr) {
    role = {Counterpart::server, entry->depth, false};
  } else if (setup_.radio_sends.count(topic) != 0) {
    role = {Counterpart::router, kRadioDepth, false};
  } else if (topic.rfind(debug, 0) == 0) {
    role = {Counterpart::server, kCommandDepth, false};
    if (setup_.debug_values.count(topic.substr(debug.size())) == 0) {
      role.refusal = "a publisher on " + topic + ": the fleet is told of debug values beforehand; set " +
                     "SKEIN_DEBUG_VALUES='" + topic.substr(debug.size()) + " ...'";
    }
  }
  if (role.counterpart != Counterpart::none && declared_ && !over_) {
    role.refusal = "a publisher on " + topic +
                   " made after the node's first wait: the fleet has been told what it "
                   "writes; make it in the node's constructor";
  }
  return role;
}

Incoming& Member::add(std::unique_ptr<Incoming> incoming) {
  for (const auto& [topic, base] : base_) {
    if (topic == "rt" + incoming->topic()) incoming->set_base(base.first, base.second);
  }
  incomings_.push_back(std::move(incoming));
  return *incomings_.back();
}

Outgoing& Member::add(std::unique_ptr<Outgoing> outgoing) {
  outgoings_.push_back(std::move(outgoing));
  return *outgoings_.back();
}

void Member::remove(const Incoming& incoming) {
  incomings_.erase(
      std::remove_if(incomings_.begin(), incomings_.end(), [&](const auto& entry) { return entry.get() == &incoming; }),
      incomings_.end());
}

void Member::remove(const Outgoing& outgoing) {
  outgoings_.erase(
      std::remove_if(outgoings_.begin(), outgoings_.end(), [&](const auto& entry) { return entry.get() == &outgoing; }),
      outgoings_.end());
}

}  // namespace skein_ros
