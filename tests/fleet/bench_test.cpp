// `skein bench` in its smallest size: it measures and reports every part. The tests require no speed.
#include "fleet_fixture.hpp"
#include "tests/free_domain.hpp"

namespace skein::test {
namespace {

using BenchTest = FleetTest;

void expect_speed(const Json& speed) {
  EXPECT_EQ(speed["uavs"], 5);
  EXPECT_GT(speed["real_time_factor"]["median"], 0.0);
  double share = 0.0;
  for (const auto& [kind, work] : speed["work"].items()) {
    EXPECT_GE(work["cpu_s"], 0.0) << kind;
    share += work["share"].get<double>();
  }
  EXPECT_NEAR(share, 1.0, 1e-9);
}

TEST_F(BenchTest, ASmallBenchReportsEveryPart) {
  const auto json = folder() / "bench.json";
  ChildProcess& bench = skein({"bench", "--quick", "--duration", "2", "--sizes", "1", "--json", json});
  ASSERT_EQ(bench.wait().code, 0) << bench.err();
  for (const char* word : {"real time", "exchange", "times the floor", "to the end", "targets"}) {
    EXPECT_NE(bench.out().find(word), std::string::npos) << word << "\n" << bench.out();
  }

  const Json report = Json::parse(text_of(json));
  EXPECT_GE(report["machine"]["cores"], 1);
  ASSERT_EQ(report["speed"].size(), report["machine"]["cores"] > 1 ? 3u : 2u)
      << "an entry for DDS, and for one process with one thread and, if there are more cores, with all";
  for (const Json& speed : report["speed"]) expect_speed(speed);
  const Json every_scan = report["speed"][0]["lidar"]["every_scan"];  // the same in every entry
  EXPECT_GT(every_scan["scans"], 40);                                 // two explorers, ten scans per second
  EXPECT_GT(every_scan["mean_returns"], 0.0);

  ASSERT_EQ(report["rounds"].size(), 1u);
  const Json& rounds = report["rounds"][0];
  EXPECT_EQ(rounds["vendor"], "cyclonedds");
  EXPECT_GT(rounds["fleet_rounds_per_s"]["median"], 0.0);
  EXPECT_GT(rounds["floor_rounds_per_s"]["median"], 0.0);
  EXPECT_NEAR(rounds["times_floor"]["median"].get<double>() * rounds["fleet_rounds_per_s"]["median"].get<double>(),
              rounds["floor_rounds_per_s"]["median"], 1e-6 * rounds["floor_rounds_per_s"]["median"].get<double>());

  ASSERT_EQ(report["scale"].size(), 2u);
  for (const Json& scale : report["scale"]) {
    EXPECT_EQ(scale["to_the_end"], true);
    EXPECT_GT(scale["memory_mb"]["median"], 0.0);
  }
  EXPECT_GE(report["targets"].size(), 4u);
}

TEST_F(BenchTest, TheProfileHasTheStagesAndPartsOfEachPlanner) {
  const auto json = folder() / "profile.json";
  ChildProcess& bench = skein({"bench", "--profile", "--duration", "2", "--sizes", "1,2", "--json", json});
  ASSERT_EQ(bench.wait().code, 0) << bench.err();
  const Json report = Json::parse(text_of(json));
  ASSERT_EQ(report["profile"].size(), 10U) << "an entry for each of five planners and two sizes";
  for (const Json& entry : report["profile"]) {
    const std::string planner = entry["planner"];
    EXPECT_NE(bench.out().find(planner + ": planner's own time by part"), std::string::npos) << bench.out();
    double parts_ms = 0.0;
    for (const Json& part : entry["parts"]) parts_ms += part["ms"].get<double>();
    EXPECT_GT(parts_ms, 0.0) << planner;
    EXPECT_LE(parts_ms, entry["stages"]["agents"]["ms"].get<double>() * (1.0 + 1e-9)) << planner;
    for (const char* part : {"planner/other", "flight/update", "maps/own beams"}) {
      EXPECT_TRUE(entry["parts"].contains(part)) << planner << ": " << entry["parts"];
    }
  }
}

TEST_F(BenchTest, TheFloorRunsOverBothVendors) {
  for (const std::string vendor : {"cyclonedds", "fastdds"}) {
    const FreeDomains domains(4);
    ChildProcess& floor = start_program(vendor, {program("bench_floor_" + vendor), "--uavs", "2", "--rounds", "50",
                                                 "--domain", std::to_string(domains.base())});
    ASSERT_EQ(floor.wait().code, 0) << floor.err();
    const Json report = Json::parse(floor.out());
    EXPECT_EQ(report["rounds"], 50);
    EXPECT_GT(report["cpu_s"], 0.0);
    EXPECT_EQ(report["messages"], 23);  // nine per UAV, five on the ground
  }
}

TEST_F(BenchTest, SensingWritesItsTablesAndPictures) {
  const std::string kept = "[//]: # (table: space)\nold\n[//]: # (end of table)\nkept\n";
  std::string page = kept;
  for (const char* name : {"surface", "reach", "messages", "vendors", "cost"}) {
    page += "[//]: # (table: " + std::string(name) + ")\n[//]: # (end of table)\n";
  }
  write("sensing.md", page);
  ChildProcess& bench = skein({"bench", "--sensing", "--quick", "--write", folder()});
  ASSERT_EQ(bench.wait().code, 0) << bench.err() << bench.out();
  for (const char* word : {"loose box", "lattice", "5 cm", "cyclonedds", "fastdds"}) {
    EXPECT_NE(bench.out().find(word), std::string::npos) << word << "\n" << bench.out();
  }
  const std::string written = text_of(folder() / "sensing.md");
  EXPECT_EQ(written.find("old"), std::string::npos);
  EXPECT_NE(written.find("kept\n"), std::string::npos);
  EXPECT_NE(written.find("| cyclonedds | "), std::string::npos) << written;
  for (const char* site : {"loose-box", "lattice"}) {
    for (const char* slice : {"level", "upright"}) {
      const auto file = folder() / "images" / ("sensing-" + std::string(site) + "-" + slice + ".svg");
      EXPECT_NE(text_of(file).find("</svg>"), std::string::npos) << file;
    }
  }
}

TEST_F(BenchTest, PythonPrintsARowForEachFigure) {
  const auto json = folder() / "python.json";
  ChildProcess& bench = skein({"bench", "--python", "--quick", "--duration", "2", "--json", json});
  ASSERT_EQ(bench.wait().code, 0) << bench.err() << bench.out();
  const Json report = Json::parse(text_of(json));
  EXPECT_GE(report["rows"].size(), 14U);
  for (const Json& row : report["rows"]) {
    EXPECT_NE(bench.out().find(row["name"].get<std::string>()), std::string::npos) << row;
    const bool grows = row["name"].get<std::string>().starts_with("growth");
    EXPECT_TRUE(grows || row["figure"]["median"].get<double>() > 0.0) << row;
  }
}

TEST_F(BenchTest, OptionsThatMakeNoSenseAreRefused) {
  for (const Arguments& arguments : std::vector<Arguments>{
           {"bench", "--sizes", "0"}, {"bench", "--dds", "mixed"}, {"bench", "--python", "--profile"}}) {
    EXPECT_EQ(skein(arguments).wait().code, 2);
  }
}

}  // namespace
}  // namespace skein::test
