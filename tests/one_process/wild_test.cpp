// Worlds that no planner was made for, flown by all of them: nobody collides, nobody stays where it was set down.
#include <set>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Wild : public FleetTest {};

TEST_F(Wild, AllPlannersFlyInTenWorlds) {
  const std::size_t worlds = sanitizer().empty() ? 10 : 2;
  const std::vector<std::string> planners = {"kios", "patrol", "star", "xxh"};
  const std::string seeds = "100-" + std::to_string(100 + worlds - 1);
  ChildProcess& study =
      skein({"compare", "--planners", "kios,patrol,star,xxh", "--scenarios", "wild", "--scene-seeds", seeds, "--seeds",
             "0", "--duration", "60", "--require", "collisions==0", "--out", folder() / "study"});
  ASSERT_EQ(study.wait().code, 0) << study.err() << study.out();
  const auto flights = read_csv(folder() / "study" / "flights.csv");
  EXPECT_EQ(flights.size(), worlds * planners.size());
  std::set<std::string> flown;
  for (const auto& flight : flights) {
    flown.insert(flight.at("planner"));
    EXPECT_EQ(flight.at("collisions"), "0");
    EXPECT_GT(std::stod(flight.at("distance_m")), 5.0) << flight.at("planner") << " in " << flight.at("scenario");
  }
  EXPECT_EQ(flown, std::set<std::string>(planners.begin(), planners.end()));
}

}  // namespace
}  // namespace skein::test
