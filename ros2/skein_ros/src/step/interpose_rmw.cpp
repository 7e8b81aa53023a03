// The rmw functions that a node in the lock-step calls instead of those of its middleware (docs/decisions/0037).
// LD_PRELOAD loads this library before the middleware, so it works for C++ and Python, and with any middleware.
#include <rmw/rmw.h>

#include <cstring>

#include "endpoints.hpp"
#include "leaving.hpp"
#include "turns.hpp"

namespace {

using skein_ros::Counterpart;
using skein_ros::Incoming;
using skein_ros::Member;
using skein_ros::member;
using skein_ros::Outgoing;
using skein_ros::Sample;

bool steps() { return member() != nullptr && member()->is_open(); }

Incoming* incoming_of(const rmw_subscription_t* subscription) {
  if (!steps()) return nullptr;
  for (const auto& incoming : member()->incomings()) {
    if (incoming->subscription() == subscription) return incoming.get();
  }
  return nullptr;
}

Outgoing* outgoing_of(const rmw_publisher_t* publisher) {
  if (!steps()) return nullptr;
  for (const auto& outgoing : member()->outgoings()) {
    if (outgoing->publisher() == publisher) return outgoing.get();
  }
  return nullptr;
}

/// On a topic that the fleet counts, holds the message until the end of the step; on any other, sends it at once. The
/// process's own uncounted subscriptions receive it first: they get the process's messages in order, and no others.
rmw_ret_t publish(Outgoing& out, std::vector<std::uint8_t> bytes) {
  skein_ros::require_node_thread(("publishes on " + out.topic()).c_str());
  skein_ros::note_work();
  const bool counted = out.counterpart() != Counterpart::none;
  for (const auto& incoming : member()->incomings()) {
    if (incoming->counterpart() == Counterpart::none && incoming->topic() == out.topic()) incoming->hand({bytes});
  }
  if (counted) {
    out.hold(std::move(bytes));
    return RMW_RET_OK;
  }
  const rmw_serialized_message_t view = skein_ros::view_of(bytes);
  return SKEIN_REAL(rmw_publish_serialized_message)(out.publisher(), &view, nullptr);
}

rmw_ret_t take_into(Incoming& in, void* message, bool* taken, rmw_message_info_t* info) {
  *taken = in.has_sample();
  if (!*taken) return RMW_RET_OK;
  skein_ros::note_work();
  const Sample sample = in.take();
  if (info != nullptr) *info = sample.info;
  if (in.codec().decode(sample.bytes, message)) return RMW_RET_OK;
  RMW_SET_ERROR_MSG(("no message of the type of " + in.topic()).c_str());
  return RMW_RET_ERROR;
}

rmw_ret_t take_bytes(Incoming& in, rmw_serialized_message_t* message, bool* taken, rmw_message_info_t* info) {
  *taken = in.has_sample();
  if (!*taken) return RMW_RET_OK;
  skein_ros::note_work();
  const Sample sample = in.take();
  if (info != nullptr) *info = sample.info;
  if (message->buffer_capacity < sample.bytes.size() &&
      rmw_serialized_message_resize(message, sample.bytes.size()) != RMW_RET_OK) {
    return RMW_RET_BAD_ALLOC;
  }
  std::memcpy(message->buffer, sample.bytes.data(), sample.bytes.size());
  message->buffer_length = sample.bytes.size();
  return RMW_RET_OK;
}

bool refused(const Member::Role& role) {
  if (role.refusal.empty()) return false;
  skein_ros::say("refused: " + role.refusal);
  RMW_SET_ERROR_MSG(("not in the lock-step: " + role.refusal).c_str());
  return true;
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

rmw_node_t* rmw_create_node(rmw_context_t* context, const char* name, const char* name_space) {
  if (member() != nullptr && !member()->is_open()) {
    member()->open(context);
    skein_ros::enter_node_code();
  }
  return SKEIN_REAL(rmw_create_node)(context, name, name_space);
}

rmw_ret_t rmw_shutdown(rmw_context_t* context) {
  if (member() != nullptr) member()->interrupt();
  return SKEIN_REAL(rmw_shutdown)(context);
}

rmw_ret_t rmw_context_fini(rmw_context_t* context) {
  if (steps()) member()->close(context);
  return SKEIN_REAL(rmw_context_fini)(context);
}

rmw_publisher_t* rmw_create_publisher(const rmw_node_t* node, const rosidl_message_type_support_t* type,
                                      const char* topic, const rmw_qos_profile_t* qos,
                                      const rmw_publisher_options_t* options) {
  if (!steps() || qos == nullptr || topic == nullptr) {
    return SKEIN_REAL(rmw_create_publisher)(node, type, topic, qos, options);
  }
  const Member::Role role = member()->role_of_writing(topic);
  if (refused(role)) return nullptr;
  const bool counted = role.counterpart != Counterpart::none;
  const rmw_qos_profile_t used = counted ? skein_ros::writer_qos(role.depth, false) : *qos;
  rmw_publisher_t* const made = SKEIN_REAL(rmw_create_publisher)(node, type, topic, &used, options);
  if (made == nullptr) return nullptr;
  made->can_loan_messages = false;
  member()->add(std::make_unique<Outgoing>(made, type, role.counterpart, role.depth));
  return made;
}

rmw_ret_t rmw_destroy_publisher(rmw_node_t* node, rmw_publisher_t* publisher) {
  if (const Outgoing* const out = outgoing_of(publisher)) {
    // The lock-step still counts its samples, so the publisher stays until the run is over.
    if (out->counterpart() != Counterpart::none && member()->has_declared() && !member()->is_over()) return RMW_RET_OK;
    member()->remove(*out);
  }
  return SKEIN_REAL(rmw_destroy_publisher)(node, publisher);
}

rmw_ret_t rmw_publish(const rmw_publisher_t* publisher, const void* message, rmw_publisher_allocation_t* allocation) {
  Outgoing* const out = outgoing_of(publisher);
  if (out == nullptr) return SKEIN_REAL(rmw_publish)(publisher, message, allocation);
  try {
    return publish(*out, out->codec().encode(message));
  } catch (const std::exception& error) {
    RMW_SET_ERROR_MSG(error.what());
    return RMW_RET_ERROR;
  }
}

rmw_ret_t rmw_publish_serialized_message(const rmw_publisher_t* publisher, const rmw_serialized_message_t* message,
                                         rmw_publisher_allocation_t* allocation) {
  Outgoing* const out = outgoing_of(publisher);
  if (out == nullptr) return SKEIN_REAL(rmw_publish_serialized_message)(publisher, message, allocation);
  return publish(*out, {message->buffer, message->buffer + message->buffer_length});
}

rmw_subscription_t* rmw_create_subscription(const rmw_node_t* node, const rosidl_message_type_support_t* type,
                                            const char* topic, const rmw_qos_profile_t* qos,
                                            const rmw_subscription_options_t* options) {
  if (!steps() || qos == nullptr || topic == nullptr) {
    return SKEIN_REAL(rmw_create_subscription)(node, type, topic, qos, options);
  }
  const Member::Role role = member()->role_of_reading(topic);
  if (refused(role)) return nullptr;
  const bool counted = role.counterpart != Counterpart::none;
  const rmw_qos_profile_t used = counted ? skein_ros::reader_qos(role.depth, role.latched) : *qos;
  rmw_subscription_t* const made = SKEIN_REAL(rmw_create_subscription)(node, type, topic, &used, options);
  if (made == nullptr) return nullptr;
  made->can_loan_messages = false;
  member()->add(std::make_unique<Incoming>(made, type, role.counterpart, role.depth, role.latched));
  return made;
}

rmw_ret_t rmw_destroy_subscription(rmw_node_t* node, rmw_subscription_t* subscription) {
  if (const Incoming* const in = incoming_of(subscription)) {
    if (in->counterpart() != Counterpart::none && member()->has_declared() && !member()->is_over()) return RMW_RET_OK;
    member()->remove(*in);
  }
  return SKEIN_REAL(rmw_destroy_subscription)(node, subscription);
}

rmw_ret_t rmw_take(const rmw_subscription_t* subscription, void* message, bool* taken,
                   rmw_subscription_allocation_t* allocation) {
  if (Incoming* const in = incoming_of(subscription)) return take_into(*in, message, taken, nullptr);
  return SKEIN_REAL(rmw_take)(subscription, message, taken, allocation);
}

rmw_ret_t rmw_take_with_info(const rmw_subscription_t* subscription, void* message, bool* taken,
                             rmw_message_info_t* info, rmw_subscription_allocation_t* allocation) {
  if (Incoming* const in = incoming_of(subscription)) return take_into(*in, message, taken, info);
  return SKEIN_REAL(rmw_take_with_info)(subscription, message, taken, info, allocation);
}

rmw_ret_t rmw_take_sequence(const rmw_subscription_t* subscription, size_t count, rmw_message_sequence_t* messages,
                            rmw_message_info_sequence_t* infos, size_t* taken,
                            rmw_subscription_allocation_t* allocation) {
  Incoming* const in = incoming_of(subscription);
  if (in == nullptr) return SKEIN_REAL(rmw_take_sequence)(subscription, count, messages, infos, taken, allocation);
  for (*taken = 0; *taken < count; ++*taken) {
    bool one = false;
    const rmw_ret_t result = take_into(*in, messages->data[*taken], &one, &infos->data[*taken]);
    if (result != RMW_RET_OK) return result;
    if (!one) break;
  }
  messages->size = infos->size = *taken;
  return RMW_RET_OK;
}

rmw_ret_t rmw_take_serialized_message(const rmw_subscription_t* subscription, rmw_serialized_message_t* message,
                                      bool* taken, rmw_subscription_allocation_t* allocation) {
  if (Incoming* const in = incoming_of(subscription)) return take_bytes(*in, message, taken, nullptr);
  return SKEIN_REAL(rmw_take_serialized_message)(subscription, message, taken, allocation);
}

rmw_ret_t rmw_take_serialized_message_with_info(const rmw_subscription_t* subscription,
                                                rmw_serialized_message_t* message, bool* taken,
                                                rmw_message_info_t* info, rmw_subscription_allocation_t* allocation) {
  if (Incoming* const in = incoming_of(subscription)) return take_bytes(*in, message, taken, info);
  return SKEIN_REAL(rmw_take_serialized_message_with_info)(subscription, message, taken, info, allocation);
}

rmw_ret_t rmw_wait(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guards, rmw_services_t* services,
                   rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set, const rmw_time_t* timeout) {
  // The threads of rclcpp that watch the graph wait only for guard conditions.
  const bool nodes = (subscriptions != nullptr && subscriptions->subscriber_count > 0) ||
                     (services != nullptr && services->service_count > 0) || skein_ros::in_node_code();
  if (!steps() || !nodes) {
    return SKEIN_REAL(rmw_wait)(subscriptions, guards, services, clients, events, wait_set, timeout);
  }
  skein_ros::require_node_thread("waits");
  return skein_ros::wait_in_step(subscriptions, guards, services, clients, events, wait_set, timeout);
}

rmw_client_t* rmw_create_client(const rmw_node_t* node, const rosidl_service_type_support_t* type, const char* service,
                                const rmw_qos_profile_t* qos) {
  if (steps()) {
    skein_ros::say_once(
        std::string("a client of the service ") + service +
        ": services are not in the lock-step; a call is refused, and waiting for the service is in vain");
  }
  return SKEIN_REAL(rmw_create_client)(node, type, service, qos);
}

rmw_ret_t rmw_send_request(const rmw_client_t* client, const void* request, int64_t* sequence) {
  if (!steps()) return SKEIN_REAL(rmw_send_request)(client, request, sequence);
  skein_ros::fail(std::string("refused: a call of the service ") + client->service_name +
                  ": services are not in the lock-step (docs/ros2.md)");
}

rmw_ret_t rmw_service_server_is_available(const rmw_node_t* node, const rmw_client_t* client, bool* is_available) {
  if (!steps()) return SKEIN_REAL(rmw_service_server_is_available)(node, client, is_available);
  *is_available = false;
  return RMW_RET_OK;
}

}  // extern "C"
#pragma GCC visibility pop
