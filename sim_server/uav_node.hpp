// The server's end of one UAV's domain: publishes the data of the UAV's sensors, and takes its commands.
// Frames: W world, B body, `told` (sensors/detection_log.hpp).   Units: SI, radians.   Threads: one.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/server.hpp"
#include "core/messages/activity.hpp"
#include "idl/conversions.hpp"
#include "sim_server/sensors/detection_log.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

/// The message nbr_odom_cloud: position (of UAVs: odometry) of each node with an open link to `node` at this step.
msg::PointCloud2 neighbour_cloud(const Simulation& simulation, const Scenario& scenario, Node node);

/// The key frames of a step as other UAVs receive them: each is encoded once, however many UAVs receive it.
class HeardKeyFrames {
 public:
  /// @param event  index in this step's events().key_frames. @returns the message, valid until the next step.
  std::span<const std::uint8_t> payload(const Simulation& simulation, std::size_t event);

 private:
  std::optional<std::uint64_t> step_;
  std::vector<std::vector<std::uint8_t>> payloads_;  ///< empty: not encoded yet
};

class UavNode {
 public:
  /// Declares all topics of UAV `uav` in `domain`. `simulation` gets the UAV's commands when a step is answered.
  /// @param heard  shared by all UAVs' nodes.
  UavNode(UavIndex uav, const Scenario& scenario, Simulation& simulation, HeardKeyFrames& heard,
          bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain);

  /// Makes the simulation compute the next step's scan if a program reads it. Call it when the members of that step are
  /// known, and before it is simulated: so a program that has just joined gets its first scan, whether or not DDS still
  /// counts its dead predecessor as a reader. @param shown  a viewer wants to see the scan.
  void choose_scans(bool shown = false);
  /// Publishes the samples of the present step.
  void publish();
  /// Commands on this topic come from outside the lock-step: the next publish() says that they are ignored.
  void reject_unheard(const std::string& topic) { unheard_.push_back(topic); }
  /// The agent is new: the next publish() repeats all reports that were never acknowledged, and all detected points.
  void resend_captures() { resend_ = true; }
  /// A program has announced itself: reads its debug values and activity from now on. @param writes  topics that the
  /// program will write.
  void read_debug(const std::vector<std::string>& writes);
  /// Debug values that the program has published since the last call: name, value.
  std::vector<std::pair<std::string, double>> take_debug() { return std::exchange(debug_, {}); }
  /// The last activity that the program has published since the last call; nullopt: none.
  std::optional<Activity> take_activity() { return std::exchange(activity_, std::nullopt); }
  /// Captures that the agent has released since the last call, because the station has acknowledged them.
  std::vector<std::uint64_t> take_released() { return std::exchange(released_, {}); }

 private:
  void publish_state();
  void publish_neighbours();
  LinkQualities link_qualities() const;
  void publish_clouds();
  void publish_captures();
  void publish_detections();
  void publish_rejections();
  void warn_of_unread_debug(const std::string& topic) const;

  UavIndex uav_;
  const Scenario& scenario_;
  Simulation& simulation_;
  bus::LockstepServer& server_;
  const bus::LockstepServer::DomainIndex domain_;
  HeardKeyFrames& heard_;
  const std::string& id_;
  std::vector<std::string> fleet_;
  bus::CountedWriter &odometry_, &gimbal_, &neighbour_odometry_, &neighbour_keyframe_, &detected_points_, &detected_,
      &remained_, &clock_, &boxes_, &rejected_, &capture_;
  bus::CountedWriter *cloud_ = nullptr, *servo_ = nullptr, *self_keyframe_ = nullptr;  ///< explorers only
  bus::CountedWriter *battery_ = nullptr, *wind_ = nullptr, *radio_links_ = nullptr;   ///< if conditions have them
  DetectionLog detections_;
  std::map<std::uint64_t, CaptureReport> card_;  ///< reports, as told to the agent, that it has not released
  std::vector<std::uint64_t> released_;
  std::set<std::string> debug_names_;  ///< debug values that are read
  bool warned_of_debug_ = false;       ///< of the first one that is not
  std::vector<std::pair<std::string, double>> debug_;
  bool reads_activity_ = false;
  std::optional<Activity> activity_;
  std::vector<std::string> unheard_;  ///< topics for reject_unheard()
  bool resend_ = false, boxes_sent_ = false;
};

}  // namespace skein::sim
