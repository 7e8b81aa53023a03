// What the two programs of a strategy have in common, the one on board and the one at the ground station: a place in
// the lock-step, in one domain and no other.
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

  void start() override;
  bus::Inbox& inbox() override { return inbox_; }
  const std::string& member() const { return member_; }
  /// CPU time spent in the strategy so far, by exchange; without transport.
  const CpuHistogram& planner_cpu() const { return planner_cpu_; }
  /// Samples received that were no message of their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }
  /// Samples that could not be sent.
  std::uint64_t unsent() const { return bus_.unsent()->count(); }
  /// What it knows of the space around it, as a file that OctoMap reads; nullopt: it keeps no map.
  virtual std::optional<std::string> octomap_file() const { return std::nullopt; }
  /// Ends the file of its maps in time, where it keeps one. @returns what the disk refused of it, for people.
  virtual std::string end_maps() { return {}; }
  /// Why its strategy found no ways, and how often: a sentence for each reason.
  virtual std::vector<std::string> no_ways() const { return {}; }
  /// How long its strategy has waited for other UAVs [s]; nullopt: it flies none.
  virtual std::optional<double> waited_s() const { return std::nullopt; }
  /// When, and for whom.
  virtual std::optional<std::vector<WaitReport>> waits() const { return std::nullopt; }
  /// What ROS 2 nodes said that it stands in for; nullopt: it does not.
  virtual std::optional<std::vector<RelayedTopic>> from_nodes() const { return std::nullopt; }

 protected:
  /// @param member  name in the lock-step: a UAV's, or "gcs".
  MemberNode(bus::Bus& bus, int domain, std::string member)
      : bus_(bus), domain_(domain), member_(std::move(member)), inbox_(bus.run()) {}

  /// Declares what it reads and writes, each time that it joins; handlers may refer to this node.
  virtual void declare(bus::LockstepClient& client) = 0;
  /// One step of the strategy: all that was announced has been read.
  virtual void work(const bus::LockstepClient::Step& step) = 0;
  /// Sends what the step brought forth, and forgets the events of this step.
  virtual void send(bus::LockstepClient& client) = 0;
  /// For who looks on, when the step is answered. In no count, so that nobody waits for it.
  virtual void show() {}
  bus::Participant& participant() { return *participant_; }
  /// That is to be worked on, or was last.
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
