#include "tests/protocol/fleet_model.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/fleet_processes.hpp"

namespace skein::test {

using bus::LockstepClient;

namespace {

Scenario make_scenario(std::size_t uavs) {
  Scenario scenario;
  scenario.name = "protocol";
  for (std::size_t i = 0; i < uavs; ++i) {
    UavConfig uav;
    uav.name = std::string(1, static_cast<char>('a' + i));
    scenario.fleet.push_back(uav);
  }
  scenario.radio.push_back({"/talk", "std_msgs/msg/String", {"all"}, {"all"}});
  return scenario;
}

}  // namespace

FleetModel::FleetModel(const FleetOptions& options, std::uint64_t schedule_seed)
    : options_(options), scenario_(make_scenario(options.uavs)), random_(schedule_seed, "schedule", 0) {
  if (options_.leftovers) start_leftovers();
  start("server");
  start(std::string(bus::kRouterName));
  start(std::string(bus::kStationName));
  for (const UavConfig& uav : scenario_.fleet) start(uav.name);
}

FleetModel::~FleetModel() = default;

void FleetModel::start_leftovers() {
  const auto leave = [&](const std::string& name, int domain, Node node) {
    leftovers_.push_back(
        std::make_unique<AgentProcess>(*this, network_, name, domain, node, "leftover " + name, RunId{7}));
  };
  leave(std::string(bus::kStationName), gcs_domain(0), kStationNode);
  leave(std::string(bus::kRouterName), world_domain(0), kStationNode);
  for (const UavConfig& uav : scenario_.fleet) {
    const std::size_t number = scenario_.uav_index(uav.name);
    leave(uav.name, uav_domain(0, UavIndex(number)), node_of_uav(UavIndex(number)));
  }
}

void FleetModel::start(const std::string& name) {
  const int life = ++lives_[name];
  const std::string life_name = life == 1 ? name : name + "#" + std::to_string(life);
  if (name == "server") {
    processes_[name] = std::make_unique<ServerProcess>(*this, network_);
  } else if (name == bus::kRouterName) {
    processes_[name] = std::make_unique<RouterProcess>(scenario_, network_, obey(name));
  } else if (name == bus::kStationName) {
    processes_[name] = std::make_unique<AgentProcess>(*this, network_, name, gcs_domain(0), kStationNode, life_name);
  } else {
    const std::size_t uav = scenario_.uav_index(name);
    processes_[name] = std::make_unique<AgentProcess>(*this, network_, name, uav_domain(0, UavIndex(uav)),
                                                      node_of_uav(UavIndex(uav)), life_name);
  }
}

std::function<void(LockstepClient::Order)> FleetModel::obey(const std::string& name) {
  return [this, name](LockstepClient::Order order) {
    EXPECT_EQ(order == LockstepClient::Order::kill, options_.fault.kill);
    struck_.insert(name);
  };
}

// A program that has obeyed an order dies or stops. The launcher restarts or continues it once the server says so and
// the launcher has seen that the program is dead or stopped.
void FleetModel::carry_out_faults() {
  for (const std::string& name : std::exchange(struck_, {})) {
    if (options_.fault.kill) {
      processes_.erase(name);
      network_.lose_tails_of_the_dead(random_);
      dead_.insert(name);
    } else {
      stopped_.insert(name);
    }
  }
  const std::string& victim = options_.fault.victim;
  const bool called_back = called_back_.contains(victim);
  if ((called_back || options_.fault.returns_early) && dead_.erase(victim) > 0) start(victim);
  if (called_back && stopped_.erase(victim) > 0) processes_.at(victim)->resume();
}

// The death of the victim, its detection and the restart come in this order, with other events in between.
void FleetModel::kill_and_notice() {
  if (options_.victim.empty() || events_ < options_.kill_after || random_.bits() % 8 != 0) return;
  auto& server = static_cast<ServerProcess&>(*processes_.at("server"));
  if (server.finished()) return;
  if (fate_ == Fate::alive) {
    processes_.erase(options_.victim);
    network_.lose_tails_of_the_dead(random_);
    fate_ = Fate::killed;
  } else if (fate_ == Fate::killed) {
    server.lost(options_.victim);
    fate_ = Fate::noticed;
  } else if (fate_ == Fate::noticed && options_.restart) {
    start(options_.victim);
    fate_ = Fate::restarted;
  }
}

bool FleetModel::all_finished() const {
  // A program that restarts after the last step is never let in.
  const bool over = processes_.at("server")->finished();
  for (const auto& [name, process] : processes_) {
    if (stopped_.contains(name)) continue;
    if (!process->finished() && !(over && !process->took_part())) return false;
  }
  return true;
}

std::string FleetModel::run() {
  constexpr std::size_t kQuiet = 200;   // polls per process without an event, after which nothing will ever happen
  constexpr std::size_t kRepeats = 20;  // repeated requests in all; endless ones would hide a deadlock
  constexpr std::size_t kStill = 10;    // polls per process without an event, after which events held back may happen
  std::size_t quiet = 0, still = 0, repeats = 0;
  while (!all_finished()) {
    ++events_;
    kill_and_notice();
    auto events = network_.events();
    quiet = events.empty() ? quiet + 1 : 0;
    if (still < kStill * processes_.size()) std::erase_if(events, [&](const auto& event) { return held_back(event); });
    still = events.empty() ? still + 1 : 0;
    if (quiet > kQuiet * processes_.size()) {
      auto& server = static_cast<ServerProcess&>(*processes_.at("server"));
      if (options_.asks_again && repeats < kRepeats) {
        server.ask_again();
        ++repeats;
        quiet = 0;
        continue;
      }
      if (!options_.gives_up || !server.give_up_awaited()) return "deadlock\n" + describe_state();
      quiet = 0;
    }
    if (!options_.asks_again && repeats < kRepeats && random_.bits() % 64 == 0) {
      static_cast<ServerProcess&>(*processes_.at("server")).ask_again();
      ++repeats;
    }
    if (!events.empty() && random_.bits() % 3 != 0) {
      network_.happen(events[random_.bits() % events.size()]);
    } else {
      poll_one();
    }
    carry_out_faults();
  }
  return {};
}

std::string FleetModel::describe_state() const {
  std::string text = static_cast<const ServerProcess&>(*processes_.at("server")).awaits() + "\n";
  for (const auto& [name, process] : processes_) {
    if (const auto* agent = dynamic_cast<const AgentProcess*>(process.get())) text += agent->waits() + "\n";
    if (const auto* router = dynamic_cast<const RouterProcess*>(process.get())) text += router->waits() + "\n";
  }
  return text + network_.describe();
}

// Holds back one kind of event on some topics, which depend on options_.slow.
bool FleetModel::held_back(const SimNetwork::Event& event) const {
  if (!options_.slow) return false;
  const std::uint64_t drawn = *options_.slow;
  return static_cast<std::uint64_t>(event.kind) == drawn % 3 && fnv1a(drawn, network_.topic_of(event)) % 4 == 0;
}

void FleetModel::poll_one() {
  for (const auto& leftover : leftovers_) leftover->poll();

  auto it = processes_.begin();
  std::advance(it, static_cast<std::ptrdiff_t>(random_.bits() % processes_.size()));
  if (!stopped_.contains(it->first)) it->second->poll();
}

}  // namespace skein::test
