#include "cli/secure/rules.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <string_view>

#include "core/radio_routes.hpp"
#include "core/topics.hpp"
#include "process/run_folder.hpp"

namespace skein::cli {
namespace {

constexpr std::string_view kSchema = "http://www.omg.org/spec/DDS-Security/20170801/";

std::string document(const std::string& schema, const std::string& body) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
         "xsi:noNamespaceSchemaLocation=\"" +
         std::string(kSchema) + schema + "\">\n" + body + "</dds>\n";
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">\n";
}

std::string domains(int first, int last) {
  return element("domains",
                 element("id_range", element("min", std::to_string(first)) + element("max", std::to_string(last))));
}

/// @returns days from now as the documents write times; a day's margin each way makes time zones irrelevant
std::string date(int days) {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()) + days * 24L * 3600;
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  return {text.data(), size};
}

void add_wire_names(std::vector<std::string>& names, std::span<const topics::TopicInfo> table,
                    topics::Direction direction, const std::vector<std::string>& units) {
  for (const topics::TopicInfo& topic : table) {
    if (topic.direction != direction) continue;
    for (const std::string& unit : units) {
      std::string name = topics::wire(topic, unit).name;
      if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
  }
}

/// All that sim_server alone writes in the domains of these units.
std::vector<std::string> server_topics(const std::vector<std::string>& units) {
  std::vector<std::string> names;
  for (const auto& topic :
       {topics::step(), topics::resync(), topics::drop(), topics::ledger(), topics::capture(), topics::detected()}) {
    names.push_back(topic.name);
  }
  add_wire_names(names, topics::uav_topics(), topics::Direction::to_agent, units);
  add_wire_names(names, topics::gcs_topics(), topics::Direction::to_agent, units);
  return names;
}

}  // namespace

Rights rights_of(const FleetPlan& plan, const std::string& program, int base_domain) {
  const int last = base_domain + domain_count(plan) - 1;
  if (program == programs::kSimServer) return {base_domain, last, {}};

  std::vector<std::string> all_units = {"gcs"};
  for (const UavConfig& uav : plan.scenario.fleet) all_units.push_back(uav.name);
  if (program == programs::kCommRouter) {
    std::vector<std::string> names = server_topics(all_units);
    add_wire_names(names, topics::uav_topics(), topics::Direction::from_agent, all_units);
    add_wire_names(names, topics::score_topics(), topics::Direction::from_station, all_units);
    return {base_domain, last, std::move(names)};
  }
  const bool is_station = program == topics::kStationMember;
  std::vector<std::string> names = server_topics(is_station ? all_units : std::vector{programs::member_name(program)});
  for (const auto& topic : {topics::attached(), topics::routed(), topics::awaits(), topics::radio_reply()}) {
    names.push_back(topic.name);
  }
  if (is_station) return {world_domain(base_domain), gcs_domain(base_domain), std::move(names)};
  const int own = agent_domain(plan, program, base_domain);
  names.push_back(topics::score().name);
  // A program at the ground station shares the station's domain, and neither its name nor its word.
  names.push_back(topics::station_ready().name);
  names.push_back(topics::station_done().name);
  for (const UavConfig& uav : plan.scenario.fleet) names.push_back(topics::captures_ack(uav.name).name);
  return {own, own, std::move(names), {topics::score_eval().name}};
}

std::string permissions(const std::string& subject, const Rights& rights) {
  const std::string where = domains(rights.first_domain, rights.last_domain);
  const auto listed = [](const std::vector<std::string>& topics) {
    std::string elements;
    for (const std::string& topic : topics) elements += element("topic", topic);
    return elements;
  };
  const std::string refused = listed(rights.not_published), hidden = element("topics", listed(rights.not_read));
  const std::string everything = element("topics", element("topic", "*"));
  // The first rule that fits decides. Cyclone DDS takes a topic that a rule refuses in one direction for refused as a
  // whole, unless a rule before it allows the other direction.
  std::string rules;
  if (!rights.not_read.empty()) {
    rules += element("deny_rule", where + element("publish", hidden) + element("subscribe", hidden));
  }
  rules += element("allow_rule", where + element("subscribe", everything));
  if (!refused.empty()) rules += element("deny_rule", where + element("publish", element("topics", refused)));
  rules += element("allow_rule", where + element("publish", everything));
  const std::string validity = element("validity", element("not_before", date(-1)) + element("not_after", date(30)));
  return document("omg_shared_ca_permissions.xsd",
                  element("permissions", "<grant name=\"skein\">\n" + element("subject_name", subject) + validity +
                                             rules + element("default", "DENY") + "</grant>\n"));
}

std::string governance(int first_domain, int last_domain) {
  // Submessages are encrypted as a whole, so nobody without a certificate can slip in a heartbeat or a gap either.
  const std::string topics = element(
      "topic_rule", element("topic_expression", "*") + element("enable_discovery_protection", "true") +
                        element("enable_liveliness_protection", "true") +
                        element("enable_read_access_control", "true") + element("enable_write_access_control", "true") +
                        element("metadata_protection_kind", "ENCRYPT") + element("data_protection_kind", "NONE"));
  return document(
      "omg_shared_ca_governance.xsd",
      element(
          "domain_access_rules",
          element("domain_rule",
                  domains(first_domain, last_domain) + element("allow_unauthenticated_participants", "false") +
                      element("enable_join_access_control", "true") + element("discovery_protection_kind", "ENCRYPT") +
                      element("liveliness_protection_kind", "ENCRYPT") + element("rtps_protection_kind", "NONE") +
                      element("topic_access_rules", topics))));
}

}  // namespace skein::cli
