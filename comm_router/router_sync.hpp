// The router's side of the lock-step. It counts: it holds the members' messages until all those that the senders'
// Done(k) announce have arrived, then hands out exactly these as the batch of step k. Samples, Done, Step and Drop may
// arrive in any order. Pure state machine: no bus, no clock. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "comm_router/link_gate.hpp"
#include "core/radio/radio_routes.hpp"

namespace skein::router {

/// A participant as the bus names it (bus::ParticipantId).
using SourceId = std::uint64_t;

/// A member that takes part in the radio. Two programs may share a node: the station and a program at the GCS.
struct RadioMember {
  std::string name;
  SourceId source = 0;
  Node node = kStationNode;
};

/// A member that the router waits for, and what is missing, for people: "done", "rt/broadcast 3 of 4".
struct AwaitedMember {
  RadioMember member;
  std::string what;
};

struct SentCount {
  std::string topic;        ///< wire topic in the sender's domain
  std::uint64_t count = 0;  ///< samples since it joined
};

/// A participant that sent more than RouterSync keeps, so that messages of it are discarded.
struct Excess {
  SourceId source = 0;
  std::string what;  ///< for people: what it sent, what is discarded, and what to do
};

/// A member's request for a radio topic, still serialised (idl/skein_msgs.idl: RadioRequest_).
struct RequestSample {
  SourceId source = 0;
  Node node = kStationNode;
  Payload payload;
};

/// All messages of one step.
struct StepBatch {
  std::uint64_t k = 0;
  std::uint32_t epoch = 0;
  Links links;
  std::vector<SentMessage> messages;    ///< ordered by member (as the step lists them), route, sequence
  std::vector<RequestSample> requests;  ///< ordered by member (as the step lists them), sequence
};

class RouterSync {
 public:
  /// @param routes  those of the scenario. Must outlive this; further routes may be appended, for open().
  explicit RouterSync(const std::vector<RadioRoute>& routes) : routes_(routes), declared_(routes.size()) {}

  /// Step(k). @param members  those whose messages count; leave out those without a radio (the router itself). A former
  /// member that is missing here is forgotten, with all that it sent.
  void on_step(std::uint64_t k, std::uint32_t epoch, std::vector<RadioMember> members, Links links);
  /// Done(k). Counts of topics that are not radio topics of the sender's node are ignored.
  void on_done(SourceId source, std::uint64_t k, std::vector<SentCount> sent);
  /// A sample from a reader of `routes[route]`. Those of one writer must come in the order of writing. If the route is
  /// bound to a member (RadioRoute::member), samples and counts of other members at its node are ignored.
  void on_radio(SourceId source, std::size_t route, Payload payload);
  /// A request for a radio topic; counted and handed out like messages.
  void on_request(SourceId source, Payload payload);
  /// Admits a member to a route that is not the scenario's: from the next step on, its messages there count. Those that
  /// it sent before, as counted in its last Done, never count, because no program listened.
  void open(SourceId source, std::size_t route);
  /// The server gave the member up in step k: its messages of step k that are not handed out yet are discarded, and
  /// nothing that it sends counts again.
  void on_drop(std::uint64_t k, SourceId source);
  /// For a restarted router: the sender had already written `count` samples on this topic when the reader matched.
  void set_base(SourceId source, const std::string& topic, std::uint64_t count);

  /// The batch of the lowest step for which on_step() was called and that is not handed out yet, once it is complete;
  /// else nullopt.
  std::optional<StepBatch> take();

  /// Whether a participant will not count again: it left, the server gave it up, or it sent more than any member may.
  bool lost(SourceId source) const { return gone_.contains(source) || dropped_from_.contains(source); }
  /// Whether a step was announced that take() has not handed out.
  bool waiting() const { return !steps_.empty(); }
  /// How many members have not answered the next step: take() needs a Done, or a Drop, of each of them.
  std::size_t missing_answers() const;
  /// The members that take() waits for. Empty when it waits for nothing but the next step.
  std::vector<AwaitedMember> awaited() const;
  /// The participants of which messages have been discarded since the last call: each once for each of the topics on
  /// which it sent too many, or once if all is discarded.
  std::vector<Excess> take_excesses() { return std::exchange(excesses_, {}); }
  /// The step that take() hands out next, if it was announced.
  std::optional<std::uint64_t> next_step() const;

 private:
  struct Lane {
    std::uint64_t taken = 0;  ///< samples handed out so far, including those skipped by set_base() or open()
    std::deque<Payload> waiting;
    bool overflowed = false;  ///< samples have been discarded
  };
  /// A participant's messages and answers that are not handed out yet. May exist before the step that makes the
  /// participant a member.
  struct Sender {
    std::map<std::string, Lane> lanes;                     ///< by wire topic
    std::map<std::uint64_t, std::vector<SentCount>> done;  ///< by k
    std::vector<SentCount> last_done;                      ///< of the step handed out last
    std::set<std::size_t> opened;                          ///< routes that open() admitted it to
    std::size_t waiting_as_stranger = 0;                   ///< samples that came before it was a member
    std::string member;                                    ///< its name, once it is one

    std::uint64_t arrived(const std::string& topic) const;
    bool overflowed(const std::string& topic) const;
  };
  struct Step {
    std::uint32_t epoch = 0;
    std::vector<RadioMember> members;
    Links links;
  };

  bool complete(std::uint64_t k, const RadioMember& member) const;
  void queue(SourceId source, const std::string& topic, Payload payload);
  bool counts(const Sender& sender, std::size_t route, const RadioMember& member) const;
  /// The counts in the sender's Done(k): of its requests, and of the radio topics on which it may send, by route.
  std::vector<SentCount> radio_counts(const Sender& sender, std::uint64_t k, const RadioMember& member) const;
  void take_messages(std::uint64_t k, const RadioMember& member, StepBatch& batch);
  void forget_the_gone(std::uint64_t k);
  void forget(SourceId source);
  void forget(SourceId source, const std::string& excess);

  const std::vector<RadioRoute>& routes_;
  const std::size_t declared_;           ///< number of the scenario's routes, which come first
  std::map<std::uint64_t, Step> steps_;  ///< announced, not yet handed out
  std::map<SourceId, Sender> senders_;
  std::map<SourceId, std::uint64_t> dropped_from_;  ///< first step in which the participant does not count
  std::vector<SourceId> members_before_;            ///< of the step that take() last looked at
  std::set<SourceId> gone_;                         ///< participants that never count again
  std::optional<std::uint64_t> last_k_;             ///< handed out last
  std::vector<Excess> excesses_;                    ///< not yet taken
};

}  // namespace skein::router
