// A whole fleet in this process: the server, router, station and agents of a run as they are, over a bus without
// threads. Nothing may depend on the order in which they get their turns.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "comm_router/router_node.hpp"
#include "core/random_stream.hpp"
#include "core/scenario_reader.hpp"
#include "process/run_folder.hpp"
#include "sim_server/scenes/scene_source.hpp"
#include "sim_server/sim_node.hpp"
#include "station/station_node.hpp"
#include "uav_agent/agent_node.hpp"

namespace skein::test {
namespace {

class Fleet {
 public:
  /// @param order  draws who gets the next turn.
  Fleet(const std::string& scenario, const std::string& planner, double stop_at_s, std::uint64_t order)
      : scenario_(load_scenario(scenario, {.config_dir = SKEIN_SOURCE_DIR "/config"})), random_(order, "turns", 0) {
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-fleet-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    server_ = add(std::make_unique<sim::SimNode>(
        scenario_, sim::load_scene(scenario_),
        sim::SimNodeOptions{
            .base_domain = 0, .out = folder_, .seed = 0, .realtime_factor = {}, .stop_at_s = stop_at_s, .faults = {}},
        *bus_, status_));
    add(std::make_unique<router::RouterNode>(scenario_, 0, 0, *bus_));
    station_ = add(std::make_unique<station::StationNode>(scenario_, 0, *bus_, folder_, status_));
    for (const UavIndex uav : scenario_.uavs()) {
      add(std::make_unique<agent::AgentNode>(
          scenario_, uav, agent::make_planner(planner, agent::agent_config(scenario_, uav)), 0, *bus_));
    }
    for (const auto& node : nodes_) node->start();
  }
  ~Fleet() { std::filesystem::remove_all(folder_); }

  /// Turns in drawn order until the run is over. @returns false when nothing moves any more.
  bool fly() {
    for (std::uint64_t turn = 0; !server_->end() && turn < 3'000'000; ++turn) {
      if (const auto& node = nodes_[random_.bits() % nodes_.size()]) node->poll();
    }
    station_->write_report();
    return server_->end() == bus::NodeEnd::finished;
  }
  /// So many turns.
  void fly_on(int turns) {
    for (int i = 0; i < turns; ++i) {
      if (const auto& node = nodes_[random_.bits() % nodes_.size()]) node->poll();
    }
  }
  /// A UAV's program is gone.
  void kill(UavIndex uav) {
    nodes_[3 + uav].reset();
    server_->report_lost(scenario_.fleet[uav].name);
  }
  sim::SimNode& server() { return *server_; }
  std::size_t points() const {
    const auto report =
        nlohmann::json::parse(std::ifstream(folder_ / run_folder::report_file(programs::kStation)), nullptr, false);
    return report.value("points_detected", std::size_t{0});
  }

 private:
  template <class Node>
  Node* add(std::unique_ptr<Node> node) {
    Node* const raw = node.get();
    nodes_.push_back(std::move(node));
    return raw;
  }

  const Scenario scenario_;
  RandomStream random_;
  std::filesystem::path folder_;
  StatusPipe status_{-1};
  const std::unique_ptr<bus::Bus> bus_ = bus::make_bus({.vendor = "inproc"});
  std::vector<std::unique_ptr<bus::LockstepNode>> nodes_;
  sim::SimNode* server_ = nullptr;
  station::StationNode* station_ = nullptr;
};

TEST(FleetInOneProcess, TheOrderOfTurnsIsNoMatter) {
  std::set<std::string> digests;
  for (const std::uint64_t order : {1U, 2U, 3U}) {
    Fleet fleet("towers", "patrol", 25.0, order);
    ASSERT_TRUE(fleet.fly());
    ASSERT_TRUE(fleet.server().summary().deterministic);
    digests.insert(fleet.server().summary().digest.value_or("none"));
    EXPECT_GT(fleet.points(), 0U) << "from the camera to the score";
  }
  EXPECT_EQ(digests.size(), 1U);
}

TEST(FleetInOneProcess, GoesOnWithoutWhoIsLost) {
  Fleet fleet("towers", "hover", 6.0, 4);
  fleet.fly_on(2000);
  fleet.kill(UavIndex{1});
  ASSERT_TRUE(fleet.fly());
  const sim::RunSummary& summary = fleet.server().summary();
  EXPECT_EQ(summary.status, RunStatus::completed);
  EXPECT_FALSE(summary.deterministic);
  ASSERT_EQ(summary.lost.size(), 1U);
  EXPECT_EQ(summary.lost[0].name, "raffles");
}

TEST(FleetInOneProcess, EndsAtTheNextStepWhenTheUserSaysSo) {
  Fleet fleet("towers", "hover", 600.0, 5);
  fleet.fly_on(2000);
  fleet.server().request_stop();
  ASSERT_TRUE(fleet.fly());
  EXPECT_EQ(fleet.server().summary().status, RunStatus::interrupted);
}

}  // namespace
}  // namespace skein::test
