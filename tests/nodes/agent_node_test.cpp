// The nodes of a strategy's two programs, on a UAV and at the ground station: their inputs and outputs on topics.
#include "uav_agent/agent_node.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "comm_router/router_node.hpp"
#include "core/files/octree_bytes.hpp"
#include "core/math/random_stream.hpp"
#include "core/messages/view_topics.hpp"
#include "core/radio/radio_routes.hpp"
#include "core/vehicle/lidar_geometry.hpp"
#include "idl/conversions.hpp"
#include "idl/diagnostic_types.hpp"
#include "tests/nodes/toy_members.hpp"
#include "uav_agent/ground_node.hpp"

namespace skein::test {
namespace {

/// A planner that in each step repeats the messages that it has received, and climbs.
class Parrot final : public agent::Planner {
 public:
  explicit Parrot(std::vector<agent::PlannerInput>* seen = nullptr) : seen_(seen) {}
  agent::PlannerOutput plan(const agent::PlannerInput& input) override {
    agent::PlannerOutput out;
    out.motion = agent::Path{{{{0.0, 0.0, 5.0}}}};
    for (const agent::RadioMessage& message : input.radio) out.radio.push_back({"/talk", "a: " + message.text, {}});
    if (seen_ != nullptr) seen_->push_back(input);
    return out;
  }

 private:
  std::vector<agent::PlannerInput>* seen_;
};

/// A ground program that sends a message in every step.
class Greeter final : public agent::GroundProgram {
 public:
  std::vector<agent::RadioMessage> work(const agent::GroundInput& input) override {
    heard.insert(heard.end(), input.radio.begin(), input.radio.end());
    return {{"/talk", "hello " + std::to_string(input.k), {}}};
  }
  std::vector<agent::RadioMessage> heard;
};

/// A server with one UAV "a". fly() adds its agent and a router.
struct OneUav {
  OneUav(const Scenario& of, std::uint64_t steps) : scenario(of), server(*dds, scenario, steps) {
    server.expect("a", kDomain);
    server.expect_router();
    server.open_topics(kDomain, topics::uav_topics(), "a");
  }
  bus::CountedWriter& writer(const topics::WireTopic& topic) { return server.writer(kDomain, topic); }
  /// Flies until the server ends the run, with the turns of others after those of the agent.
  void fly(
      std::unique_ptr<agent::Planner> planner, const std::function<void()>& others = [] {}) {
    agent::AgentNode agent(scenario, kUav, std::move(planner), 0, *dds);
    router::RouterNode router(scenario, 0, 0, *dds);
    agent.start();
    router.start();
    ASSERT_TRUE(take_turns({[&] { server.poll(); }, [&] { router.poll(); }, [&] { agent.poll(); }, others}, [&] {
      return server.over();
    })) << agent.waiting_for();
  }

