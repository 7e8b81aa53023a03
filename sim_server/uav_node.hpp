// One UAV's domain at the server's end: publishes what its sensors say, takes its commands.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/lockstep/server.hpp"
#include "core/activity.hpp"
#include "idl/conversions.hpp"
#include "sim_server/sensors/detection_log.hpp"
#include "sim_server/simulation.hpp"

namespace skein::sim {

/// Who is linked to `node` at this step: nbr_odom_cloud.
msg::PointCloud2 neighbour_cloud(const Simulation& simulation, const Scenario& scenario, Node node);

/// The key frames of a step as those get them who hear their explorer: each is encoded once, however many they are.
class HeardKeyFrames {
 public:
  /// @param event  of this step's key frames. @returns what is valid until the next step.
  std::span<const std::uint8_t> payload(const Simulation& simulation, std::size_t event);

 private:
  std::optional<std::uint64_t> step_;
  std::vector<std::vector<std::uint8_t>> payloads_;  ///< empty: nobody asked yet
};

class UavNode {
 public:
  /// Declares all topics of UAV `uav` in `domain`. `simulation` gets its commands when a step is answered.
  /// @param heard  shared by all UAVs' nodes.
  UavNode(UavIndex uav, const Scenario& scenario, Simulation& simulation, HeardKeyFrames& heard,
          bus::LockstepServer& server, bus::LockstepServer::DomainIndex domain);

  /// Has the simulation compute the next step's scan if somebody reads it. To be called once those who take part in
  /// that step are known, and before it is simulated: the program that was let in just now gets its first scan, whether
  /// DDS still counts its dead predecessor as a reader or not. @param shown  who looks on wants it, too.
  void choose_scans(bool shown = false);
  /// Publishes the samples of the present step.
  void publish();
  /// Commands on this topic come from outside the lock-step: says so with the next publish().
  void reject_unheard(const std::string& topic) { unheard_.push_back(topic); }
  /// The agent is new: the camera hands out again whatever was never acknowledged, and all that it has shown.
  void resend_captures() { resend_ = true; }
  /// The program says hello: reads those of its topics that tell of itself.
  void read_debug(const std::vector<std::string>& writes);
  /// What it has told of itself since the last call: name, value.
  std::vector<std::pair<std::string, double>> take_debug() { return std::exchange(debug_, {}); }
  /// What it says that it does, since the last call; nullopt: nothing new.
  std::optional<Activity> take_activity() { return std::exchange(activity_, std::nullopt); }
  /// Captures that the agent has released since the last call: the station has them.
  std::vector<std::uint64_t> take_released() { return std::exchange(released_, {}); }

 private:
  void publish_state();
  void publish_neighbours();
  void publish_clouds();
  void publish_captures();
  void publish_detections();
  void publish_rejections();

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
  bus::CountedWriter *battery_ = nullptr, *wind_ = nullptr;  ///< if the scenario's conditions have them
  DetectionLog detections_;
  std::map<std::uint64_t, CaptureReport> card_;  ///< captures that the agent has not released, as it is told of them
  std::vector<std::uint64_t> released_;
  std::set<std::string> debug_names_;  ///< that are read
  std::vector<std::pair<std::string, double>> debug_;
  bool reads_activity_ = false;
  std::optional<Activity> activity_;
  std::vector<std::string> unheard_;  ///< topics
  bool resend_ = false, boxes_sent_ = false;
};

}  // namespace skein::sim
