// `skein keys`: a secured fleet whose programs are started individually, each with the keys that were made for it.
#include <signal.h>

#include <algorithm>

#include "by_hand_fixture.hpp"

namespace skein::test {
namespace {

class Keys : public ByHand, public testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    ChildProcess& made = skein(
        {"keys", "towers", "--dds", GetParam(), "--domain", std::to_string(domains_.base()), "--out", keys_.string()});
    ASSERT_EQ(made.wait().code, 0) << made.err();
  }
  Options secured() const {
    return {.all = {"--duration", "45", "--dds", GetParam()}, .server = {"--agent-timeout", "20"}, .keys = keys_};
  }

  const std::filesystem::path keys_ = folder() / "keys";
};

TEST_P(Keys, AFleetWithKeysFliesAsOneWithout) {
  SkeinRun& open = run("open", {"towers", "--planner", "patrol", "--duration", "45", "--dds", GetParam()});
  start_fleet(secured());
  for (const auto& [name, process] : fleet_) EXPECT_EQ(process->wait().code, 0) << name << ": " << process->err();
  EXPECT_EQ(server_report()["status"], "completed");
  EXPECT_EQ(server_report()["digest"], open.digest());
  const Json score = Json::parse(text_of(dir_ / "station.report.json"))["score"];
  EXPECT_EQ(score, open.result()["score"]);
  EXPECT_GT(score, 0.0);
}

TEST_P(Keys, AProgramWithAnotherProgramsKeysCannotJoin) {
  const std::string thief = "uav_agent-jurong";
  Options options = secured();
  options.server = {"--startup-timeout", "20"};
  Arguments argv = command(thief, options);
  std::ranges::replace(argv, (keys_ / thief).string(), (keys_ / "uav_agent-raffles").string());
  start_fleet(options, {{thief, argv}});
  fleet_.at("sim_server")->wait();
  const Json report = server_report();
  EXPECT_EQ(report["lost_members"].size(), 1u) << report;
  fleet_.at(thief)->signal(SIGTERM);
  fleet_.at(thief)->wait();
}

INSTANTIATE_TEST_SUITE_P(Vendors, Keys, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

}  // namespace
}  // namespace skein::test
