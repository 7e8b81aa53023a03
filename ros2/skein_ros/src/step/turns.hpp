// The node's thread between its work and the lock-step: a step ends when the node has nothing left to do in it.
#pragma once

#include <cstdint>

#include "member.hpp"

namespace skein_ros {

/// The process's member; nullptr: this process is no program of a fleet.
Member* member();

/// True in the thread that the node waits in, while it runs the node's own code.
bool in_node_code();
/// From now on this thread is in it.
void enter_node_code();

/// Simulated time for every clock of ROS; false: there is none, ask the real clock.
bool simulated_now(std::int64_t* now_ns);

/// Sleeps until this simulated time: steps are answered meanwhile. False: the run is over, or there is none.
bool sleep_until_simulated(std::int64_t until_ns);

/// Something has happened in the step: a timer was called, a sample taken, a message published.
void note_work();
/// A timer was called.
void note_timer();

/// The thread that calls it is the node's, or it ends the process: `what` it did in which other.
void require_node_thread(const char* what);

/// rmw_wait() of a node in the lock-step.
rmw_ret_t wait_in_step(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guards, rmw_services_t* services,
                       rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                       const rmw_time_t* timeout);

}  // namespace skein_ros
