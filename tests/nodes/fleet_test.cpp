// A whole fleet in this process: the production nodes of server, router, station and agents, over a bus without
// threads. Nothing may depend on the order in which the nodes get their turns.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bus/lockstep/names.hpp"
#include "comm_router/router_node.hpp"
#include "core/math/random_stream.hpp"
#include "core/messages/view_topics.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "process/host/environment.hpp"
#include "process/json_text.hpp"
#include "results/run_folder.hpp"
#include "scenes/scene_source.hpp"
#include "sim_server/sim_node.hpp"
#include "station/station_node.hpp"
#include "tests/protocol/sim_network.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_program.hpp"
#include "uav_agent/agent_node.hpp"
#include "uav_agent/ground_node.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::test {
namespace {

struct Flight {
  std::string scenario = "towers", planner = "hover";
  LoadOptions load = {};
  std::uint64_t seed = 0;
  std::optional<double> stop_at_s = {};
  std::optional<view::LookOrder> look = {};  ///< what a viewer requests during the whole flight; none: no viewer
};

class Fleet {
 public:
  /// @param order    seed that draws the node with the next turn.
  /// @param network  the bus to use; `order` then also draws its events.
  Fleet(const Flight& flight, std::uint64_t order, SimNetwork* network = nullptr)
      : scenario_(load_scenario(flight.scenario, with_config(flight.load))),
        random_(order, "turns", 0),
        network_(network),
        bus_(network != nullptr ? std::make_unique<SimBus>(*network) : bus::make_bus({.vendor = "inproc"})) {
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-fleet-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    server_ =
        add(std::make_unique<sim::SimNode>(scenario_, sim::load_scene(scenario_),
                                           sim::SimNodeOptions{.base_domain = 0,
                                                               .out = folder_,
                                                               .seed = flight.seed,
                                                               .realtime_factor = {},
                                                               .stop_at_s = flight.stop_at_s,
                                                               .expect_gcs_program = has_ground_program(flight.planner),
                                                               .watch = watch_of(flight),
                                                               .faults = {}},
                                           *bus_, status_));
    add(std::make_unique<router::RouterNode>(scenario_, flight.seed, 0, *bus_));
    station_ = add(std::make_unique<station::StationNode>(scenario_, 0, *bus_, folder_, status_));
    for (const UavIndex uav : scenario_.uavs()) add(agent_of(uav, flight.planner));
    if (has_ground_program(flight.planner)) {
      auto program = agent::make_ground_program(flight.planner, agent::ground_config(scenario_));
      add(std::make_unique<agent::GroundNode>(scenario_, std::move(program), 0, *bus_));
    }
    if (flight.look) look_at(*flight.look);
    for (const auto& node : nodes_) node->start();
  }
  ~Fleet() { std::filesystem::remove_all(folder_); }

  /// Gives turns in random order until the run is over. @returns false if the run does not finish.
  bool fly() {
    for (std::uint64_t turn = 0; !server_->end() && turn < 20'000'000; ++turn) go_on();
    station_->write_report(station_->notes());
    return server_->end() == bus::NodeEnd::finished;
  }
  /// Gives this number of turns.
  void fly_on(int turns) {
    for (int i = 0; i < turns; ++i) go_on();
  }
  /// Kills a UAV's program.
  void kill(UavIndex uav) {
    nodes_[3 + uav].reset();
    server_->report_lost(scenario_.fleet[uav].name);
  }
  /// Starts another program in place of a UAV's that was killed.
  void start(UavIndex uav, const std::string& planner) {
    nodes_[3 + uav] = agent_of(uav, planner);
    nodes_[3 + uav]->start();
  }
  sim::SimNode& server() { return *server_; }
  /// The messages that the viewer has received.
  const std::vector<Json>& shown() const { return shown_; }
  std::size_t points() const {
    const auto report =
        nlohmann::json::parse(std::ifstream(folder_ / run_folder::report_file(programs::kStation)), nullptr, false);
    return report.value("points_detected", std::size_t{0});
  }

 private:
  static LoadOptions with_config(LoadOptions load) {
    load.config_dir = source_path("config");
    return load;
  }
  static bool has_ground_program(const std::string& planner) {
    return std::ranges::count(agent::ground_program_names(), planner) > 0;
  }
  static std::optional<sim::WatchOptions> watch_of(const Flight& flight) {
    return flight.look ? std::optional(sim::WatchOptions{.speed = std::nullopt}) : std::nullopt;
  }
  /// Requests points and maps, as the station does for a browser.
  void look_at(const view::LookOrder& look) {
    viewer_ = bus_->join(world_domain(0));
    orders_ = viewer_->create_writer(bus::spec(topics::view_orders()));
    clouds_ = viewer_->create_reader(bus::spec(topics::view_cloud()), [this](bus::Sample&& sample) {
      msg::String text;
      ASSERT_TRUE(decode(sample.payload, text));
      shown_.push_back(parse_json(text.data()));
    });
    order_.data(view::text_of(look));
  }
  /// One event: a match or a sample arrives, or a node gets a turn.
  void go_on() {
    if (orders_ && turns_++ % 5000 == 0) orders_->write(encode(order_));
    if (network_ != nullptr && random_.bits() % 2 == 0) {
      const auto events = network_->events();
      if (!events.empty()) return network_->happen(events[random_.bits() % events.size()]);
    }
    if (const auto& node = nodes_[random_.bits() % nodes_.size()]) node->poll();
  }

