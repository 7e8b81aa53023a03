// Creates the endpoints of the lock-step itself, and sends and receives typed messages through them.
#pragma once

#include <rmw/rmw.h>
#include <rosidl_typesupport_cpp/message_type_support.hpp>

#include <string>

#include "channels.hpp"
#include "lockstep_qos.hpp"
#include "real_rmw.hpp"
#include "say.hpp"

namespace skein_ros {

template <class Message>
const rosidl_message_type_support_t* type_of() {
  return rosidl_typesupport_cpp::get_message_type_support_handle<Message>();
}

template <class Message>
rmw_subscription_t* subscribe(const rmw_node_t* node, const std::string& topic, int depth, bool latched) {
  const rmw_qos_profile_t qos = reader_qos(depth, latched);
  const rmw_subscription_options_t options = rmw_get_default_subscription_options();
  rmw_subscription_t* const made =
      SKEIN_REAL(rmw_create_subscription)(node, type_of<Message>(), topic.c_str(), &qos, &options);
  if (made == nullptr) fail("no subscription to " + topic + ": " + rmw_get_error_string().str);
  return made;
}

template <class Message>
rmw_publisher_t* advertise(const rmw_node_t* node, const std::string& topic, int depth, bool latched) {
  const rmw_qos_profile_t qos = writer_qos(depth, latched);
  const rmw_publisher_options_t options = rmw_get_default_publisher_options();
  rmw_publisher_t* const made =
      SKEIN_REAL(rmw_create_publisher)(node, type_of<Message>(), topic.c_str(), &qos, &options);
  if (made == nullptr) fail("no publisher on " + topic + ": " + rmw_get_error_string().str);
  return made;
}

template <class Message>
void publish(rmw_publisher_t* publisher, const Message& message) {
  send_heartbeat(publisher);
  if (SKEIN_REAL(rmw_publish)(publisher, &message, nullptr) != RMW_RET_OK) {
    fail(std::string("cannot publish on ") + publisher->topic_name + ": " + rmw_get_error_string().str);
  }
}

/// @returns false if there is no message
template <class Message>
bool take(rmw_subscription_t* subscription, Message& message, rmw_message_info_t& info) {
  bool taken = false;
  info = rmw_get_zero_initialized_message_info();
  if (SKEIN_REAL(rmw_take_with_info)(subscription, &message, &taken, &info, nullptr) != RMW_RET_OK) rmw_reset_error();
  return taken;
}

/// @returns false if the sample is no such message
template <class Message>
bool read(const Sample& sample, Message& message) {
  static const Codec codec(type_of<Message>());
  return codec.decode(sample.bytes, &message);
}

}  // namespace skein_ros
