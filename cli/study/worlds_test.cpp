// Studies over many scenes: the order of the worst flights, and their description.
#include "cli/study/worlds.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/math/random_stream.hpp"

namespace skein::cli {
namespace {

class Worlds : public testing::Test {
 protected:
  Worlds() {
    study_.planners = {"kios", "star"};
    study_.seeds = {0};
  }

  FlightEntry& add(std::size_t planner, double percent, int collisions = 0, int frozen = 0) {
    FlightEntry entry{planner, study_.scenarios.size(), 0, {}, FlightFigures(), ""};
    entry.figures->attainable_percent = percent;
    entry.figures->collisions = collisions;
    entry.figures->frozen_uavs = frozen;
    study_.scenarios.push_back("wild " + std::to_string(study_.scenarios.size()));
    entry.command = "./skein run wild --scene-seed " + std::to_string(study_.flights.size());
    return study_.flights.push_back(std::move(entry));
  }
  std::string printed() const {
    std::ostringstream out;
    print_worlds(out, study_);
    return out.str();
  }

  Study study_;
};

TEST_F(Worlds, WorstFlightsAreOrderedByFailureCollisionsFrozenUavsAndShare) {
  add(0, 80.0);
  add(0, 3.0);
  add(0, 50.0, 0, 1);
  add(0, 60.0, 1);
  add(0, 0.0).figures.reset();
  study_.flights.back().problem = "skein run ended with exit code 3";
  const auto worst = worst_flights(study_, 4);
  ASSERT_EQ(worst.size(), 4u);
  EXPECT_EQ(worst[0], &study_.flights[4]);
  EXPECT_EQ(worst[1], &study_.flights[3]);
  EXPECT_EQ(worst[2], &study_.flights[2]);
  EXPECT_EQ(worst[3], &study_.flights[1]);
}

// Such flights are left after Ctrl-C, and while a sweep goes on.
TEST_F(Worlds, FlightsThatAreNotOverAreNotTheWorstAndBreakNoRequirement) {
  add(0, 80.0);
  add(0, 0.0).figures.reset();
  ASSERT_EQ(worst_flights(study_, 10).size(), 1u);
  EXPECT_EQ(printed().find("failed"), std::string::npos) << printed();
  std::ostringstream out;
  EXPECT_TRUE(print_requirements(out, study_, {parse_requirement("attainable_percent>50")}));
  EXPECT_EQ(out.str(), "");
  study_.flights.back().problem = "skein run ended with exit code 3";
  EXPECT_FALSE(print_requirements(out, study_, {parse_requirement("attainable_percent>50")}));
  EXPECT_EQ(out.str().find("\nrequirements not met:\n"), 0U) << out.str();
}

TEST_F(Worlds, FlightsAreSortedAndTheCommandsOfTheTenWorstArePrinted) {
  RandomStream random(1, "worlds_test", 0);
  for (int i = 0; i < 60; ++i) {
    add(random.uniform() < 0.5 ? 0 : 1, random.uniform(0.0, 100.0), random.uniform() < 0.1 ? 1 : 0,
        random.uniform() < 0.2 ? 1 : 0);
  }
  const auto all = worst_flights(study_, 1000);
  ASSERT_EQ(all.size(), 60u);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const FlightFigures &a = *all[i - 1]->figures, &b = *all[i]->figures;
    EXPECT_GE(a.collisions, b.collisions);
    if (a.collisions == b.collisions && a.frozen_uavs == b.frozen_uavs) {
      EXPECT_LE(*a.attainable_percent, *b.attainable_percent);
    }
  }
  const std::string text = printed();
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NE(text.find(all[i]->command + "\n"), std::string::npos) << i;
  EXPECT_EQ(text.find(all[20]->command + "\n"), std::string::npos);
}

TEST_F(Worlds, PlannersHaveTheirMedianAndTenthPercentile) {
  for (int i = 0; i <= 10; ++i) add(1, 10.0 * i);
  EXPECT_NE(printed().find("star                          11      50.0      10.0       0.0"), std::string::npos)
      << printed();
}

TEST_F(Worlds, PlannersHaveTheirIdleAndWaitingTimes) {
  add(1, 50.0, 0, 1).figures->frozen_s = 100.0;
  add(1, 50.0, 0, 2).figures->frozen_s = 70.4;
  study_.flights.back().figures->waited_s = 31.0;
  EXPECT_NE(printed().find("       2       170           31           0\n"), std::string::npos) << printed();
  std::ostringstream out;
  EXPECT_FALSE(print_requirements(out, study_, {parse_requirement("frozen_s<=80"), parse_requirement("waited_s<40")}));
  EXPECT_NE(out.str().find("frozen_s<=80: 100 in wild 0"), std::string::npos) << out.str();
}

TEST_F(Worlds, RequirementsNameTheFlightsThatBreakThem) {
  add(0, 80.0);
  add(1, 60.0, 1);
  std::ostringstream out;
  EXPECT_FALSE(print_requirements(out, study_, {parse_requirement("collisions==0")}));
  EXPECT_NE(out.str().find("collisions==0: 1 in wild 1, star, seed 0\n    ./skein run wild --scene-seed 1\n"),
            std::string::npos)
      << out.str();
  std::ostringstream none;
  EXPECT_TRUE(print_requirements(none, study_, {parse_requirement("attainable_percent>50")}));
  EXPECT_EQ(none.str(), "");
}

}  // namespace
}  // namespace skein::cli
