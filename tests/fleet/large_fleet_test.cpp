// A fleet that is too large for DDS flies in one process. Its results must not grow with the square of its size.
#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

constexpr int kUavs = 140;

class LargeFleet : public FleetTest {
 protected:
  SkeinRun& fly(const std::string& name, const std::string& threads) {
    return run(name, {"district", "--uavs", std::to_string(kUavs), "--one-process", "--planner", "patrol", "--duration",
                      "4", "--threads", threads});
  }
};

TEST_F(LargeFleet, ResultsListLinksThatHadLineOfSight) {
  SkeinRun& flown = fly("one", "1");
  const Json result = flown.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_EQ(result["uavs"].size(), std::size_t{kUavs});
  const Json& radio = result["radio"];
  std::set<std::pair<std::string, std::string>> links;
  double delivered = 0.0;
  for (const Json& link : radio["per_link"]) {
    EXPECT_GT(link["sent"], link["dropped_no_los"]) << link;
    EXPECT_TRUE(links.emplace(link["from"], link["to"]).second) << link;
    delivered += link["delivered"].get<double>();
  }
  EXPECT_GT(links.size(), std::size_t{kUavs}) << "UAVs that start beside each other must have links";
  EXPECT_LT(links.size(), std::size_t{kUavs * kUavs / 4});
  EXPECT_EQ(delivered, radio["delivered"].get<double>()) << "a link that is not listed has delivered messages";

  const std::string page = text_of(flown.dir() / "report.html");
  const std::size_t table = page.find("data-table=\"links\"");
  ASSERT_NE(table, std::string::npos);
  const std::string links_table = page.substr(table, page.find("</table>", table) - table);
  EXPECT_LT(links_table.size(), std::size_t{200 * (kUavs + 2)})
      << "the table must have a row for each sender, not for each link";
  EXPECT_NE(links_table.find("<td>gcs</td>"), std::string::npos);

  EXPECT_EQ(fly("two", "2").digest(), flown.digest());
}

}  // namespace
}  // namespace skein::test
