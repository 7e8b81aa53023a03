// Radio topics that two programs of a user register during a run, with a type that no other program has: their messages
// arrive complete and in order, identically in every run.
#include <sstream>

#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

const std::string kTalkers =
    "hover,sentosa=exec:" + program("bench_chatter") + ",changi=exec:" + program("bench_chatter");

class RadioTopics : public FleetTest {
 protected:
  /// Number of messages that a talker has received, from the last line of its log.
  static long heard(const SkeinRun& run, const std::string& uav) {
    std::istringstream log(text_of(run.dir() / ("uav_agent-" + uav + ".log")));
    std::string line, last;
    while (std::getline(log, line)) last = line;
    const Json report = Json::parse(last, nullptr, false);
    return report.is_object() ? report["heard"].get<long>() : -1;
  }
};

TEST_F(RadioTopics, TwoProgramsHearEachOtherOverBothVendors) {
  std::set<std::string> digests;
  for (const std::string vendor : {"cyclonedds", "fastdds", "mixed"}) {
    SkeinRun& done = run(vendor, {"towers", "--duration", "10", "--dds", vendor, "--planner", kTalkers});
    const Json result = done.result();
    EXPECT_EQ(result["status"], "completed");
    EXPECT_TRUE(result["deterministic"]);
    std::size_t found = 0;
    for (const Json& link : result["radio"]["per_link"]) {
      const bool between = link["from"] == "sentosa" && link["to"] == "changi";
      if (between) {
        ++found;
        EXPECT_EQ(heard(done, "changi"), link["delivered"].get<long>() - 1)
            << "only messages of the last step may not arrive";
      }
    }
    EXPECT_EQ(found, 1U) << "links from sentosa to changi";
    EXPECT_GT(heard(done, "sentosa"), 150);
    EXPECT_EQ(result["radio"]["malformed"], 0);
    digests.insert(done.digest());
  }
  EXPECT_EQ(digests.size(), 1U);
}

}  // namespace
}  // namespace skein::test
