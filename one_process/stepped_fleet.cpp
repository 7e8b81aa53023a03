#include "one_process/stepped_fleet.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "one_process/fleet_programs.hpp"
#include "one_process/truth.hpp"
#include "results/run_folder.hpp"

namespace skein::one_process {
namespace {

/// If no program has had anything to do for this wall time, the fleet has failed: its programs wait for something that
/// will not happen.
constexpr std::chrono::seconds kStandstill{60};

std::vector<shared_lines::Start> with_seed(std::vector<shared_lines::Start> starts, std::uint64_t seed) {
  for (shared_lines::Start& start : starts) {
    const auto option = std::ranges::find(start.argv, "--seed");
    if (option == start.argv.end() || option + 1 == start.argv.end()) {
      throw std::logic_error(start.program + ": its start order has no seed");
    }
    *(option + 1) = std::to_string(seed);
  }
  return starts;
}

/// Sleeps for kNap. Call it after Crew::kIdleRounds idle rounds: programs can then only wait for wall time to pass.
void nap() {
  const timespec nap{0, std::chrono::nanoseconds(Crew::kNap).count()};
  ::ppoll(nullptr, 0, &nap, nullptr);
}

}  // namespace

/// The program that steps the fleet, as the server and the learners see it.
class SteppedFleet::Desk final : public agent::LearnerDesk, public sim::StepGate {
 public:
  Desk(std::shared_ptr<station::ScoreView> score, const std::vector<std::string>& uavs)
      : truth(std::move(score), uavs) {
    truth.lay_out(layout);
  }

  void enter(const std::string& uav, agent::Learner& learner) override {
    if (block != nullptr) throw std::logic_error(uav + ": the agent of a learner cannot be restarted");
    learner.lay_out(layout, uav + ".");
    learners.emplace_back(uav, &learner);
  }
  bool looks(std::uint64_t k) const override { return k == target; }
  bool told(std::uint64_t k) const override { return k < target; }

  void begin(const sim::Simulation& simulation, const sim::RunDigest& digest, bool last) override {
    begun = simulation.step();
    if (last) target = *begun;
    is_last = last;
    truth.follow(simulation, digest);
  }
  bool may_end(std::uint64_t k) const override { return k < target; }
  void closed(const sim::Simulation&, const sim::RunDigest&) override {
    truth.keep();
    over = true;
  }

  Truth truth;
  BlockLayout layout;
  std::byte* block = nullptr;
  std::vector<std::pair<std::string, agent::Learner*>> learners;
  std::uint64_t target = 0;            ///< the step in which the fleet is to stand still
  std::optional<std::uint64_t> begun;  ///< the last step that the server has announced
  bool is_last = false, over = false;
};

SteppedFleet::SteppedFleet(const std::vector<shared_lines::Start>& starts, const std::vector<std::string>& uavs,
                           std::uint64_t seed, std::shared_ptr<sim::SceneShelf> shelf)
    : score_(std::make_shared<station::ScoreView>()),
      desk_(std::make_shared<Desk>(score_, uavs)),
      crew_(pipe_, [programs = FleetPrograms{.desk = desk_, .gate = desk_, .score = score_, .shelf = std::move(shelf)}](
                       const std::string& name) { return programs.make(name); }) {
  for (const shared_lines::Start& start : with_seed(starts, seed)) crew_.obey(start);
  if (const auto& failed = crew_.failure()) {
    throw FleetFailed{failed->program, failed->code, failed->signal, "it did not start"};
  }
}

SteppedFleet::~SteppedFleet() = default;

const BlockLayout& SteppedFleet::layout() const { return desk_->layout; }
std::uint64_t SteppedFleet::turns() const { return crew_.turns(); }
bool SteppedFleet::over() const { return desk_->over; }
nlohmann::json SteppedFleet::result() const { return desk_->truth.result(); }
nlohmann::json SteppedFleet::scene() const { return desk_->truth.scene(); }

void SteppedFleet::begin(std::byte* block) {
  desk_->block = block;
  for (const auto& [uav, learner] : desk_->learners) learner->use(block);
  run();
}

void SteppedFleet::step(std::uint64_t steps) {
  if (over()) throw std::logic_error("the run is over");
  desk_->target += steps;
  run();
}

/// Runs rounds until the fleet stands still: in a round that began in the target step, no program had anything to do.
/// If the target is the run's last step, runs until the run has ended.
void SteppedFleet::run() {
  using Clock = std::chrono::steady_clock;
  const auto ring = [this] {
    crew_.ring(programs::kSimServer);
    for (const auto& [uav, learner] : desk_->learners) crew_.ring(programs::agent_program(uav));
  };
  ring();
  std::optional<Clock::time_point> idle_since;
  for (int idle = 0; true;) {
    const bool there = desk_->begun == desk_->target;
    const bool any = crew_.round();
    if (const auto& failed = crew_.failure()) {
      throw FleetFailed{failed->program, failed->code, failed->signal, "it ended before the run did"};
    }
    if (desk_->over) return;
    if (any) {
      idle = 0;
      idle_since.reset();
      continue;
    }
    if (there) {
      desk_->truth.write(desk_->block);
      if (!desk_->is_last) return;
      desk_->target += 1;  // the last step needs no orders, so let it end
      ring();
      continue;
    }
    if (++idle < Crew::kIdleRounds) continue;
    if (!idle_since) idle_since = Clock::now();
    if (Clock::now() - *idle_since > kStandstill) throw FleetFailed{"", 0, 0, "the fleet stands still"};
    nap();
  }
}

}  // namespace skein::one_process
