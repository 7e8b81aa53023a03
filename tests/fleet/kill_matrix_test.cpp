// Kills programs (kVictims) at random times: all of them by a fault file, or one by a signal from outside. The run must
// still end, and its results must have every capture that the station has acknowledged. SKEIN_LONG=1 uses more seeds.
#include <signal.h>

#include <map>

#include "core/math/random_stream.hpp"
#include "fleet_fixture.hpp"
#include "station/journal.hpp"

namespace skein::test {
namespace {

const Arguments kMinute = {"towers", "--planner", "patrol", "--duration", "60"};
const std::vector<std::string> kVictims = {"comm_router", "station", "sentosa", "changi",
                                           "nanyang",     "jurong",  "raffles"};

std::string program_of(const std::string& member) {
  return member == "comm_router" || member == "station" ? member : "uav_agent-" + member;
}

class KillMatrix : public FleetTest, public testing::WithParamInterface<std::uint64_t> {
 protected:
  /// Expects that the delivered captures in captures.csv are exactly those in the station's journal, and that the score
  /// is the sum of each point's best delivered quality.
  static void expect_custody(const SkeinRun& run) {
    using Key = std::pair<std::string, std::uint64_t>;
    std::map<Key, double> journalled, delivered;
    // The journal returns only the records of the run that it is opened for, so this must be the run's own.
    const Json flight = Json::parse(text_of(run.dir() / "sim_server.report.json"))["flight"];
    const station::Journal journal(run.dir() / "station.journal", RunId{flight["run"].get<std::uint64_t>()});
    for (const station::TallyRecord& record : journal.replayed()) {
      if (record.entry.collision) continue;
      const Key key{kFleet.at(record.entry.uav), record.entry.capture.capture};
      EXPECT_TRUE(journalled.emplace(key, seconds(record.tick)).second) << key.first << " " << key.second << " twice";
    }
    std::map<std::string, double> best;
    for (const auto& row : read_csv(run.dir() / "captures.csv")) {
      if (row.at("delivered_at_s").empty()) continue;
      delivered[{row.at("uav"), std::stoull(row.at("capture"))}] = std::stod(row.at("delivered_at_s"));
      best[row.at("point")] = std::max(best[row.at("point")], std::stod(row.at("q")));
    }
    EXPECT_EQ(delivered.size(), journalled.size());
    for (const auto& [key, time_s] : journalled) {
      ASSERT_TRUE(delivered.contains(key)) << key.first << " " << key.second << " was acknowledged and is missing";
      EXPECT_NEAR(delivered.at(key), time_s, 1e-6);
    }
    double score = 0.0;
    for (const auto& [point, q] : best) score += q;
    EXPECT_NEAR(run.result()["score"].get<double>(), score, 1e-3);
  }
};

TEST_P(KillMatrix, KillsByAFaultFileLoseNoAcknowledgedCapture) {
  RandomStream random(GetParam(), "kill_matrix", 0);
  std::string faults = "faults:\n";
  for (const std::string& victim : kVictims) {
    const double at_s = 10.0 + 35.0 * random.uniform(), until_s = at_s + 0.05 + 8.0 * random.uniform();
    faults +=
        "  - {at_s: " + std::to_string(at_s) + ", until_s: " + std::to_string(until_s) + ", kill: " + victim + "}\n";
  }
  std::vector<Arguments> ways = {{"--one-process"}, {"--dds", GetParam() % 2 == 0 ? "mixed" : "cyclonedds"}};
  if (long_tests()) ways.push_back({"--dds", "fastdds"});
  std::set<std::string> digests;
  for (const Arguments& way : ways) {
    Arguments arguments = kMinute;
    arguments.insert(arguments.end(), {"--faults", write("faults.yaml", faults)});
    arguments.insert(arguments.end(), way.begin(), way.end());
    SkeinRun& done = run("scripted" + way.back(), arguments);
    expect_complete_result(done);
    const Json result = done.result();
    EXPECT_TRUE(result["deterministic"]) << faults;
    EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
    EXPECT_EQ(result["faults"].size(), kVictims.size());
    EXPECT_GT(result["score"], 10.0) << faults;
    expect_custody(done);
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U) << faults;
}

TEST_P(KillMatrix, AKillFromOutsideLosesNoAcknowledgedCapture) {
  const std::string victim = kVictims[GetParam() % kVictims.size()];
  Arguments arguments = kMinute;
  arguments.insert(arguments.end(), {"--dds", "mixed"});
  SkeinRun& hit = start("outside", arguments);
  // The time of the kill depends on the machine; custody must hold for any time.
  const std::uintmax_t bytes = 20'000 + RandomStream(GetParam(), "kill_matrix", 1).bits() % 100'000;
  const bool there = eventually([&] {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(hit.dir() / "trajectories.csv", missing);
    return (!missing && size > bytes) || hit.skein().ended();
  });
  ASSERT_TRUE(there && !hit.skein().ended()) << hit.err();
  ::kill(processes_of(hit.dir()).at(program_of(victim)), SIGKILL);
  EXPECT_EQ(hit.exit_code(), 3) << hit.err();
  expect_complete_result(hit);
  const Json result = hit.result();
  EXPECT_EQ(result["status"], "completed");
  ASSERT_EQ(result["lost_members"].size(), 1U);
  EXPECT_EQ(result["lost_members"][0]["member"], victim);
  expect_custody(hit);
}

INSTANTIATE_TEST_SUITE_P(Seeds, KillMatrix, testing::Range<std::uint64_t>(1, long_tests() ? 21 : 5));

}  // namespace
}  // namespace skein::test
