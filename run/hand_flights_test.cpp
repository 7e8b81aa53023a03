#include "run/hand_flights.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/types.hpp"

namespace skein::cli {
namespace {

const std::vector<std::string> kThree = {"ann", "bob", "cid"};

std::vector<std::string> hands_in(const std::string& text) { return flown_by_hand(parse_planners(text, kThree).uavs); }

std::string repeated_from(const std::string& text) {
  return planners_repeated(text, kThree, [](const std::string& uav) { return "runs/x/hand-" + uav + ".csv"; });
}

using Texts = std::vector<std::string>;

TEST(HandFlights, KnowsTheUavsThatAreFlownByHand) {
  EXPECT_EQ(hands_in("kios"), Texts{});
  EXPECT_EQ(hands_in("kios,bob=hand"), Texts{"bob"});
  EXPECT_EQ(hands_in("hand"), kThree);
  EXPECT_EQ(hands_in("bob=hand:safe=false,approach_mps=2"), Texts{"bob"});
  EXPECT_EQ(hands_in("bob=hand:hand-bob.csv"), Texts{}) << "the UAV is flown by a file";
  EXPECT_EQ(hands_in("bob=hand:file=hand-bob.csv,safe=false"), Texts{});
  EXPECT_EQ(hands_in("bob=hand@team/agent"), Texts{"bob"});
  EXPECT_EQ(hands_in("handy,bob=exec:hand"), Texts{});
  const auto yaml = std::filesystem::path(testing::TempDir()) / "hand_flights.yaml";
  std::ofstream(yaml) << "safe: false\n";
  EXPECT_EQ(hands_in("bob=hand:" + yaml.string()), Texts{"bob"});
  std::ofstream(yaml) << "safe: false\nfile: x.csv\n";
  EXPECT_EQ(hands_in("bob=hand:" + yaml.string()), Texts{});
}

TEST(HandFlights, AreRefusedIfNoViewerCanFly) {
  const auto planners = parse_planners("kios,bob=hand,cid=hand:safe=false", kThree).uavs;
  EXPECT_NO_THROW(check_hands(planners, true));
  EXPECT_NO_THROW(check_hands(parse_planners("bob=hand:x.csv", kThree).uavs, false));
  try {
    check_hands(planners, false);
    FAIL() << "accepted, although no viewer can fly the UAVs";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("--planner bob=hand: ")) << text;
    for (const char* part : {"bob, cid", "--view", "bob=hand:RUN/hand-bob.csv"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(HandFlights, AreRepeatedFromTheKeptFiles) {
  EXPECT_EQ(repeated_from("kios,bob=star"), "kios,bob=star");
  EXPECT_EQ(repeated_from("kios,bob=hand"), "kios,bob=hand:runs/x/hand-bob.csv");
  EXPECT_EQ(repeated_from("bob=hand"), "flock,bob=hand:runs/x/hand-bob.csv");
  EXPECT_EQ(repeated_from("kios:speed=1,bob=hand:safe=false,climb_mps=1,gcs=listen"),
            "kios:speed=1,bob=hand:file=runs/x/hand-bob.csv,safe=false,climb_mps=1,gcs=listen");
  EXPECT_EQ(repeated_from("hand@a/b"),
            "hand@a/b,ann=hand:runs/x/hand-ann.csv@a/b,bob=hand:runs/x/hand-bob.csv@a/b,"
            "cid=hand:runs/x/hand-cid.csv@a/b");
  for (const char* text : {"kios,bob=hand", "hand", "ann=hand:safe=false,gcs=none", "cid=exec:./mine --x 3,bob=hand"}) {
    const std::string again = repeated_from(text);
    const Planners planners = parse_planners(again, kThree), before = parse_planners(text, kThree);
    EXPECT_EQ(flown_by_hand(planners.uavs), Texts{}) << again;
    for (std::size_t i = 0; i < kThree.size(); ++i) {
      if (before.uavs[i].spec.starts_with("hand")) continue;
      EXPECT_EQ(written(planners.uavs[i]), written(before.uavs[i])) << again;
    }
    EXPECT_EQ(repeated_from(again), again) << "no UAV is left that is flown by hand";
  }
}

}  // namespace
}  // namespace skein::cli
