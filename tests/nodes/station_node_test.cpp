// The station with a ledger and a UAV that reports captures: it counts, acknowledges and stores those in the ledger.
#include "station/station_node.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "comm_router/router_node.hpp"
#include "core/radio/radio_routes.hpp"
#include "idl/conversions.hpp"
#include "results/run_folder.hpp"
#include "tests/nodes/toy_members.hpp"

namespace skein::test {
namespace {

constexpr std::uint64_t kCaptures = 6, kForged = 2, kSteps = 20;

class StationNodeTest : public testing::Test {
 protected:
  StationNodeTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "skein-station-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    for (std::uint64_t n = 0; n < kCaptures; ++n) {
      reports_.push_back(
          {UavIndex{0}, n, static_cast<Tick>(n), 100 + n, {{static_cast<std::uint32_t>(n), 1, 1, 0.5F, 1}}});
    }
  }
  ~StationNodeTest() override { std::filesystem::remove_all(folder_); }

  /// Flies a run in which UAV "a" repeatedly reports all captures, and a forged one with another token.
  /// @returns the acknowledged captures.
  std::set<std::uint64_t> run(std::optional<std::uint64_t> station_dies_at = {}) {
    std::set<std::uint64_t> acknowledged;
    const auto bus = bus::make_bus({.vendor = "inproc", .run = RunId{5}});
    ToyServer server(*bus, scenario_, kSteps);
    server.expect_uavs(scenario_);
    server.expect_station();
    server.expect_router();
    bus::CountedWriter ledger(server.world(), bus::spec(topics::ledger()));
    server.before_step = [&](std::uint64_t k) {
      if (k == 0) write_ledger(ledger);
      server.ledger_upto = reports_.size();
    };
    router::RouterNode router(scenario_, 0, 0, *bus);
    ToyMember uav(*bus, uav_domain(0, UavIndex{0}), "a");
    uav.client().declare_writer(bus::spec(topics::captures("a")), bus::LockstepClient::Counterpart::router);
    uav.client().read<msg::CaptureAck>(
        bus::spec(topics::captures_ack_at_uav("a")), bus::LockstepClient::Counterpart::router,
        [&](const msg::CaptureAck& ack) { acknowledged.insert(ack.captures().begin(), ack.captures().end()); });
    uav.on_step = [&](const msg::Step& step) {
      if (step.k() % 5 == 1) uav.client().write(topics::captures("a").name, messages());
    };
    auto station = std::make_unique<station::StationNode>(scenario_, 0, *bus, folder_, status_);
    router.start();
    uav.start();
    station->start();
    const std::vector<std::function<void()>> turns = {[&] { server.poll(); }, [&] { router.poll(); },
                                                      [&] { uav.poll(); }, [&] { station->poll(); }};
    if (station_dies_at) {
      EXPECT_TRUE(take_turns(turns, [&] { return server.k() == *station_dies_at; }));
      station.reset();
      server.lockstep().lost("station", "killed");
      station = std::make_unique<station::StationNode>(scenario_, 0, *bus, folder_, status_);
      station->start();
    }
    EXPECT_TRUE(take_turns(turns, [&] { return server.over(); })) << station->waiting_for();
    station->write_report(station->notes());
    return acknowledged;
  }

  nlohmann::json report() const {
    return nlohmann::json::parse(std::ifstream(folder_ / run_folder::report_file(programs::kStation)));
  }

  std::filesystem::path folder_;

 private:
  void write_ledger(bus::CountedWriter& ledger) const {
    auto message = bus::message_of<msg::Ledger>(RunId{5});
    message.interest_points(kCaptures);
    message.points().resize(kCaptures);
    for (const CaptureReport& report : reports_) {
      message.entries().push_back(to_message({report.capture, report.tick, report.uav, false, report}, uavs_));
    }
    ledger.begin_step();
    ledger.write(message);
  }
  msg::CaptureReports messages() const {
    msg::CaptureReports all;
    for (CaptureReport report : reports_) {
      if (report.capture == kForged) report.token ^= 1;
      all.reports().push_back(to_message(report, uavs_));
    }
    return all;
  }

  const Scenario scenario_ = toy_scenario(1);
  const std::vector<std::string> uavs_ = scenario_.uav_names();
  std::vector<CaptureReport> reports_;
  StatusPipe status_{-1};
};

const std::set<std::uint64_t> kHonest = {0, 1, 3, 4, 5};

TEST_F(StationNodeTest, CountsAndAcknowledgesOnlyReportsThatTheLedgerConfirms) {
  EXPECT_EQ(run(), kHonest);
  EXPECT_EQ(report()["points_detected"], kHonest.size());
  EXPECT_NEAR(report()["score"].get<double>(), 0.5 * static_cast<double>(kHonest.size()), 1e-6);
  EXPECT_GT(report()["duplicates"], 0);
}

TEST_F(StationNodeTest, ARestartedStationKeepsItsCountAndWorksAgain) {
  for (const std::uint64_t k : {1U, 4U, 9U}) {
    std::filesystem::remove(folder_ / run_folder::kJournal);
    EXPECT_EQ(run(k), kHonest) << "killed before step " << k;
    EXPECT_EQ(report()["points_detected"], kHonest.size()) << "killed before step " << k;
  }
}

}  // namespace
}  // namespace skein::test
