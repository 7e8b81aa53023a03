// Words in the tables of a run's folder that one program writes and another one interprets (all: docs/results.md).
#pragma once

namespace skein::run_tables {

/// The first columns of trajectories.csv.
inline constexpr const char* kPoseColumns = "time_s,uav,x,y,z,qw,qx,qy,qz,";

/// All columns of activity.csv.
inline constexpr const char* kActivityColumns = "step,time_s,uav,mode,goal_x,goal_y,goal_z,waits_for,no_way";

/// Events of events.csv.
inline constexpr const char* kJoined = "joined";
inline constexpr const char* kLeft = "left";
inline constexpr const char* kLinkUp = "link_up";
inline constexpr const char* kLinkDown = "link_down";
inline constexpr const char* kCaptured = "captured";
inline constexpr const char* kReleased = "released";

/// Why a capture does not count, in captures.csv.
inline constexpr const char* kUavCollided = "uav collided";

}  // namespace skein::run_tables
