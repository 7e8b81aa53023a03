// The cost of the page: draw calls, bytes sent, and memory over an hour, for a large artificial flight that the test
// advances, so that nothing depends on the clock. Also, what the page shows about poor pictures.
#include "view_fixture.hpp"

namespace skein::test {
namespace {

class FiguresOfThePage : public BrowserTest {};

TEST_F(FiguresOfThePage, StayWithinTheirBoundsOverAnHour) {
  look("figures", folder() / "door.html", helper_program("view_feeder"));
}

class PoorPictures : public FleetTest {};

TEST_F(PoorPictures, AreShownWithThePartOfTheQualityThatLowersItMost) {
  if (command_file("node").empty()) GTEST_SKIP() << "Node.js is not installed";
  ChildProcess& node = start_program("poor", {command_file("node"), source_path("tests/view/poor.mjs")});
  EXPECT_EQ(node.wait(kBrowserPatience).code, 0) << node.err();
  EXPECT_EQ(node.out(), "");
}

class EarlyDeliveries : public FleetTest {};

TEST_F(EarlyDeliveries, AreShownOnceTheirCapturesHaveArrived) {
  if (command_file("node").empty()) GTEST_SKIP() << "Node.js is not installed";
  ChildProcess& node = start_program("deliveries", {command_file("node"), source_path("tests/view/deliveries.mjs")});
  EXPECT_EQ(node.wait(kBrowserPatience).code, 0) << node.err();
  EXPECT_EQ(node.out(), "");
}

}  // namespace
}  // namespace skein::test
