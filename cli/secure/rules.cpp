#include "cli/secure/rules.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <string_view>

#include "core/messages/view_topics.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/text/xml_text.hpp"
#include "core/topics.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

constexpr std::string_view kSchema = "http://www.omg.org/spec/DDS-Security/20170801/";

/// Adds the root element of a document.
pugi::xml_node add_root(pugi::xml_document& document, const std::string& schema) {
  pugi::xml_node root = document.append_child("dds");
  root.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
  root.append_attribute("xsi:noNamespaceSchemaLocation") = (std::string(kSchema) + schema).c_str();
  return root;
}

void add_domains(pugi::xml_node rule, int first, int last) {
  pugi::xml_node range = rule.append_child("domains").append_child("id_range");
  add_element(range, "min", std::to_string(first));
  add_element(range, "max", std::to_string(last));
}

/// Adds topics to a rule of the permissions. @param what  "publish" or "subscribe"
void add_topics(pugi::xml_node rule, const char* what, const std::vector<std::string>& topics) {
  pugi::xml_node list = rule.append_child(what).append_child("topics");
  for (const std::string& topic : topics) add_element(list, "topic", topic);
}

/// The time `days` days from now (negative: ago), in the documents' format. Callers leave a margin of at least a day,
/// so time zones do not matter.
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

/// Wire names of the topics that only sim_server publishes, in the domains of these UAVs (and "gcs").
std::vector<std::string> server_topics(const std::vector<std::string>& units) {
  std::vector<std::string> names;
  for (const auto& topic :
       {topics::step(), topics::resync(), topics::drop(), topics::ledger(), topics::capture(), topics::detected()}) {
    names.push_back(topic.name);
  }
  add_wire_names(names, topics::uav_topics(), topics::Direction::to_agent, units);
  add_wire_names(names, topics::gcs_topics(), topics::Direction::to_agent, units);
  add_wire_names(names, topics::viewer_topics(), topics::Direction::to_viewer, units);
  for (const auto& topic : {topics::view_story(), topics::view_state(), topics::view_cloud()})
    names.push_back(topic.name);
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
    add_wire_names(names, topics::uav_topics(), topics::Direction::shown_by_agent, all_units);
    add_wire_names(names, topics::score_topics(), topics::Direction::from_station, all_units);
    add_wire_names(names, topics::viewer_topics(), topics::Direction::from_station, all_units);
    names.push_back(topics::view_orders().name);
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
  // A program at the ground station is in the station's domain, but must not publish for the station.
  names.push_back(topics::station_ready().name);
  names.push_back(topics::station_done().name);
  for (const UavConfig& uav : plan.scenario.fleet) names.push_back(topics::captures_ack(uav.name).name);
  return {own, own, std::move(names), {topics::score_eval().name}};
}

std::string permissions(const std::string& subject, const Rights& rights) {
  pugi::xml_document document;
  pugi::xml_node grant =
      add_root(document, "omg_shared_ca_permissions.xsd").append_child("permissions").append_child("grant");
  grant.append_attribute("name") = "skein";
  add_element(grant, "subject_name", subject);
  pugi::xml_node validity = grant.append_child("validity");
  add_element(validity, "not_before", date(-1));
  add_element(validity, "not_after", date(30));
  const auto add_rule = [&](const char* kind) {
    pugi::xml_node rule = grant.append_child(kind);
    add_domains(rule, rights.first_domain, rights.last_domain);
    return rule;
  };
  // The first matching rule decides. Cyclone DDS takes a topic that a rule denies in one direction for denied in both,
  // unless an earlier rule allows the other direction.
  if (!rights.not_read.empty()) {
    pugi::xml_node hidden = add_rule("deny_rule");
    add_topics(hidden, "publish", rights.not_read);
    add_topics(hidden, "subscribe", rights.not_read);
  }
  add_topics(add_rule("allow_rule"), "subscribe", {"*"});
  if (!rights.not_published.empty()) add_topics(add_rule("deny_rule"), "publish", rights.not_published);
  add_topics(add_rule("allow_rule"), "publish", {"*"});
  add_element(grant, "default", "DENY");
  return xml_file(document);
}

std::string governance(int first_domain, int last_domain) {
  pugi::xml_document document;
  pugi::xml_node domains = add_root(document, "omg_shared_ca_governance.xsd")
                               .append_child("domain_access_rules")
                               .append_child("domain_rule");
  add_domains(domains, first_domain, last_domain);
  add_element(domains, "allow_unauthenticated_participants", "false");
  add_element(domains, "enable_join_access_control", "true");
  add_element(domains, "discovery_protection_kind", "ENCRYPT");
  add_element(domains, "liveliness_protection_kind", "ENCRYPT");
  add_element(domains, "rtps_protection_kind", "NONE");
  // Whole submessages are encrypted, so that programs without a certificate cannot inject heartbeats or gaps either.
  pugi::xml_node topics = domains.append_child("topic_access_rules").append_child("topic_rule");
  add_element(topics, "topic_expression", "*");
  add_element(topics, "enable_discovery_protection", "true");
  add_element(topics, "enable_liveliness_protection", "true");
  add_element(topics, "enable_read_access_control", "true");
  add_element(topics, "enable_write_access_control", "true");
  add_element(topics, "metadata_protection_kind", "ENCRYPT");
  add_element(topics, "data_protection_kind", "NONE");
  return xml_file(document);
}

}  // namespace skein::cli