  std::unique_ptr<bus::LockstepNode> agent_of(UavIndex uav, const std::string& planner) {
    return std::make_unique<agent::AgentNode>(
        scenario_, uav, agent::make_planner(planner, agent::agent_config(scenario_, uav)), 0, *bus_);
  }

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
  SimNetwork* const network_;
  const std::unique_ptr<bus::Bus> bus_;
  std::vector<std::unique_ptr<bus::LockstepNode>> nodes_;
  sim::SimNode* server_ = nullptr;
  station::StationNode* station_ = nullptr;
  std::unique_ptr<bus::Participant> viewer_;  ///< null: there is no viewer
  std::unique_ptr<bus::Writer> orders_;
  std::unique_ptr<bus::Reader> clouds_;
  msg::String order_;
  std::uint64_t turns_ = 0;
  std::vector<Json> shown_;
};

TEST(FleetInOneProcess, TheOrderOfTurnsDoesNotChangeTheDigest) {
  std::set<std::string> digests;
  for (const std::uint64_t order : {1U, 2U, 3U}) {
    Fleet fleet({.planner = "patrol", .stop_at_s = 40.0}, order);
    ASSERT_TRUE(fleet.fly());
    ASSERT_TRUE(fleet.server().summary().deterministic);
    digests.insert(fleet.server().summary().digest.value_or("none"));
    EXPECT_GT(fleet.points(), 0U) << "no point got from a camera to the score";
  }
  EXPECT_EQ(digests.size(), 1U);
}

// A network that is harsher than DDS (tests/protocol/sim_network.hpp), with the production server.
TEST(FleetInOneProcess, TheOrderOfDiscoveryAndArrivalDoesNotChangeTheDigest) {
  Fleet calm({.planner = "patrol", .stop_at_s = 2.0}, 1);
  ASSERT_TRUE(calm.fly());
  for (const std::uint64_t order : {1U, 2U}) {
    SimNetwork network;
    Fleet fleet({.planner = "patrol", .stop_at_s = 2.0}, order, &network);
    ASSERT_TRUE(fleet.fly()) << network.describe();
    EXPECT_EQ(fleet.server().summary().digest, calm.server().summary().digest);
  }
}

// The times at which points and maps are sent to a viewer depend on wall time, but must not affect the flight. The
// planner "hover" reads no scans, so they are computed only for the page, and its map is that of key frames.
TEST(FleetInOneProcess, AViewerOfPointsAndMapsDoesNotChangeTheDigest) {
  for (const std::string planner : {"patrol", "hover"}) {
    const Flight flight{.planner = planner, .seed = 5, .stop_at_s = 15.0};
    std::optional<Fleet> unseen(std::in_place, flight, 1);
    ASSERT_TRUE(unseen->fly());
    EXPECT_TRUE(unseen->shown().empty());
    const auto digest = unseen->server().summary().digest;
    ASSERT_TRUE(digest);
    unseen.reset();  // ends this fleet, because two fleets in one process would exchange messages
    Flight seen_flight = flight;
    seen_flight.look = view::LookOrder{{"jurong", "nobody", "changi"}, "raffles"};
    Fleet seen(seen_flight, 2);
    ASSERT_TRUE(seen.fly());
    EXPECT_EQ(seen.server().summary().digest, digest) << planner;
    std::size_t points = 0, cubes = 0;
    for (const Json& cloud : seen.shown()) {
      const auto name = cloud["n"].get<std::string>();
      EXPECT_TRUE(name == "lidar jurong" || name == "map raffles") << name;
      for (const Json& step : cloud["steps"]) {
        if (step.contains("points")) points += view::unpacked_points(step["points"].get<std::string>()).size();
        if (step.contains("runs")) cubes += view::unpacked_runs(step["runs"].get<std::string>()).size();
      }
    }
    EXPECT_GT(points, 20U) << planner;
    EXPECT_GT(cubes, 5U) << planner;
  }
}

TEST(FleetInOneProcess, ContinuesWithoutALostUav) {
  Fleet fleet({.stop_at_s = 6.0}, 4);
  fleet.fly_on(2000);
  fleet.kill(UavIndex{1});
  ASSERT_TRUE(fleet.fly());
  const sim::RunSummary& summary = fleet.server().summary();
  EXPECT_EQ(summary.status, RunStatus::completed);
  EXPECT_FALSE(summary.deterministic);
  ASSERT_EQ(summary.lost.size(), 1U);
  EXPECT_EQ(summary.lost[0].name, "raffles");
}

TEST(FleetInOneProcess, AMemberThatIsLostBeforeItHasJoinedMayComeLater) {
  for (const int turns : {0, 2000}) {
    Fleet fleet({.stop_at_s = 4.0}, 4);
    fleet.kill(UavIndex{1});
    fleet.fly_on(turns);
    EXPECT_EQ(fleet.server().summary().lost.size(), turns > 0 ? 1U : 0U);
    fleet.start(UavIndex{1}, "hover");
    ASSERT_TRUE(fleet.fly());
    const sim::RunSummary& summary = fleet.server().summary();
    ASSERT_EQ(summary.lost.size(), 1U);
    ASSERT_TRUE(summary.lost[0].back) << "after " << turns << " turns";
    EXPECT_EQ(*summary.lost[0].back > 0, turns > 0);
  }
}

TEST(FleetInOneProcess, EndsAtTheNextStepWhenTheUserStopsIt) {
  Fleet fleet({}, 5);
  fleet.fly_on(2000);
  fleet.server().request_stop();
  ASSERT_TRUE(fleet.fly());
  EXPECT_EQ(fleet.server().summary().status, RunStatus::interrupted);
}

}  // namespace
}  // namespace skein::test

// With the environment of a fleet's programs, because libm chooses its code when a process starts.
int main(int argc, char** argv) {
  skein::take_fleet_environment(argv);
  return skein::run_test_program(argc, argv);
}
