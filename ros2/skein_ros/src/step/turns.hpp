// Switches the node's thread between the node's own code and the lock-step: a step ends when the node has nothing left
// to do in it.
#pragma once

#include <cstdint>

#include "member.hpp"

namespace skein_ros {

/// This process as a member of the lock-step; nullptr: it is not a program of a fleet.
Member* member();

/// True if the calling thread is the node's, and runs the node's own code.
bool in_node_code();
/// From now on the calling thread runs the node's own code.
void enter_node_code();

/// The simulated time [ns]. @returns false if there is none: use the real clock
bool simulated_now(std::int64_t* now_ns);

/// Sleeps until this simulated time [ns], and answers steps meanwhile.
/// @returns false if the run is over, the context was shut down, or this process is not a member
bool sleep_until_simulated(std::int64_t until_ns);

/// The node has taken a sample or published a message: its polls are not idle.
void note_work();
/// A timer was called. Ends the process if that happens without end within one step.
void note_timer();

/// The first thread that calls this is the node's. A call from any other thread ends the process; the message names
/// that thread and `what` it does.
void require_node_thread(const char* what);

/// rmw_wait() of a node in the lock-step.
rmw_ret_t wait_in_step(rmw_subscriptions_t* subscriptions, rmw_guard_conditions_t* guards, rmw_services_t* services,
                       rmw_clients_t* clients, rmw_events_t* events, rmw_wait_set_t* wait_set,
                       const rmw_time_t* timeout);

}  // namespace skein_ros
