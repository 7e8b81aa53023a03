// The server's side of the lock-step (docs/lockstep.md): it decides about membership and advances the clock.
// Event-driven. Between two steps it pauses while a program joins; within a step it waits for the answers of all
// members. Threads: all calls from the thread that dispatches the inbox.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>

#include "bus/lockstep/counted.hpp"
#include "bus/typed.hpp"
#include "idl/type_names.hpp"

namespace skein::bus {

class LockstepServer {
 public:
  /// Index of a domain that the server has joined. Index 0 is the world domain, in which the router is a member.
  using DomainIndex = std::size_t;

  struct StepInfo {
    std::uint64_t k = 0;
    std::int64_t tick = 0;
    std::vector<std::uint8_t> links;  ///< row-major link matrix (Links), published in the world domain only
    std::uint64_t ledger_upto = 0;
    bool final_step = false;
    std::vector<msg::FaultBegin> faults = {};      ///< in the world domain only
    std::vector<std::string> faults_by_hand = {};  ///< in the world domain only
  };
  struct LostMember {
    std::string name;
    std::uint64_t k = 0;
    std::string reason;
  };
  struct Awaited {
    std::string member;
    std::string what;  ///< what is missing, for people: "done of step 7", "rt/plan 3 of 4"
  };

  /// @param tap  listens to the samples of writer() and of read(); it must outlive this.
  explicit LockstepServer(Inbox& inbox, Tap* tap = nullptr) : inbox_(inbox), tap_(tap) {}

  /// @param node  radio node of the domain ("gcs" or a UAV's name); "" for the world domain.
  DomainIndex add_domain(const std::string& node, Participant& participant);
  /// Adds a place for a member, which may join only in this domain. @param awaited  the first step waits for it.
  void add_place(const std::string& member, DomainIndex domain, bool awaited);
  /// Adds a topic that the server writes; the steps in that domain announce its samples.
  CountedWriter& writer(DomainIndex domain, const TopicSpec& topic);
  /// Adds a topic that members in this domain write. `handler` gets its samples when the step is answered.
  void read(DomainIndex domain, const TopicSpec& topic, CountedQueues::Handler handler);
  /// The same for messages: `handler` gets (message); invalid samples are dropped and counted (typed.hpp).
  template <WireMessage Message, class Handler>
  void read(DomainIndex domain, const TopicSpec& topic, Handler handler) {
    read(domain, topic, decoding<Message>(inbox_, topic.name, std::move(handler)));
  }

  /// Sets a function that is called, inside dispatch(), for each ignored sample on a topic of read(): its writer has no
  /// place. The writer may just be joining or have left: see is_stranger().
  using OnStranger = std::function<void(DomainIndex, const std::string& topic, ParticipantId source)>;
  void on_stranger(OnStranger tell) { on_stranger_ = std::move(tell); }
  /// Sets a function that is called, inside dispatch(), when a program sends its hello in a domain, with the topics
  /// that it announces to write: the function may read() further ones.
  using OnHello = std::function<void(DomainIndex, const std::vector<std::string>& writes)>;
  void on_hello(OnHello tell) { on_hello_ = std::move(tell); }
  /// True for a participant that neither is or was a member nor has asked to join.
  bool is_stranger(ParticipantId source) const;

  /// Call it repeatedly at a boundary, that is between two steps: lets programs join. @returns true when no program is
  /// joining or awaited any more: publish() may follow.
  bool at_boundary();
  /// Writes a domain's samples of a step; they are sent together with the step.
  using WriteSamples = std::function<void(DomainIndex)>;
  /// Publishes a step domain by domain, so that members in the first domains compute while the last ones are written.
  /// @param write_samples  called once for each domain in turn, before its step is written.
  void publish(
      const StepInfo& info, const WriteSamples& write_samples = [](DomainIndex) {});
  /// @returns true, once, when all members have answered the published step; then the handlers of read() have run,
  /// domain by domain and member by member.
  bool answered();
  /// For Inbox::dispatch(), while answered() is false: each missing answer rings at least once.
  std::size_t rings() const;
  /// Call it while answered() is false and no samples arrive: repeats the step in domains where an answer is missing,
  /// because step or answer may have been lost when a lease expired. A member that has answered sends its answer again.
  /// Also notes members whose lease has expired: their samples may be lost, or come twice. If such a member is lost
  /// later, the reason says so.
  void ask_again();

  /// Call it at a boundary, before publish(): a fault removes this member from the run, and the following steps contain
  /// the order that it must execute. This does not count as a loss. Its place stays empty until let_back().
  /// @param order  kOrderKill or kOrderStop (names.hpp).
  /// @returns false, with no effect, when there is no such member.
  bool take_out(const std::string& member, std::string_view order);
  /// Call it at a boundary, when the fault is over: at_boundary() then waits until the member has joined again.
  /// @returns false when the member has been lost meanwhile.
  bool let_back(const std::string& member);

  /// A process died (says the launcher), hangs (time-out) or left: the server no longer waits for it.
  void lost(const std::string& member, const std::string& reason);
  /// For a fleet without a launcher that reports dead processes: members that have left, or are silent for longer than
  /// their lease (`--lease`), are lost.
  void drop_vanished();
  /// Members and joiners that are lost since the last call.
  std::vector<LostMember> take_lost();

