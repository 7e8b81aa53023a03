// The times in which UAVs had no work: from the agents' reports to work.csv and the figures in result.json.
#include "results/work.hpp"

#include <gtest/gtest.h>

#include "results/csv_table.hpp"
#include "results/run_folder.hpp"
#include "results/testing/scratch.hpp"

namespace skein::results {
namespace {

class WorkTimes : public testing::Test {
 protected:
  WorkTimes() {
    for (const char* name : {"a", "b"}) {
      scenario_.fleet.emplace_back().name = name;
      reports_.agents[name] = AgentReport{};
    }
    reports_.sim_server = SimServerReport{};
  }
  void tell(const std::string& uav, const std::string& open, double done) {
    UavReport report;
    report.name = uav;
    report.work = WorkReport{open, std::vector<Amount>(open.size(), done)};
    reports_.sim_server->uavs.push_back(report);
  }

  Scenario scenario_;
  Reports reports_;
  Scratch dir_;
};

TEST_F(WorkTimes, WaitsAreMatchedByTheNameOfTheOtherUav) {
  tell("b", std::string(90, '1'), 0.5);  // the report has another order than the scenario
  tell("a", std::string(90, '1'), 0.0);
  reports_.agents["a"]->waits = {{10.0, 30.0, "b"}, {30.0, 60.0, "nobody"}, {40.0, {}, "b"}};
  const auto times = work_times(scenario_, reports_);
  EXPECT_EQ(times[0]->excused_s, 20u);
  EXPECT_EQ(times[0]->frozen_s, 70u);
  EXPECT_EQ(times[0]->longest_s, 70u);
  EXPECT_EQ(times[1]->frozen_s, 0u);
}

TEST_F(WorkTimes, WithoutReportsTheTimesAreUnknown) {
  tell("a", "11", 0.0);
  reports_.agents.clear();
  EXPECT_TRUE(work_times(scenario_, reports_)[0]);
  EXPECT_FALSE(work_times(scenario_, reports_)[1]);
  reports_.sim_server.reset();
  EXPECT_FALSE(work_times(scenario_, reports_)[0]);
}

TEST_F(WorkTimes, TheTableHasALineForEachSecond) {
  tell("a", "-01", 0.25);
  tell("b", "1", 1.0);
  reports_.agents["b"]->waits = {{0.0, 1.0, "a"}};
  write_work_csv(dir_.path(), scenario_, reports_);
  std::string lines;
  for (CsvTable table(dir_.path() / run_folder::kWork); table.next();) {
    for (const char* column : {"time_s", "uav", "open", "work", "waits_for", "without_work_s"}) {
      lines += table.text(column) + " ";
    }
    lines += "\n";
  }
  EXPECT_EQ(lines, "1 a - 0.25  0 \n1 b 1 1.0 a 0 \n2 a 0 0.25  0 \n3 a 1 0.25  1 \n");
}

}  // namespace
}  // namespace skein::results
