#include "skein_ros/step.h"

#include "say.hpp"
#include "turns.hpp"

bool skein_ros_is_member() { return skein_ros::member() != nullptr; }

void skein_ros_before_answer(void (*plan)(void*), void* context) {
  if (skein_ros::member() != nullptr) skein_ros::member()->before_answer([plan, context] { plan(context); });
}

bool skein_ros_sleep_until(int64_t until_ns) { return skein_ros::sleep_until_simulated(until_ns); }

void skein_ros_fail(const char* why) { skein_ros::fail(why); }
