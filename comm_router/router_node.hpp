// The router as a process: reads every radio topic in every node's domain, and delivers the messages that the links let
// through. It forwards serialised payloads and needs no type of radio message.   Threads: one.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/inbox.hpp"
#include "bus/lockstep/client_node.hpp"
#include "bus/lockstep/patience.hpp"
#include "bus/lockstep/strangers.hpp"
#include "comm_router/arrivals_node.hpp"
#include "comm_router/count_store.hpp"
#include "comm_router/link_gate.hpp"
#include "comm_router/radio_registry.hpp"
#include "comm_router/recording_node.hpp"
#include "comm_router/replay_node.hpp"
#include "comm_router/router_sync.hpp"
#include "core/faults/fault_plan.hpp"
#include "core/scenario/scenario.hpp"

namespace skein::router {

/// How long the fleet waits, by a wall clock, for a member that registers a topic and has no fitting endpoint for it.
/// Discovery takes milliseconds, so after this time the member has made a mistake: the router refuses its request. As
/// the endpoint might match in time in another run, the server marks the run as not repeatable.
inline constexpr double kMatchPatience_s = 10.0;
/// After this wall time the router tells the server which members it waits for. Messages that are merely under way
/// arrive sooner.
inline constexpr double kWordPatience_s = 1.0;

class RouterNode final : public bus::ClientNode {
 public:
  /// @param seed    of the run: links that are not ideal draw their random numbers from it.
  /// @param faults  what goes wrong with the links, and when.
  /// @param out     folder for capture_messages.csv (link_record.hpp); empty: it is not written.
  RouterNode(const Scenario& scenario, std::uint64_t seed, int base_domain, bus::Bus& bus, const FaultPlan& faults = {},
             const std::filesystem::path& out = {});

  bus::Inbox& inbox() override { return inbox_; }
  /// For tests: replaces how this program carries out the order of a fault (kill or stop).
  void obey_with(std::function<void(bus::LockstepClient::Order)> obey) { client_.obey_with(std::move(obey)); }
  /// For tests that may not let time pass. The default values are the constants above.
  void set_patience(double match_s, double word_s);
  std::string waiting_for() override;
  /// Continues from the counts in the store, and saves the counts there from now on. `store` must outlive this.
  void keep_counts(CountStore& store);
  /// Before start(): records the messages that the router takes and delivers. `recorder` must outlive this.
  void record_with(recording::Recorder& recorder);
  /// Before start(): UAVs whose agents relay messages of programs outside the lock-step.
  void expect_stand_ins(const std::vector<std::string>& uavs) { stand_ins_ = {uavs.begin(), uavs.end()}; }
  /// Before start(): delivers the messages of a recorded run instead of those of now. @throws InputError as ReplayNode.
  void replay(const recording::ReplayOptions& options);
  /// Where members send other messages than in the recorded run, a sentence each; nullopt: this is not a replay.
  std::optional<std::vector<std::string>> differences() const;
  const LinkGate& gate() const { return gate_; }
  /// For the end of a run: the number of radio messages from outside the lock-step, and their senders, a line each.
  std::uint64_t unheard() const;
  std::vector<std::string> warnings() const { return warnings_; }
  /// Number of received samples that were not messages of their topic's type.
  std::uint64_t malformed() const { return inbox_.malformed(); }
  /// Number of samples that could not be sent.
  std::uint64_t unsent() const { return world_->unsent().count(); }
  /// Files that the disk refused, one sentence each.
  const std::vector<std::string>& unwritten() const { return unwritten_; }

 private:
  bus::LockstepClient& client() override { return client_; }
  void think() override { begin_step(); }
  bool serve() override;
  std::size_t rings() override;
  bool answered_last() const override { return last_step_answered_; }

  /// Readers of `ready` and `done` in a node's domain. The station has topics of its own (bus/lockstep/names.hpp).
  struct Door {
    Node node = kStationNode;
    std::unique_ptr<bus::Reader> ready, done;
  };

  /// A participant that has asked to attach its radio topics; it stays here when they are attached.
  struct Applicant {
    std::string member;
    Node node = kStationNode;
    std::size_t door = 0;
    std::uint32_t revision = 0;
    std::vector<std::string> reads, writes;
    bool attached = false;
  };

  void open_door(Node node, std::string_view member);
  /// Whether the sample's writer was never attached. Then the sample is counted, and not delivered.
  bool from_stranger(Node node, const std::string& topic, bus::ParticipantId source);
  void tell_of_strangers(std::uint64_t patience);
  void tell_of_excesses();
  void open_radio();
  void open_requests(Node node);
  void open_route(std::size_t number);
  void close_route(std::size_t number);
  RadioEndpoints endpoints();
  std::vector<RadioRequest> read_requests(const StepBatch& batch);
  void on_ready(std::size_t door, const msg::Ready& ready, bus::ParticipantId source);
  /// Attaches the applicants whose topics have all matched. @returns true while some are not attached yet.
  bool attach();
  /// Takes and delivers all complete steps. @returns true while it waits for matches.
  bool advance();
  /// A topic of the applicant that is not matched with its participant `source` yet; empty: all are.
  std::string unmatched(const Applicant& applicant, bus::ParticipantId source) const;
  /// Tells the server which members the router waits for, once it has waited for a while, and then at each change.
  void tell_awaited(bool waits);
  std::vector<msg::Await> awaited() const;
  void begin_step();
  void deliver(const StepBatch& batch);
  void reply();

  const Scenario& scenario_;
  RadioTable table_;
  std::vector<std::string> unwritten_;
  LinkGate gate_;
  const std::size_t declared_routes_;  ///< number of the scenario's routes, which come first
  RouterSync sync_;
  RadioRegistry registry_;
  CountStore* count_store_ = nullptr;
  std::optional<RecordingNode> recording_;
  std::unique_ptr<ReplayNode> replay_;
  bus::Strangers strangers_;
  std::set<std::string> stand_ins_, present_;  ///< UAVs; members of this step
  std::vector<std::string> warnings_;
  std::vector<std::string> by_hand_;  ///< faults by hand, from the last step
  std::uint64_t k_ = 0;               ///< the step that was begun last
  bus::Inbox inbox_;
  std::unique_ptr<bus::Participant> world_;
  Arrivals::Participants nodes_;
  bus::LockstepClient client_;
  std::unique_ptr<bus::Reader> drop_reader_;
  std::vector<Door> doors_;
  std::vector<std::unique_ptr<bus::Reader>> request_readers_;  ///< by node
  std::vector<std::unique_ptr<bus::Reader>> radio_readers_;    ///< by route; null: closed again
  Arrivals arrivals_;
  std::optional<StepBatch> batch_;               ///< while its registrations wait for matches
  bus::Patience match_patience_{0.0};            ///< timeout for these matches
  std::optional<bus::Patience> word_patience_;   ///< running while the router waits; over: it tells the server
  std::optional<std::vector<msg::Await>> told_;  ///< what the router has told the server in this step
  std::optional<msg::Routed> last_routed_;
  std::map<bus::ParticipantId, Applicant> applicants_;
  std::optional<std::uint64_t> last_k_;  ///< of the final step
  double match_patience_s_ = kMatchPatience_s, word_patience_s_ = kWordPatience_s;
  bool radio_open_ = false, last_step_answered_ = false;
};

}  // namespace skein::router
