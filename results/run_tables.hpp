// Words in the tables of a run's folder that one program writes and another one interprets (all: docs/results.md).
// Programs of a fleet write some tables while they fly. The columns of these tables are here, beside their readers
// (run_rows.hpp).
#pragma once

namespace skein::run_tables {

/// The first columns of trajectories.csv.
inline constexpr const char* kPoseColumns = "time_s,uav,x,y,z,qw,qx,qy,qz,";
/// The columns after these; kChargeColumn follows if the scenario has batteries.
inline constexpr const char* kMotionColumns = "vx,vy,vz,gimbal_pitch,gimbal_yaw,alive,clearance";
inline constexpr const char* kChargeColumn = ",charge";

// All columns of the table of this name.
inline constexpr const char* kActivityColumns = "step,time_s,uav,mode,goal_x,goal_y,goal_z,waits_for,no_way";
inline constexpr const char* kEventColumns = "step,time_s,event,subject,object";
inline constexpr const char* kCaptureColumns =
    "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason";
inline constexpr const char* kScoreTimelineColumns = "time_s,points,score";
inline constexpr const char* kCaptureMessageColumns = "step,uav,arrives";

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
