// A stepped fleet: the production nodes of server, router, station and agents, two of them learners, over a bus without
// threads and with turns in random order. The fleet stops exactly at the requested step. Each learner observes once
// there, and plans only with its orders. Neither the order of turns nor the length of steps changes the flight.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "comm_router/router_node.hpp"
#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "scenes/scene_source.hpp"
#include "sim_server/sim_node.hpp"
#include "station/station_node.hpp"
#include "tests/support/places.hpp"
#include "uav_agent/agent_node.hpp"
#include "uav_agent/api/learner.hpp"

namespace skein::test {
namespace {

/// Stops the fleet at `target`, and checks and records what server and learners do.
class Desk final : public agent::LearnerDesk, public sim::StepGate {
 public:
  void enter(const std::string&, agent::Learner&) override {}
  bool looks(std::uint64_t k) const override { return k == target; }
  bool told(std::uint64_t k) const override { return k < target; }
  void begin(const sim::Simulation& simulation, const sim::RunDigest&, bool last) override {
    EXPECT_EQ(simulation.step(), begun.value_or(simulation.step() - 1) + 1) << "a step was left out";
    EXPECT_LE(simulation.step(), target) << "the server has begun a step that was not requested";
    begun = simulation.step();
    if (last) target = *begun + 1;  // no further request will come
  }
  bool may_end(std::uint64_t k) const override { return k < target; }
  void closed(const sim::Simulation&, const sim::RunDigest& digest) override { closed_with = digest.hex(); }

  std::uint64_t target = 0;
  std::optional<std::uint64_t> begun;
  std::optional<std::string> closed_with;
};

/// The planner `learner`; counts its observations and its plans by step.
class Watched final : public agent::Planner, public agent::Learner {
 public:
  Watched(std::unique_ptr<agent::Planner> planner, const Desk& desk) : planner_(std::move(planner)), desk_(desk) {
    planner_->learner()->lay_out(layout_, "");
    block_.resize(layout_.bytes());
    planner_->learner()->use(block_.data());
  }
  agent::PlannerOutput plan(const agent::PlannerInput& in) override {
    EXPECT_TRUE(desk_.told(in.k)) << "the learner plans before it has its order";
    EXPECT_EQ(planned++, in.k) << "the learner must plan once per step";
    return planner_->plan(in);
  }
  bool wants_world_map() const override { return planner_->wants_world_map(); }
  Learner* learner() override { return this; }
  void lay_out(BlockLayout&, const std::string&) override {}
  void use(std::byte*) override {}
  void look(const agent::PlannerInput& in) override {
    ++looks[in.k];
    EXPECT_EQ(planned, in.k) << "the learner must observe a step before it plans it";
    planner_->learner()->look(in);
    EXPECT_EQ(*at<double>("sees.time_s"), seconds(in.tick));
  }
  /// The field with this name in the shared memory block.
  template <class T>
  T* at(const std::string& name) {
    const auto field = std::ranges::find(layout_.fields(), name, &BlockField::name);
    return reinterpret_cast<T*>(block_.data() + field->offset);
  }
  /// Orders a velocity that depends only on k, so that it is the same in each flight.
  void order(std::uint64_t k) {
    *at<double>("does.yaw_rate") = 0.1;
    at<double>("does.velocity")[2] = 0.5 + 0.1 * static_cast<double>(k / 20 % 3);
    ++*at<std::int64_t>("does.serial");
  }

  std::map<std::uint64_t, int> looks;
  std::uint64_t planned = 0;

 private:
  const std::unique_ptr<agent::Planner> planner_;
  const Desk& desk_;
  BlockLayout layout_;
  std::vector<std::byte> block_;
};

class SteppedFleet {
 public:
  static constexpr double kFlightS = 4.0;
  static constexpr std::size_t kLearners = 2;

