// Base class of the nodes of a strategy's programs, on board and at the ground station: membership in the lock-step, in
// a single domain.   Threads: the one that takes the node's turns.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_node.hpp"
#include "process/reports/reports.hpp"
#include "uav_agent/onboard/cpu_histogram.hpp"

namespace skein::agent {

class MemberNode : public bus::ClientNode {
 public:
  MemberNode(const MemberNode&) = delete;
  MemberNode& operator=(const MemberNode&) = delete;

  void start() override;  ///< Joins the domain, again after a fault stopped it, with a new participant.
  bus::Inbox& inbox() override { return inbox_; }
  const std::string& member() const { return member_; }
  /// CPU time of the strategy's work in each exchange so far; sending and receiving excluded.
  const CpuHistogram& planner_cpu() const { return planner_cpu_; }
  /// Number of samples received that could not be read as their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }
  /// Number of samples that could not be sent.
  std::uint64_t unsent() const { return bus_.unsent()->count(); }
  /// The node's map of space, as the bytes of a .bt file of OctoMap; nullopt: it keeps no map.
  virtual std::optional<std::string> octomap_file() const { return std::nullopt; }
  /// Closes the file of map snapshots (--keep-maps), if any. @returns a message if it could not be written; else empty.
  virtual std::string end_maps() { return {}; }
  /// Why the strategy found no path, and how often: one sentence for each reason.
  virtual std::vector<std::string> no_ways() const { return {}; }
  /// How long the strategy has waited for other UAVs [s]; nullopt: this node flies no UAV.
  virtual std::optional<double> waited_s() const { return std::nullopt; }
  /// Begin and end of each of these waits, and the UAV that it was for.
  virtual std::optional<std::vector<WaitReport>> waits() const { return std::nullopt; }
  /// What the flight core's safety filter counted; nullopt: no flight core flies this node's UAV.
  virtual std::optional<SafetyFilterReport> safety_filter() const { return std::nullopt; }
  /// CPU time of the parts of the strategy's work; nullopt: this node does not time them.
  virtual std::optional<std::vector<WorkPartReport>> planner_parts() const { return std::nullopt; }
  /// Topics relayed for the ROS 2 nodes that this node stands in for; nullopt: it stands in for none.
  virtual std::optional<std::vector<RelayedTopic>> from_nodes() const { return std::nullopt; }

 protected:
  /// @param member  name in the lock-step: a UAV's, or "gcs".
  MemberNode(bus::Bus& bus, int domain, std::string member)
      : bus_(bus), domain_(domain), member_(std::move(member)), inbox_(bus.run()) {}

  /// Declares the topics that the node reads and writes; called each time it joins. Handlers may refer to this node.
  virtual void declare(bus::LockstepClient& client) = 0;
  /// One step of the strategy. All samples announced for the step have been read before.
  virtual void work(const bus::LockstepClient::Step& step) = 0;
  /// Sends the results of the step, and clears the events of this step.
  virtual void send(bus::LockstepClient& client) = 0;
  /// Publishes data for viewers after the step is answered. Uncounted in the lock-step: no program waits for it.
  virtual void show() {}
  bus::Participant& participant() { return *participant_; }
  /// The current step, or the last one if none is in work.
  const bus::LockstepClient::Step& step() const { return client_->step(); }

 private:
  bus::LockstepClient& client() override { return *client_; }
  void think() override;
  bool answered_last() const override { return last_step_answered_; }
  bool rejoin() override { return true; }

  bus::Bus& bus_;
  const int domain_;
  const std::string member_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> participant_;
  std::optional<bus::LockstepClient> client_;
  bool last_step_answered_ = false;
  CpuHistogram planner_cpu_;
};

}  // namespace skein::agent
