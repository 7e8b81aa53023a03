// The server's side of the lock-step (docs/lockstep.md): it owns membership and the clock. Built from events.
// Between two steps it stands still while somebody joins; within a step it waits for everybody's answer.
// Threads: all calls from the thread that dispatches the inbox.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "bus/lockstep/counted.hpp"
#include "bus/typed.hpp"
#include "idl/type_names.hpp"

namespace skein::bus {

class LockstepServer {
 public:
  /// A domain that the server joined; the first one added is the world's, where the router is a member.
  using DomainIndex = std::size_t;

  struct StepInfo {
    std::uint64_t k = 0;
    std::int64_t tick = 0;
    std::vector<std::uint8_t> links;  ///< row-major radio matrix, published in the world domain only
    std::uint64_t ledger_upto = 0;
    bool final_step = false;
    std::vector<msg::FaultBegin> faults = {};      ///< likewise
    std::vector<std::string> faults_by_hand = {};  ///< likewise
  };
  struct LostMember {
    std::string name;
    std::uint64_t k = 0;
    std::string reason;
  };
  struct Awaited {
    std::string member;
    std::string what;  ///< for a human: "done of step 7", "rt/plan 3 of 4"
  };

  /// @param tap  hears the samples of writer() and of read(); it must outlive this.
  explicit LockstepServer(Inbox& inbox, Tap* tap = nullptr) : inbox_(inbox), tap_(tap) {}

  /// @param node  radio node whose domain this is ("gcs" or a UAV's name); "" for the world's.
  DomainIndex add_domain(const std::string& node, Participant& participant);
  /// A place for a member; its name may say ready in this domain only. @param awaited  before the first step.
  void add_place(const std::string& member, DomainIndex domain, bool awaited);
  /// Topic that the server writes; announced in every step of that domain.
  CountedWriter& writer(DomainIndex domain, const TopicSpec& topic);
  /// Topic that a member of this domain writes and whose samples are handed out when the step is answered.
  void read(DomainIndex domain, const TopicSpec& topic, CountedQueues::Handler handler);
  /// The same for messages: `handler` gets (message); what is no Message is dropped and counted (typed.hpp).
  template <WireMessage Message, class Handler>
  void read(DomainIndex domain, const TopicSpec& topic, Handler handler) {
    read(domain, topic, decoding<Message>(inbox_, topic.name, std::move(handler)));
  }

  /// Called for each sample on a topic of read() whose writer is no member, and which therefore goes nowhere; it may be
  /// on its way in or out: see is_stranger(). Inside dispatch().
  using OnStranger = std::function<void(DomainIndex, const std::string& topic, ParticipantId source)>;
  void on_stranger(OnStranger tell) { on_stranger_ = std::move(tell); }
  /// Called when somebody says hello in a domain, with the topics that it means to write: time to read() more of them.
  /// Inside dispatch().
  using OnHello = std::function<void(DomainIndex, const std::vector<std::string>& writes)>;
  void on_hello(OnHello tell) { on_hello_ = std::move(tell); }
  /// True for who neither is a member, nor was one, nor has asked to become one.
  bool is_stranger(ParticipantId source) const;

  /// At a boundary: lets in whoever knocks. @returns true when nobody is at the door any more: publish() may follow.
  bool at_boundary();
  /// Writes a domain's samples of a step; they leave together with the step.
  using WriteSamples = std::function<void(DomainIndex)>;
  /// Domain by domain, so that the first members think while the last are still being told.
  /// @param write_samples  called once for each domain in turn, before its step is told.
  void publish(
      const StepInfo& info, const WriteSamples& write_samples = [](DomainIndex) {});
  /// @returns true when everybody has answered the published step; handlers of read() have run then, member by member.
  bool answered();
  /// For Inbox::dispatch(), while answered() is false: each answer that is missing rings once at least.
  std::size_t rings() const;
  /// While answered() is false and nothing happens: tells the step once more where an answer is missing. Either may
  /// have been lost with a lease that was over, and whoever has answered answers the same again. Notes whose lease is
  /// over: what it has said may be lost then, or come twice, and the reason of its loss says so.
  void ask_again();

  /// At a boundary, before publish(): a fault takes this member out, and the steps to come tell it what to do to
  /// itself. That is no loss. Nobody gets its place until let_back().
  /// @param order  kOrderKill or kOrderStop (names.hpp).
  /// @returns false, with nothing done, when it is no member.
  bool take_out(const std::string& member, std::string_view order);
  /// At a boundary: the fault is over; at_boundary() waits until the member has joined again.
  /// @returns false when it has been lost meanwhile.
  bool let_back(const std::string& member);

  /// A process died (launcher), hangs (time-out) or left: nobody waits for it any longer.
  void lost(const std::string& member, const std::string& reason);
  /// For a fleet in which nobody tells who died: members that have left, or are silent for longer than their lease
  /// (`--lease`), are lost.
  void drop_vanished();
  /// Members and joiners that are lost since the last call.
  std::vector<LostMember> take_lost();

  bool is_member(const std::string& name) const;
  /// Joined again after it had been lost, since the last call.
  std::vector<std::string> take_rejoined();
  /// Who has not answered, or has not joined, and nobody who only waits for them; for messages and time-outs. Never
  /// empty while at_boundary() or answered() is false.
  std::vector<Awaited> awaited() const;
  /// What the router decided by a wall clock since the last call: it might turn out otherwise another time.
  std::vector<std::string> take_doubts();
  /// Of the last answered step: the router's hash of its deliveries, the station's of its tally changes.
  const std::vector<std::uint8_t>& routed_digest() const { return routed_digest_; }
  const std::vector<std::uint8_t>& station_digest() const { return station_digest_; }

 private:
  /// Where members say ready and done: the station at one of its own (names.hpp).
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
    bool newcomer = false;  ///< since the last step somebody joined, who knows no counts of what is latched
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
    std::optional<msg::Order> order;  ///< taken out by a fault: who knocks waits at the door
    ParticipantId source = 0;         ///< of the member, or of who knocks
    bool invited = false, declared = false;
    std::vector<std::string> reads, writes;
    bool answered = false;
    bool unheard = false;  ///< for a while within a step: its lease was over, and it may be back since
    std::vector<CountedQueues::Expected> sent;                 ///< by its last Done
    std::optional<std::pair<ParticipantId, msg::Ready>> next;  ///< knocked while the place was taken
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
  /// What the present router delivered, by node, topic; and what of it the members do not know yet.
  std::map<std::string, std::map<std::string, msg::TopicCount>> delivered_;
  std::map<std::string, std::vector<msg::TopicCount>> newly_delivered_;
  std::vector<std::uint8_t> routed_digest_, station_digest_;
  std::set<ParticipantId> gone_;  ///< lost; what they said may still arrive
  msg::Awaits awaits_;            ///< the router's last word of whom it waits for
  std::vector<LostMember> lost_;
  std::vector<std::string> rejoined_, doubts_;
  std::uint64_t k_ = 0;
  std::uint32_t epoch_ = 0;
  bool membership_changed_ = true, in_step_ = false;
};

}  // namespace skein::bus
