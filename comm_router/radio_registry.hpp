// Radio topics that members register while the run lasts (docs/radio.md): who may send what to whom, who listens, and
// what they are told about it. Requests take effect in the step in which they were made, whatever the time that
// discovery takes: the router does not answer that step before both ends are matched. Pure; no bus. Not thread-safe.
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

/// A member and its number of a request.
struct Asker {
  SourceId source = 0;
  Node node = kStationNode;
  std::uint32_t id = 0;
  bool operator==(const Asker&) const = default;
};

/// As RadioRequest_ has it (idl/skein_msgs.idl).
struct RadioRequest {
  Asker asker;
  bool listen = false;
  std::string source;
  std::vector<std::string> targets;
  std::string name, type;
};

/// As RadioReply_ has it.
struct RadioReply {
  Asker asker;
  bool open = false;
  std::string reason = {};
  std::vector<std::string> unheard = {};
  bool operator==(const RadioReply&) const = default;
};

/// What the registry needs to know of the router's endpoints, and has it do with them.
struct RadioEndpoints {
  /// A route is new or has new targets: opens what it lacks.
  std::function<void(std::size_t route)> open;
  /// Nobody sends on this route, since the only one who asked for it was refused: frees what open() made.
  std::function<void(std::size_t route)> close;
  /// Our reader of this route has found the member's writer.
  std::function<bool(std::size_t route, SourceId)> hears;
  /// Our writer of this arrival topic has found the member's reader.
  std::function<bool(const RadioTarget&, SourceId)> reaches;
  /// A member of that node declared when it joined that it reads this arrival topic.
  std::function<bool(const RadioTarget&)> declared;
  /// From the next step on, what this member sends on the route counts.
  std::function<void(std::size_t route, SourceId)> admit;
  /// This participant is no member any more.
  std::function<bool(SourceId)> lost;
};

/// A request that waits for an end of the asker's.
struct AwaitedRequest {
  Asker asker;
  std::string what;  ///< "rt/x to match"
};

class RadioRegistry {
 public:
  /// Topics that one member may ever ask to send on, and as many that it may listen to at a time.
  static constexpr std::size_t kMaxTopics = 1024;
  /// So many requests of one member may be waited for in vain. For a while the fleet stands still for each.
  static constexpr std::size_t kMaxVain = 3;

  /// @param table  of this run; both must outlive this.
  RadioRegistry(const Scenario& scenario, RadioTable& table, RadioEndpoints endpoints);

  /// All requests of a step, in the order in which they count.
  void begin_step(const std::vector<RadioRequest>& requests);
  /// Whether an end is not matched yet that must be before this step's messages may pass.
  bool waiting() const { return !awaited().empty(); }
  /// Whose, and which.
  std::vector<AwaitedRequest> awaited() const;
  /// What is to be said in this step. Who has not matched by now is told that it made no fitting writer.
  std::vector<RadioReply> end_step();
  /// Refusals of the last end_step() that depend on how long it was waited for, for a human: with more patience the
  /// answer might have been another.
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
    bool matched = false;  ///< at both ends; that it has matched us, it says by answering the step after `open`
    std::optional<RadioReply> told = {};
  };

  /// What a member has asked for since it joined.
  struct History {
    std::set<std::size_t> routes;
    std::size_t in_vain = 0;
  };

  void forget_the_lost();
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
  std::vector<Sending> sendings_;      ///< in the order of asking
  std::vector<Listening> listenings_;  ///< likewise
  std::map<SourceId, History> histories_;
  std::vector<RadioReply> replies_;            ///< of this step
  std::vector<std::string> decided_by_clock_;  ///< likewise
};

}  // namespace skein::router
