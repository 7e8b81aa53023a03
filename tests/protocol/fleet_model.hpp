// A small fleet on the simulated network: the production server, router and clients, with toy planners. An agent's
// messages depend on everything that it has received, so that the slightest difference spreads.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/lockstep/client.hpp"
#include "core/scenario/scenario.hpp"
#include "tests/protocol/sim_network.hpp"

namespace skein::test {

/// The messages that one member received and sent in one step.
struct StepLog {
  std::uint64_t k = 0;
  std::vector<std::string> heard, said, commanded;
  bool listening = false;  ///< its subscription to the topic that is registered at run time is open
};

/// The links of the model's world.
constexpr bool linked_in_model(std::size_t from, std::size_t to, std::uint64_t k) {
  return from != to && (from + to + k) % 4 != 0;
}

/// Steps in which the server writes on each UAV's latched topic. It writes in the first step, as it does for bounding
/// boxes, and more samples in all than the topic's history holds, which is two.
constexpr bool tells_site_in_model(std::uint64_t k) { return k == 0 || k == 2 || k == 4; }

/// A program of the fleet; it acts only in poll().
class Process {
 public:
  virtual ~Process() = default;
  virtual void poll() = 0;
  virtual bool finished() const = 0;
  virtual bool took_part() const { return true; }
  /// Continues after a fault has stopped the program.
  virtual void resume() {}
};

/// A fault of the server's plan: takes a program out at one step and lets it back at another.
struct ProcessFault {
  std::string victim = {};              ///< program; empty: none
  bool kill = true;                     ///< false: stop it
  std::uint64_t begin = 0, end = 1000;  ///< steps
  /// A killed program restarts as soon as it is dead, and waits to be let in; else it restarts when the server lets it
  /// back in.
  bool returns_early = false;
};

struct FleetOptions {
  std::size_t uavs = 2;
  std::uint64_t steps = 8;       ///< number of steps; the last one ends the run
  std::string victim = {};       ///< program to kill once, or empty
  bool restart = false;          ///< starts the victim again
  std::uint64_t kill_after = 0;  ///< number of events before the victim is killed
  ProcessFault fault = {};
  /// Before all other programs start, a member of another run joins under each member's name.
  bool leftovers = false;
  /// In this step "a" destroys its radio writer, although it has declared it.
  std::optional<std::uint64_t> closes_writer = {};
  /// In this step "a" announces a radio message that reaches no member.
  std::optional<std::uint64_t> announces_too_much = {};
  /// In this step the next sample of a topic in this domain is lost on the way to all its readers.
  struct Loss {
    std::uint64_t k = 0;
    int domain = 0;
    std::string topic;
  };
  std::optional<Loss> loses = {};
  /// true: the server repeats its requests once nothing happens any more; false: at random, a few times.
  bool asks_again = false;
  /// Once nothing happens any more, the server gives up the members that it awaits (as after a timeout), and continues.
  bool gives_up = false;
  /// Matches or samples of some topics, drawn by this seed, come only once nothing else happens any more.
  std::optional<std::uint64_t> slow = {};
};

/// Runs one schedule to its end.
class FleetModel {
 public:
  FleetModel(const FleetOptions& options, std::uint64_t schedule_seed);
  ~FleetModel();

  /// @returns an empty string, or what went wrong: a deadlock, with the state of things.
  std::string run();

  /// The steps of each life of an agent ("a", then "a#2" after a restart).
  const std::map<std::string, std::vector<StepLog>>& agents() const { return agents_; }
  /// Commands that the server accepted, per UAV and step.
  const std::map<std::string, std::map<std::uint64_t, std::vector<std::string>>>& taken() const { return taken_; }
  /// Names of members that the server reported as lost, and as rejoined.
  const std::vector<std::string>& lost() const { return lost_; }
  const std::vector<std::string>& rejoined() const { return rejoined_; }
  /// Members that the server gave up, each with what the server awaited from it.
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
  std::set<std::string> struck_;  ///< programs that have obeyed a fault's order, which has yet to be carried out
  std::set<std::string> stopped_, dead_, called_back_;
  std::uint64_t events_ = 0;
};

}  // namespace skein::test