  explicit SteppedFleet(std::uint64_t order) : turns_(order, "turns", 0) {
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-stepped-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    nodes_.push_back(std::make_unique<sim::SimNode>(
        scenario_, sim::load_scene(scenario_),
        sim::SimNodeOptions{.out = folder_, .realtime_factor = {}, .stop_at_s = kFlightS, .faults = {}, .gate = desk},
        *bus_, status_));
    nodes_.push_back(std::make_unique<router::RouterNode>(scenario_, 0, 0, *bus_));
    nodes_.push_back(std::make_unique<station::StationNode>(scenario_, 0, *bus_, folder_, status_));
    for (const UavIndex uav : scenario_.uavs()) {
      const bool learns = learners.size() < kLearners;
      auto planner = agent::make_planner(learns ? "learner:safe=false" : "hover", agent::agent_config(scenario_, uav));
      if (learns) {
        auto watched = std::make_unique<Watched>(std::move(planner), *desk);
        learners.push_back(watched.get());
        planner = std::move(watched);
      }
      auto node = std::make_unique<agent::AgentNode>(scenario_, uav, std::move(planner), 0, *bus_);
      if (learns) node->step_by(*desk);
      nodes_.push_back(std::move(node));
    }
    for (const auto& node : nodes_) node->start();
  }
  ~SteppedFleet() { std::filesystem::remove_all(folder_); }

  bool over() const { return nodes_.front()->end().has_value(); }
  void go_on(int turns) {
    for (int i = 0; i < turns; ++i) nodes_[turns_.bits() % nodes_.size()]->poll();
  }
  /// Lets the fleet fly to this step. Wakes all nodes, because server and learners sleep.
  void go_on_until(std::uint64_t k) {
    desk->target = k;
    for (const auto& node : nodes_) node->inbox().wake();
  }
  /// Whether the fleet has stopped: all learners have observed in the target step.
  bool stands() const {
    return desk->begun == desk->target &&
           std::ranges::all_of(learners, [&](Watched* one) { return one->looks.contains(desk->target); });
  }
  bool go_until_it_stands() {
    for (int i = 0; i < 1'000'000 && !stands() && !over(); ++i) go_on(1);
    return stands() || over();
  }

  const std::shared_ptr<Desk> desk = std::make_shared<Desk>();
  std::vector<Watched*> learners;

 private:
  const Scenario scenario_ = load_scenario("towers", LoadOptions{.config_dir = source_path("config")});
  RandomStream turns_;
  std::filesystem::path folder_;
  StatusPipe status_{-1};
  const std::unique_ptr<bus::Bus> bus_ = bus::make_bus({.vendor = "inproc"});
  std::vector<std::unique_ptr<bus::LockstepNode>> nodes_;
};

/// Flies with steps of random length, at most `longest`, and turns in random order. @returns the digest.
std::string flown(std::uint64_t seed, std::uint64_t longest) {
  SteppedFleet fleet(seed);
  RandomStream random(seed, "steps", 0);
  std::set<std::uint64_t> stood;
  while (!fleet.over()) {
    if (!fleet.go_until_it_stands()) {
      ADD_FAILURE() << "the fleet does not reach step " << fleet.desk->target;
      return {};
    }
    if (fleet.over()) break;
    const std::uint64_t k = fleet.desk->target;
    stood.insert(k);
    fleet.go_on(200);  // further turns do not move the fleet
    EXPECT_EQ(fleet.desk->begun, k);
    for (Watched* learner : fleet.learners) {
      EXPECT_EQ(learner->planned, k) << "a learner has planned without an order";
      learner->order(k);
    }
    // A step ends at the latest where the velocity changes, every 20 exchanges, so that all flights get the same
    // orders.
    fleet.go_on_until(std::min(k + 1 + random.bits() % longest, k / 20 * 20 + 20));
  }
  for (Watched* learner : fleet.learners) {
    for (const auto& [k, times] : learner->looks) {
      EXPECT_EQ(times, 1) << "a learner has observed more than once in step " << k;
      EXPECT_TRUE(stood.contains(k)) << "a learner has observed in step " << k << ", in which the fleet did not stop";
    }
  }
  return fleet.desk->closed_with.value_or("not closed");
}

TEST(SteppedFleet, StopsAtRequestedStepsWhichDoNotChangeTheFlight) {
  const std::string one_by_one = flown(1, 1);
  ASSERT_EQ(one_by_one.size(), 64U);
  for (const std::uint64_t seed : {2U, 3U, 4U}) EXPECT_EQ(flown(seed, 12), one_by_one) << "seed " << seed;
}

}  // namespace
}  // namespace skein::test