  bool is_member(const std::string& name) const;
  /// Members that have joined since the last call, after a loss or a fault, and are members now. A program that was
  /// given up before it had joined is among them if it, or another under its name, joins later. If the caller also
  /// calls take_lost() now, those losses came before.
  std::vector<std::string> take_rejoined();
  /// Programs that have not answered, or not joined, without those that only wait for others; for messages and
  /// time-outs. Never empty while at_boundary() or answered() is false.
  std::vector<Awaited> awaited() const;
  /// The router's decisions since the last call that depended on a wall clock, and may differ in another run.
  std::vector<std::string> take_doubts();
  /// Digests of the last answered step: the router's of its deliveries, the station's of its tally changes.
  const std::vector<std::uint8_t>& routed_digest() const { return routed_digest_; }
  const std::vector<std::uint8_t>& station_digest() const { return station_digest_; }

 private:
  /// Readers of Ready and Done. Members of a domain share one door; the station has a door of its own (names.hpp).
  struct Door {
    std::unique_ptr<Reader> ready, done;
  };
  struct Domain {
    std::string node;
    Participant* participant = nullptr;
    std::unique_ptr<CountedWriter> step, resync;
    std::vector<Door> doors;
    std::vector<std::unique_ptr<CountedWriter>> writers;
    std::vector<std::uint64_t> announced;  ///< counts of `writers` that the members know
    bool newcomer = false;  ///< a program joined since the last step: it does not know the counts of latched topics
    msg::Step last;         ///< published
    std::vector<std::pair<std::string, std::unique_ptr<Reader>>> readers;
    CountedQueues commands;
  };
  struct Place {
    std::string name;
    DomainIndex domain = 0;
    std::size_t door = 0;
    bool awaited = false;  ///< at_boundary() waits for it
    bool member = false, was_member = false;
    bool was_lost = false;            ///< also when the server gave up a program that had not joined yet
    std::optional<msg::Order> order;  ///< set while a fault has taken the member out: a program that joins has to wait
    ParticipantId source = 0;         ///< of the member, or of a program that is joining
    bool invited = false, declared = false;
    std::vector<std::string> reads, writes;
    bool answered = false;
    bool unheard = false;                       ///< its lease expired during a step; it may be back since
    std::vector<CountedQueues::Expected> sent;  ///< by its last Done
    std::optional<std::pair<ParticipantId, msg::Ready>> next;  ///< a program that asked to join while it was taken
  };

  std::size_t open_door(DomainIndex domain, std::string_view member);
  const Door& door_of(const Place& place) const { return domains_[place.domain]->doors[place.door]; }
  void on_ready(DomainIndex domain, std::size_t door, const msg::Ready& ready, ParticipantId source);
  void on_done(DomainIndex domain, std::size_t door, const msg::Done& done, ParticipantId source);
  void on_routed(const msg::Routed& routed, ParticipantId source);
  void on_awaits(msg::Awaits& awaits, ParticipantId source);
  void take_ready(Place& place, ParticipantId source, const msg::Ready& ready);
  void invite(Place& place);
  bool endpoints_matched(const Place& place) const;
  bool attached_by_router(const Place& place) const;
  bool router_attached_all() const;
  std::vector<Awaited> awaited_in_step() const;
  std::vector<Awaited> awaited_at_boundary() const;
  std::string awaited_by_router(const Place& place) const;
  ParticipantId source_in(DomainIndex domain, const Place& member) const;
  const Place* router() const;
  Place* find(std::string_view name);
  std::vector<msg::TopicCount> all_counts(const Domain& domain) const;
  std::vector<msg::TopicCount> take_new_counts(Domain& domain);
  void leave(Place& place, const std::string& reason);
  bool is_heard(const Place& place) const;
  static void vacate(Place& place);
  void forget_deliveries();
  void amend_step();

  Inbox& inbox_;
  Tap* const tap_;
  OnStranger on_stranger_;
  OnHello on_hello_;
  std::vector<std::unique_ptr<Domain>> domains_;
  std::vector<Place> places_;
  std::unique_ptr<CountedWriter> drop_;
  /// (router, member): the router's participant in the member's domain.
  std::map<std::pair<ParticipantId, ParticipantId>, ParticipantId> attached_;
  /// Counts that the current router delivered, by node and topic; and those that no step has announced yet, by node.
  std::map<std::string, std::map<std::string, msg::TopicCount>> delivered_;
  std::map<std::string, std::vector<msg::TopicCount>> newly_delivered_;
  std::vector<std::uint8_t> routed_digest_, station_digest_;
  std::set<ParticipantId> gone_;  ///< lost or taken out; their samples may still arrive
  msg::Awaits awaits_;            ///< the router's last report of the members for which it waits
  std::vector<LostMember> lost_;
  std::vector<std::string> rejoined_, doubts_;
  std::uint64_t k_ = 0;
  std::uint32_t epoch_ = 0;
  bool membership_changed_ = true, in_step_ = false;
};

}  // namespace skein::bus
