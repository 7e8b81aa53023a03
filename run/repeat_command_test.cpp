// The command that repeats a run in which viewers flew UAVs or added faults.
#include "run/repeat_command.hpp"

#include <gtest/gtest.h>

namespace skein::cli {
namespace {

TEST(RepeatCommand, HasNoOptionsOfThePage) {
  const Repeated by{.planners = "bob=hand:x.csv"};
  EXPECT_EQ(command_repeated("skein run towers --planner kios,bob=hand --view --duration 60", by),
            "skein run towers --planner bob=hand:x.csv --duration 60");
  EXPECT_EQ(
      command_repeated(
          "skein run --view 8080 --planner=bob=hand --speed 2 --pause-at 0 --out a --force --view-close towers", by),
      "skein run --planner bob=hand:x.csv towers");
  EXPECT_EQ(command_repeated("skein run --view=8080 --pause-at=12.5 --out=a --speed=max --planner bob=hand", by),
            "skein run --planner bob=hand:x.csv");
  for (const char* place : {"8080", "0.0.0.0:8080", "'[::1]:8080'", "localhost:8080"}) {
    EXPECT_EQ(command_repeated(std::string("skein run --view ") + place + " towers --no-browser", {}),
              "skein run towers")
        << place;
  }
}

TEST(RepeatCommand, HasTheNewFaultFileInThePlaceOfTheFormerOne) {
  const auto with_faults = [](const std::string& command, const char* file) {
    return command_repeated(command, {.faults = file});
  };
  EXPECT_EQ(with_faults("skein run towers --planner kios", "runs/x/by-hand.yaml"),
            "skein run towers --planner kios --faults runs/x/by-hand.yaml");
  EXPECT_EQ(with_faults("skein run towers --faults 'a b.yaml' --seed 3", "new one.yaml"),
            "skein run towers --seed 3 --faults 'new one.yaml'");
  EXPECT_EQ(with_faults("skein run --faults=old.yaml towers --view", "n.yaml"), "skein run towers --faults n.yaml");
  EXPECT_EQ(with_faults("skein run towers --faults", "n.yaml"), "skein run towers --faults n.yaml");
}

}  // namespace
}  // namespace skein::cli