  inline static const UavIndex kUav{0};
  inline static const ToyServer::Domain kDomain = ToyServer::domain_of(kUav);
  const Scenario scenario;
  const std::unique_ptr<bus::Bus> dds = bus::make_bus({.vendor = "inproc"});
  ToyServer server;
};

TEST(AgentNode, FliesByOdometryAndAnswersTheGroundProgramByRadio) {
  constexpr std::uint64_t kSteps = 20;
  const Scenario scenario = toy_scenario(1);
  const UavIndex uav{0};
  const auto bus = bus::make_bus({.vendor = "inproc"});
  ToyServer server(*bus, scenario, kSteps);
  server.expect_uavs(scenario);
  server.expect(bus::kGcsName, 1);
  server.expect_router();
  server.open_topics(1, topics::gcs_topics(), "gcs");
  server.open_topics(ToyServer::domain_of(uav), topics::uav_topics(), "a");
  bus::CountedWriter& odometry = server.writer(ToyServer::domain_of(uav), topics::odometry("a"));
  std::vector<double> heights;
  server.on<msg::MultiDOFJointTrajectory>(ToyServer::domain_of(uav), topics::trajectory_command("a"),
                                          [&](const auto& message) {
                                            if (const auto command = from_trajectory(message))
                                              heights.push_back(command->p_WB.z());
                                          });
  server.before_step = [&](std::uint64_t k) { odometry.write(to_odometry(static_cast<Tick>(20 * k), "a", {})); };

  auto greeter = std::make_unique<Greeter>();
  const Greeter& ground_side = *greeter;
  agent::AgentNode agent(scenario, uav, std::make_unique<Parrot>(), 0, *bus);
  agent::GroundNode ground(scenario, std::move(greeter), 0, *bus);
  router::RouterNode router(scenario, 0, 0, *bus);
  agent.start();
  ground.start();
  router.start();
  ASSERT_TRUE(
      take_turns({[&] { server.poll(); }, [&] { router.poll(); }, [&] { agent.poll(); }, [&] { ground.poll(); }},
                 [&] { return server.over(); }))
      << agent.waiting_for() << ground.waiting_for();
  ASSERT_GT(heights.size(), kSteps / 2);
  EXPECT_TRUE(std::ranges::is_sorted(heights)) << "the UAV does not climb steadily";
  EXPECT_GT(heights.back(), heights.front());
  // Sent in step k, received and answered in k + 1, received at the station in k + 2.
  ASSERT_EQ(ground_side.heard.size(), kSteps - 2);
  for (std::uint64_t k = 0; k < kSteps - 2; ++k) {
    EXPECT_EQ(ground_side.heard[k].text, "a: hello " + std::to_string(k));
  }
  EXPECT_EQ(agent.malformed() + ground.malformed(), 0U);
}

TEST(AgentNode, ReadsTheQualityOfItsLinks) {
  constexpr std::uint64_t kSteps = 6;
  Scenario scenario = toy_scenario(2);
  scenario.conditions.radio = conditions_preset("breezy").radio;
  OneUav one(scenario, kSteps);
  const auto quality = [](std::uint64_t k) { return LinkQuality{-50.0 - static_cast<double>(k), 1000.0}; };
  one.server.before_step = [&](std::uint64_t k) {
    const auto tick = static_cast<Tick>(20 * k);
    one.writer(topics::radio_links("a"))
        .write(to_radio_links(tick, {{Node{2}, quality(k)}, {kStationNode, quality(2 * k)}}));
    one.writer(topics::odometry("a")).write(to_odometry(tick, "a", {}));
    one.writer(topics::neighbour_odometry("a"))
        .write(to_cloud(tick, std::vector<NeighbourPoint>{{.node = 0.0F, .qw = 1.0F}, {.node = 2.0F, .qw = 1.0F}}));
  };
  struct Heard {
    std::uint64_t k = 0;
    std::optional<LinkQuality> peer, station;
  };
  class Listener final : public agent::Planner {
   public:
    explicit Listener(std::vector<Heard>& heard) : heard_(heard) {}
    agent::PlannerOutput plan(const agent::PlannerInput& in) override {
      heard_.push_back({in.k, in.peers.all().at(0).link, in.station_link});
      return {};
    }

   private:
    std::vector<Heard>& heard_;
  };
  std::vector<Heard> heard;
  one.fly(std::make_unique<Listener>(heard));
  ASSERT_GE(heard.size(), kSteps - 1);
  for (const auto& [k, peer, station] : heard) {
    EXPECT_EQ(peer, quality(k)) << k;
    EXPECT_EQ(station, quality(2 * k)) << k;
  }
}

TEST(AgentNode, PublishesItsMapOnlyWhileAViewerReadsIt) {
  constexpr std::uint64_t kSteps = 200, kLooksFrom = 100;
  OneUav one(toy_scenario(1), kSteps);
  bus::CountedWriter& odometry = one.writer(topics::odometry("a"));
  bus::CountedWriter& key_frames = one.writer(topics::neighbour_keyframe("a"));
  RandomStream random(1, "hits", 0);
  std::vector<Eigen::Vector3f> hits;
  one.server.before_step = [&](std::uint64_t k) {
    odometry.write(to_odometry(static_cast<Tick>(20 * k), "a", {}));
    if (k % 7 != 0 || k >= kSteps - 40) return;
    std::vector<Eigen::Vector3f> frame;
    for (int i = 0; i < 20; ++i) {
      frame.push_back(
          Vector3d(random.uniform(20.0, 24.0), random.uniform(0.0, 4.0), random.uniform(5.0, 9.0)).cast<float>());
    }
    hits.insert(hits.end(), frame.begin(), frame.end());
    key_frames.write(to_cloud(static_cast<Tick>(20 * k), frame, 9.0F));
  };
  const auto viewer = one.dds->join(uav_domain(0, OneUav::kUav));
  std::unique_ptr<bus::Reader> reader;
  std::vector<msg::Octomap> shown;
  const auto look_on = [&] {
    if (one.server.k() < kLooksFrom || reader) return;
    reader = viewer->create_reader(bus::spec(topics::octomap("a")), [&](bus::Sample&& sample) {
      EXPECT_TRUE(decode(sample.payload, shown.emplace_back()));
    });
    EXPECT_TRUE(shown.empty()) << "the agent wrote its map before a viewer read it";
  };
  one.fly(std::make_unique<Parrot>(), look_on);
  ASSERT_GE(shown.size(), 2U);
  EXPECT_LE(shown.size(), 1 + (kSteps - kLooksFrom) / 20) << "the agent wrote its map more than once per second";
  double before = 0.0;
  for (const msg::Octomap& map : shown) {
    EXPECT_TRUE(map.binary());
    EXPECT_EQ(map.id(), "OcTree");
    EXPECT_EQ(map.header().frame_id(), "world");
    double volume = 0.0;
    std::vector<KnownCube> occupied;
    const std::string bytes(map.data().begin(), map.data().end());
    ASSERT_TRUE(visit_octree(bytes, map.resolution(), [&](const KnownCube& cube) {
      if (cube.occupied) occupied.push_back(cube);
      volume += cube.occupied ? std::pow(cube.edge_m, 3) : 0.0;
    }));
    EXPECT_GE(volume, before);
    before = volume;
    if (&map != &shown.back()) continue;
    EXPECT_GT(volume, 0.5);
    for (const KnownCube& cube : occupied) {
      EXPECT_TRUE(std::ranges::any_of(hits, [&](const Eigen::Vector3f& hit) {
        return (hit.cast<double>() - cube.middle_W()).cwiseAbs().maxCoeff() <= 0.5 * cube.edge_m + 0.25;
      })) << cube.middle_W().transpose();
    }
  }
}

// An observer receives the program's diagnostics once per second, and does not change the program's counts.
TEST(AgentNode, PublishesDiagnosticsWhileAViewerReadsThem) {
  constexpr std::uint64_t kSteps = 200, kLooksFrom = 100;
  OneUav one(toy_scenario(1), kSteps);
  bus::CountedWriter& odometry = one.writer(topics::odometry("a"));
  bus::CountedWriter& neighbours = one.writer(topics::neighbour_odometry("a"));
  one.server.before_step = [&](std::uint64_t k) {
    const Tick tick = static_cast<Tick>(20 * k);
    odometry.write(to_odometry(tick, "a", {}));
    std::vector<NeighbourPoint> points;
    if (k < 150) points.push_back({.node = 0});  // the station
    neighbours.write(to_cloud(tick, points));
  };
  const auto viewer = one.dds->join(uav_domain(0, OneUav::kUav));
  std::unique_ptr<bus::Reader> reader;
  std::vector<msg::DiagnosticArray> told;
  const auto look_on = [&] {
    if (one.server.k() < kLooksFrom || reader) return;
    reader = viewer->create_reader(bus::spec(topics::diagnostics()), [&](bus::Sample&& sample) {
      EXPECT_TRUE(decode(sample.payload, told.emplace_back()));
    });
  };
  one.fly(std::make_unique<Parrot>(), look_on);
  ASSERT_GE(told.size(), 4U);
  EXPECT_LE(told.size(), 1 + (kSteps - kLooksFrom) / 20);
  for (const msg::DiagnosticArray& array : told) {
    const auto k = static_cast<std::uint64_t>(from_time(array.header().stamp()) / 20);
    ASSERT_EQ(array.status().size(), 4U) << "the parts are radio, captures, flight and program";
    EXPECT_EQ(array.status()[0].name(), "a: radio");
    EXPECT_EQ(array.status()[0].level(), k < 150 ? 0 : 1);
    EXPECT_EQ(array.status()[0].values()[0].value(), k < 150 ? "gcs" : "");
    EXPECT_EQ(array.status()[3].values()[0].key(), "step");
    EXPECT_EQ(array.status()[3].values()[0].value(), std::to_string(k));
  }
}

TEST(AgentNode, RebuildsBeamsForThePlannerThatAsksAndReadsNoScansForAnother) {
  class Looker final : public agent::Planner {
   public:
    explicit Looker(std::vector<agent::BeamScan>& seen) : seen_(seen) {}
    agent::PlannerOutput plan(const agent::PlannerInput& input) override {
      seen_.insert(seen_.end(), input.beam_scans.begin(), input.beam_scans.end());
      return {};
    }
    bool wants_beams() const override { return true; }

   private:
    std::vector<agent::BeamScan>& seen_;
  };
  constexpr std::uint64_t kSteps = 20;
  Scenario scenario = toy_scenario(1);
  scenario.fleet[0].vehicle.lidar.emplace();
  const RigidBodyState state{.p_WB = {3.0, -2.0, 9.0}};
  const LidarConfig lidar;
  for (const bool asks : {true, false}) {
    OneUav one(scenario, kSteps);
    bus::CountedWriter& odometry = one.writer(topics::odometry("a"));
    bus::CountedWriter& cloud = one.writer(topics::cloud("a"));
    bus::CountedWriter& servo = one.writer(topics::lidar_servo("a"));
    one.server.before_step = [&](std::uint64_t k) {
      const Tick tick = static_cast<Tick>(20 * k);
      EXPECT_EQ(cloud.is_wanted(), asks);
      EXPECT_EQ(servo.is_wanted(), asks);
      odometry.write(to_odometry(tick, "a", state));
      if (k % 2 != 0 || !asks) return;
      const double angle = 0.01 * static_cast<double>(k);
      const Vector3d hit_W = lidar_pose(state.X_WB(), angle) * Vector3d(20.0 * lidar_direction_L(lidar, 3, 77));
      cloud.write(to_cloud(tick, std::vector<Eigen::Vector3f>{hit_W.cast<float>()}));
      servo.write(to_lidar_servo({tick, angle, 0.08}));
    };
    std::vector<agent::BeamScan> seen;
    std::unique_ptr<agent::Planner> planner = std::make_unique<Parrot>();
    if (asks) planner = std::make_unique<Looker>(seen);
    one.fly(std::move(planner));
    ASSERT_EQ(seen.size(), asks ? kSteps / 2 : 0U);
    for (const agent::BeamScan& beams : seen) {
      EXPECT_EQ(beams.doubt, agent::ScanDoubt::none);
      EXPECT_EQ(beams.points, 1U);
      EXPECT_EQ(beams.beam(3, 77).state, agent::BeamState::range);
      EXPECT_NEAR(beams.beam(3, 77).range_m, 20.0, 1e-4);
      EXPECT_EQ(beams.beam(3, 78).state, agent::BeamState::none);
    }
  }
}

TEST(AgentNode, KeepsCaptureReportsUntilTheStationAcknowledgesThem) {
  constexpr std::uint64_t kSteps = 40;
  OneUav one(toy_scenario(1), kSteps);
  one.server.expect_station();
  const std::vector<std::string> names = one.scenario.uav_names();
  bus::CountedWriter& card = one.writer(topics::capture());
  bus::CountedWriter& neighbours = one.writer(topics::neighbour_odometry("a"));
  std::multiset<std::uint64_t> stored;
  one.server.on<msg::CaptureAck>(OneUav::kDomain, topics::capture_stored(), [&](const msg::CaptureAck& ack) {
    stored.insert(ack.captures().begin(), ack.captures().end());
  });
  const auto report = [](std::uint64_t n) {
    return CaptureReport{
        UavIndex{0}, n, static_cast<Tick>(n), 7 * n, {{static_cast<std::uint32_t>(n), 0.5F, 0.6F, 0.3F, 0.7F}}};
  };
  one.server.before_step = [&](std::uint64_t k) {
    if (k < 10) {  // each report twice, because the server repeats reports
      msg::CaptureReports reports;
      for (const std::uint64_t n : {k / 2, k}) reports.reports().push_back(to_message(report(n), names));
      card.write(reports);
    }
    std::vector<NeighbourPoint> linked;
    if (k >= 5) linked.push_back({.node = 0.0F});
    neighbours.write(to_cloud(static_cast<Tick>(20 * k), linked));
  };
  // A station that acknowledges a report when it receives it for the second time.
  std::map<std::uint64_t, int> heard;
  std::vector<std::uint64_t> to_acknowledge;
  ToyMember station(*one.dds, gcs_domain(0), bus::kStationName);
  station.client().read<msg::CaptureReports>(
      bus::spec(topics::captures_at_station("a")), bus::LockstepClient::Counterpart::router,
      [&](const msg::CaptureReports& reports) {
        EXPECT_GE(one.server.k(), 6U) << "a report was sent without a link";
        for (const auto& message : reports.reports()) {
          EXPECT_EQ(from_message(message, names), report(message.capture())) << "the report was changed";
          if (++heard[message.capture()] == 2) to_acknowledge.push_back(message.capture());
        }
      });
  station.client().declare_writer(bus::spec(topics::captures_ack("a")), bus::LockstepClient::Counterpart::router);
  station.on_step = [&](const msg::Step&) {
    if (to_acknowledge.empty()) return;
    // Before each valid acknowledgement come damaged ones, with numbers of captures that the agent must keep.
    msg::CaptureAck damaged = to_capture_ack("a", to_acknowledge);
    damaged.captures().front() ^= 1;
    station.client().write(topics::captures_ack("a").name, damaged);
    damaged = to_capture_ack("b", {9});
    station.client().write(topics::captures_ack("a").name, damaged);
    station.client().write(topics::captures_ack("a").name, to_capture_ack("a", std::exchange(to_acknowledge, {})));
  };
  station.start();
  one.fly(std::make_unique<Parrot>(), [&] { station.poll(); });
  for (std::uint64_t n = 0; n < 10; ++n) {
    EXPECT_EQ(heard[n], 2) << "report " << n << " must be repeated until it is acknowledged, and not later";
    EXPECT_EQ(stored.count(n), 1U) << "the agent must tell the camera once that report " << n << " is stored";
  }
}

}  // namespace
}  // namespace skein::test
