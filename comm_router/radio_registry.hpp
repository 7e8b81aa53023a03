// Radio topics that members register during the run (docs/radio.md): which members may send on them, to which nodes,
// which members listen, and which replies they get. A request takes effect in the step in which it was made, however
// long discovery takes: the router completes that step only when both ends have matched, or when it has waited too long
// and refuses the request. The first request for a topic decides its type; a request that is refused decides nothing.
// Pure; no bus. Not thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "comm_router/router_sync.hpp"
#include "core/radio/radio_routes.hpp"

namespace skein::router {

/// A member that asks, and the number that it gave its request.
struct Asker {
  SourceId source = 0;
  Node node = kStationNode;
  std::uint32_t id = 0;
  bool operator==(const Asker&) const = default;
};

/// The content of a RadioRequest_ (idl/skein_msgs.idl explains the fields).
struct RadioRequest {
  Asker asker;
  bool listen = false;
  std::string source;
  std::vector<std::string> targets;
  std::string name, type;
};

/// The content of a RadioReply_ (idl/skein_msgs.idl).
struct RadioReply {
  Asker asker;
  bool open = false;
  std::string reason = {};
  std::vector<std::string> unheard = {};
  bool operator==(const RadioReply&) const = default;
};

/// The registry's questions about the router's DDS endpoints, and its orders to open and close them.
struct RadioEndpoints {
  /// A route is new or has new targets: opens the reader and writers that it lacks.
  std::function<void(std::size_t route)> open;
  /// No message ever passed on this route, and no member may send on it: closes what open() opened.
  std::function<void(std::size_t route)> close;
  /// Whether the router's reader of this route is matched with the member's writer.
  std::function<bool(std::size_t route, SourceId)> hears;
  /// Whether the router's writer of this arrival topic is matched with the member's reader.
  std::function<bool(const RadioTarget&, SourceId)> reaches;
  /// Whether a member at the target's node declared, when it joined, that it reads this arrival topic.
  std::function<bool(const RadioTarget&)> declared;
  /// From the next step on, messages of this member on the route count.
  std::function<void(std::size_t route, SourceId)> admit;
  /// Whether this participant is no longer a member.
  std::function<bool(SourceId)> lost;
};

/// A request that waits until the asker's endpoint has matched.
struct AwaitedRequest {
  Asker asker;
  std::string what;  ///< "rt/x to match"
};

class RadioRegistry {
 public:
  /// Most topics that a member may ask to send on since it joined, and most that it may listen to at a time.
  static constexpr std::size_t kMaxTopics = 1024;
  /// After this many requests of a member that were refused because nothing had matched in time, its further requests
  /// are refused at once, because the fleet stands still during each of these waits.
  static constexpr std::size_t kMaxVain = 3;

  /// @param table  of this run. It and the scenario must outlive this.
  RadioRegistry(const Scenario& scenario, RadioTable& table, RadioEndpoints endpoints);

  /// Takes all requests of a step. @param requests  in the order in which they take effect.
  void begin_step(const std::vector<RadioRequest>& requests);
  /// Whether this step's messages must still wait until an endpoint has matched.
  bool waiting() const { return !awaited().empty(); }
  /// The requests whose endpoints have not matched.
  std::vector<AwaitedRequest> awaited() const;
  /// Ends a step. @returns its replies. A request whose asker has no matched writer (or reader) by now is refused.
  std::vector<RadioReply> end_step();
  /// For people: the refusals of the last end_step() that depend on how long the router waited, a sentence each. With a
  /// longer timeout, the reply might have been another.
  const std::vector<std::string>& decided_by_clock() const { return decided_by_clock_; }

 private:
  enum class State { asked, open, refused };
  struct Sending {
    Asker asker;
    std::size_t route = 0;
    State state = State::asked;
    std::optional<RadioReply> told = {};
  };
  struct Listening {
    Asker asker;
    std::string ros_topic, ros_type;
    RadioTarget arrival;
    State state = State::asked;
    bool matched = false;  ///< both ways; the asker confirms its match by answering the step after `open`
    std::optional<RadioReply> told = {};
  };

  /// The requests of a member since it joined.
  struct History {
    std::set<std::size_t> routes;
    std::size_t in_vain = 0;
  };

  void forget_the_lost();
  bool awaits_type(const RadioRequest& request) const;
  void check_type(const RadioRequest& request) const;
  void close_unused_routes();
  void refuse_unmatched(const Asker& asker, const std::string& topic, const char* reason);
  void send(const RadioRequest& request);
  void listen(const RadioRequest& request);
  void refuse(const Asker& asker, const std::string& reason);
  bool is_matched(const Sending& sending) const;
  bool is_matched(const Listening& listening) const;
  bool heard(const RadioTarget& target) const;
  void settle_sendings();
  void settle_listenings();
  void tell(const RadioReply& reply, std::optional<RadioReply>& told);

  const Scenario& scenario_;
  RadioTable& table_;
  const RadioEndpoints endpoints_;
  const std::size_t declared_;         ///< number of the scenario's routes, which come first
  std::set<std::size_t> used_;         ///< registered routes on which a member may send, or could once
  std::vector<RadioRequest> put_off_;  ///< to the next step: see awaits_type()
  std::vector<Sending> sendings_;      ///< in the order of asking
  std::vector<Listening> listenings_;  ///< likewise
  std::map<SourceId, History> histories_;
  std::vector<RadioReply> replies_;            ///< of this step
  std::vector<std::string> decided_by_clock_;  ///< likewise
};

}  // namespace skein::router
