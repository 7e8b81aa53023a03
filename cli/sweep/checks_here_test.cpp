// The checks of a sweep that the controller's own machine flies.
#include <gtest/gtest.h>

#include "cli/sweep/testing/made_up_nodes.hpp"

namespace skein::cli {
namespace {

// All flights are over then, so their results must not be lost.
TEST(ChecksHere, AFlightThatFailsOnThisMachineDoesNotEndTheSweep) {
  for (const bool disputed : {false, true}) {
    constexpr std::size_t kFlights = 12, kUnit = 2;
    MadeUpWorld world(1, kFlights);
    std::vector<MadeUpNode> nodes = {{"sound"}};
    if (disputed) nodes.push_back({.name = "odd", .odd_once_proved = true});
    MadeUpEngine engine(world, nodes);
    MadeUpNode here{"here"};
    SweepFolder folder = world.folder();
    const SweepNode node = world.node(here, [] {});
    std::ostringstream said;
    SweepController controller(folder, engine, node, said);
    controller.plan(world.plan(kUnit));
    here.disk_fills = 1.0;
    EXPECT_TRUE(controller.fly());
    EXPECT_NE(said.str().find("flown again, fails: "), std::string::npos) << said.str();
    EXPECT_NE(said.str().find("; its digest is not checked here\n"), std::string::npos) << said.str();
    std::size_t rows = 0;
    controller.collect([&](const SweepRow&) { ++rows; });
    EXPECT_EQ(rows, kFlights);
    EXPECT_TRUE(folder.quarantined_nodes().empty()) << "a machine that cannot fly a flight again blames no other";
  }
}

}  // namespace
}  // namespace skein::cli
