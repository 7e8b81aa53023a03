// The router as a process: hears every radio topic in every node's domain, lets through what the links allow.
// It moves serialised payloads and knows no type. Everything happens on the thread that calls run().
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_loop.hpp"
#include "comm_router/link_gate.hpp"
#include "comm_router/router_sync.hpp"
#include "core/fault_plan.hpp"
#include "core/scenario.hpp"

namespace skein::router {

class RouterNode {
 public:
  /// @param seed    of the run: what links that are not ideal draw from.
  /// @param faults  what goes wrong with the links, and when.
  RouterNode(const Scenario& scenario, std::uint64_t seed, int base_domain, bus::Bus& bus, const FaultPlan& faults = {});

  /// Takes part until the last step, or until asked to stop. @returns the program's exit code.
  int run(const StopSignal& stop);
  /// For a test that drives it event by event instead of run(): say hello, then poll() again and again. It does what
  /// run() would do by then, and nothing when run() would sleep.
  void start() { client_.start(); }
  void poll();
  /// Makes run() look at `stop`; from any thread.
  void wake() { inbox_.wake(); }
  const LinkGate& gate() const { return gate_; }
  /// Samples received that were no message of their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }

 private:
  /// One participant that wants its radio topics attached.
  struct Applicant {
    std::string member;
    Node node = kStationNode;
    std::uint32_t revision = 0;
    std::vector<std::string> reads, writes;
    bool attached = false;
  };

  /// One topic on which messages arrive at a node: all sources share it, so their order is one order.
  struct Arrival {
    Node node = kStationNode;
    std::string topic;
    std::unique_ptr<bus::CountedWriter> writer;
  };

  void open_radio();
  std::size_t find_or_open_arrival(const RadioTarget& target, const std::string& type);
  void on_ready(Node node, const msg::Ready& ready, bus::ParticipantId source);
  /// @returns true while somebody is not attached yet.
  bool attach();
  /// @returns true while it waits for matches.
  bool serve();
  /// For Inbox::dispatch(): how many rings there must be before it can do more than it did.
  std::size_t rings() const;
  bool endpoints_match(const Applicant& applicant, bus::ParticipantId source) const;
  void begin_step();
  void deliver(const StepBatch& batch);

  const Scenario& scenario_;
  LinkGate gate_;
  RouterSync sync_;
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> world_;
  std::vector<std::unique_ptr<bus::Participant>> nodes_;
  bus::LockstepClient client_;
  std::unique_ptr<bus::Reader> drop_reader_;
  std::vector<std::unique_ptr<bus::Reader>> done_readers_, ready_readers_;  ///< by node
  std::vector<std::unique_ptr<bus::Reader>> radio_readers_;                 ///< by route
  std::vector<Arrival> arrivals_;
  std::vector<std::vector<std::size_t>> arrival_of_;  ///< by route, target: index into arrivals_
  std::map<bus::ParticipantId, Applicant> applicants_;
  std::optional<std::uint64_t> last_k_;  ///< of the final step
  bool radio_open_ = false, attaching_ = false, last_step_answered_ = false;
};

}  // namespace skein::router
