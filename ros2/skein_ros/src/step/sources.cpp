#include "sources.hpp"

#include <dlfcn.h>
#include <rmw/get_topic_endpoint_info.h>
#include <rmw/qos_profiles.h>

#include <cstring>

#include "real_rmw.hpp"
#include "say.hpp"

namespace skein_ros {
namespace {

constexpr int kPrefixBytes = 12;

Source source_of_guid(const std::uint8_t* guid) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (int i = 0; i < kPrefixBytes; ++i) hash = (hash ^ guid[i]) * 0x100000001b3;
  return hash;
}

/// rmw_cyclonedds identifies a writer by its instance handle; only Cyclone DDS itself knows the GUID, with which its
/// dds_builtintopic_endpoint_t begins.
struct Endpoint {
  std::uint8_t key[16];
};
using MatchedPublication = Endpoint* (*)(std::int32_t reader, std::uint64_t writer);
using FreeEndpoint = void (*)(Endpoint*);

template <class Function>
Function of_cyclonedds(const char* name) {
  void* symbol = dlsym(RTLD_DEFAULT, name);
  for (const char* library : {"libddsc.so.0", "libddsc.so"}) {
    if (symbol != nullptr) break;
    if (void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD)) symbol = dlsym(handle, name);
  }
  if (symbol == nullptr) fail(std::string("Cyclone DDS has no ") + name + ": who wrote a sample cannot be told");
  return reinterpret_cast<Function>(symbol);
}

Source of_matched_writer(const rmw_subscription_t* subscription, std::uint64_t writer) {
  static const auto matched = of_cyclonedds<MatchedPublication>("dds_get_matched_publication_data");
  static const auto free_endpoint = of_cyclonedds<FreeEndpoint>("dds_builtintopic_free_endpoint");
  std::int32_t reader = 0;  // the struct of rmw_cyclonedds begins with this handle
  std::memcpy(&reader, subscription->data, sizeof reader);
  Endpoint* const endpoint = matched(reader, writer);
  if (endpoint == nullptr) return 0;
  const Source source = source_of_guid(endpoint->key);
  free_endpoint(endpoint);
  return source;
}

/// The endpoints on a topic that the node's rmw knows.
class Endpoints {
 public:
  using Get = decltype(&rmw_get_publishers_info_by_topic);
  Endpoints(Get get, const rmw_node_t* node, const char* topic) {
    if (get(node, &allocator_, topic, false, &list_) != RMW_RET_OK) rmw_reset_error();
  }
  ~Endpoints() {
    if (rmw_topic_endpoint_info_array_fini(&list_, &allocator_) != RMW_RET_OK) rmw_reset_error();
  }
  Endpoints(const Endpoints&) = delete;
  Endpoints& operator=(const Endpoints&) = delete;
  const rmw_topic_endpoint_info_t* begin() const { return list_.info_array; }
  const rmw_topic_endpoint_info_t* end() const { return list_.info_array + list_.size; }

 private:
  rcutils_allocator_t allocator_ = rcutils_get_default_allocator();
  rmw_topic_endpoint_info_array_t list_ = rmw_get_zero_initialized_topic_endpoint_info_array();
};

bool can_match(const rmw_qos_profile_t& publisher, const rmw_qos_profile_t& subscription) {
  return !(publisher.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT &&
           subscription.reliability == RMW_QOS_POLICY_RELIABILITY_RELIABLE) &&
         !(publisher.durability == RMW_QOS_POLICY_DURABILITY_VOLATILE &&
           subscription.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
}

}  // namespace

bool is_cyclonedds() {
  static const bool is = std::strcmp(rmw_get_implementation_identifier(), "rmw_cyclonedds_cpp") == 0;
  return is;
}

bool may_be_repeated(const rmw_message_info_t& info) {
  const std::uint8_t* const vendor = info.publisher_gid.data;  // the first two bytes of a GUID
  return !is_cyclonedds() && vendor[0] == 1 && vendor[1] == 16;
}

Source Writers::of(const rmw_subscription_t* subscription, const rmw_message_info_t& info) {
  if (!is_cyclonedds()) return source_of_guid(info.publisher_gid.data);
  std::uint64_t writer = 0;
  std::memcpy(&writer, info.publisher_gid.data, sizeof writer);
  Source& source = known_[{subscription->data, writer}];
  if (source == 0) source = of_matched_writer(subscription, writer);
  return source;
}

Source own_source(const rmw_node_t* node, const char* topic) {
  for (const auto& endpoint : Endpoints(rmw_get_publishers_info_by_topic, node, topic)) {
    if (std::strcmp(endpoint.node_name, node->name) == 0) return source_of_guid(endpoint.endpoint_gid);
  }
  return 0;
}

bool has_matched(const rmw_node_t* node, const rmw_publisher_t* publisher, Source source) {
  rmw_qos_profile_t qos;
  std::size_t matched = 0, known = 0;
  if (rmw_publisher_get_actual_qos(publisher, &qos) != RMW_RET_OK) return false;
  bool found = false;
  for (const auto& endpoint : Endpoints(rmw_get_subscriptions_info_by_topic, node, publisher->topic_name)) {
    if (!can_match(qos, endpoint.qos_profile)) continue;
    ++known;
    found = found || source_of_guid(endpoint.endpoint_gid) == source;
  }
  return found && rmw_publisher_count_matched_subscriptions(publisher, &matched) == RMW_RET_OK && matched >= known;
}

bool has_matched(const rmw_node_t* node, const rmw_subscription_t* subscription, Source source) {
  rmw_qos_profile_t qos;
  std::size_t matched = 0, known = 0;
  if (rmw_subscription_get_actual_qos(subscription, &qos) != RMW_RET_OK) return false;
  bool found = false;
  for (const auto& endpoint : Endpoints(rmw_get_publishers_info_by_topic, node, subscription->topic_name)) {
    if (!can_match(endpoint.qos_profile, qos)) continue;
    ++known;
    found = found || source_of_guid(endpoint.endpoint_gid) == source;
  }
  return found && rmw_subscription_count_matched_publishers(subscription, &matched) == RMW_RET_OK && matched >= known;
}

bool publishes(const rmw_node_t* node, const char* topic, Source source) {
  for (const auto& endpoint : Endpoints(rmw_get_publishers_info_by_topic, node, topic)) {
    if (source_of_guid(endpoint.endpoint_gid) == source) return true;
  }
  return false;
}

}  // namespace skein_ros
