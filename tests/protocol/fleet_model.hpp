// A small fleet on the simulated network: the production server, router and clients, with toy minds. What an agent
// says depends on everything that it has heard, so that the slightest difference spreads.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/lockstep/client.hpp"
#include "core/scenario.hpp"
#include "tests/protocol/sim_network.hpp"

namespace skein::test {

/// What one member did and heard in one step.
struct StepLog {
  std::uint64_t k = 0;
  std::vector<std::string> heard, said, commanded;
  bool listening = false;  ///< to the topic that is registered at run time
};

/// The links of the model's world.
constexpr bool linked_in_model(std::size_t from, std::size_t to, std::uint64_t k) {
  return from != to && (from + to + k) % 4 != 0;
}

/// Steps in which the server writes on each UAV's latched topic, whose history holds two: some at the very start, as
/// the boxes, and more than the history later.
constexpr bool tells_site_in_model(std::uint64_t k) { return k == 0 || k == 2 || k == 4; }

/// A program of the fleet; it acts only in poll().
class Process {
 public:
  virtual ~Process() = default;
  virtual void poll() = 0;
  virtual bool finished() const = 0;
  virtual bool took_part() const { return true; }
  /// Goes on after a fault has stopped it.
  virtual void resume() {}
};

/// A fault of the server's plan: takes a program out at one step and lets it back at another.
struct ProcessFault {
  std::string victim = {};  ///< empty: none
  bool kill = true;         ///< or stop
  std::uint64_t begin = 0, end = 1000;
  /// A killed program starts again as soon as it is dead, and waits at the door; else when the server lets it back.
  bool returns_early = false;
};

struct FleetOptions {
  std::size_t uavs = 2;
  std::uint64_t steps = 8;       ///< the last one is final
  std::string victim = {};       ///< program to kill once, or empty
  bool restart = false;          ///< and to start again
  std::uint64_t kill_after = 0;  ///< events
  ProcessFault fault = {};
  /// Before everybody else comes somebody of another run in each member's name.
  bool leftovers = false;
  /// In this step "a" destroys its writer on the radio, though it has declared it.
  std::optional<std::uint64_t> closes_writer = {};
  /// In this step "a" announces a radio message that nobody gets.
  std::optional<std::uint64_t> announces_too_much = {};
  /// In this step the next sample of a topic, in this domain, is lost on its way to everybody.
  struct Loss {
    std::uint64_t k = 0;
    int domain = 0;
    std::string topic;
  };
  std::optional<Loss> loses = {};
  /// When nothing moves any more, the server asks again; else it does so at random, a few times.
  bool asks_again = false;
  /// When nothing moves any more, the server gives up whom it awaits (as after a time-out), and goes on.
  bool gives_up = false;
  /// Matches or samples of some topics, drawn with this number, come only when nothing else moves any more.
  std::optional<std::uint64_t> slow = {};
};

/// Runs one schedule to its end.
class FleetModel {
 public:
  FleetModel(const FleetOptions& options, std::uint64_t schedule_seed);
  ~FleetModel();

  /// @returns an empty string, or what went wrong: a deadlock, with the state of things.
  std::string run();

  /// Per life of an agent ("a", "a#2" after a restart): its steps.
  const std::map<std::string, std::vector<StepLog>>& agents() const { return agents_; }
  /// Commands that the server took, per UAV and step.
  const std::map<std::string, std::map<std::uint64_t, std::vector<std::string>>>& taken() const { return taken_; }
  /// Names that were told as lost, and as members again.
  const std::vector<std::string>& lost() const { return lost_; }
  const std::vector<std::string>& rejoined() const { return rejoined_; }
  /// Whom the server gave up, and what it was waiting for.
  const std::vector<std::string>& given_up() const { return given_up_; }

 private:
  friend class ServerProcess;
  friend class AgentProcess;

  void start(const std::string& name);
  std::function<void(bus::LockstepClient::Order)> obey(const std::string& name);
  void kill_and_notice();
  void carry_out_faults();
  void poll_one();
  void start_leftovers();
  std::string describe_state() const;
  bool held_back(const SimNetwork::Event& event) const;
  bool all_finished() const;

  FleetOptions options_;
  Scenario scenario_;
  RandomStream random_;
  SimNetwork network_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
  std::vector<std::unique_ptr<Process>> leftovers_;
  std::map<std::string, std::vector<StepLog>> agents_;
  std::map<std::string, std::map<std::uint64_t, std::vector<std::string>>> taken_;
  std::vector<std::string> lost_, rejoined_, given_up_;
  std::map<std::string, int> lives_;
  enum class Fate { alive, killed, noticed, restarted } fate_ = Fate::alive;
  std::set<std::string> struck_;  ///< have obeyed, and are still there
  std::set<std::string> stopped_, dead_, called_back_;
  std::uint64_t events_ = 0;
};

}  // namespace skein::test
