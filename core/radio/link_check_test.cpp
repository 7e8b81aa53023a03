// Effects in a scenario's `radio.links` that change nothing, or name unknown nodes. fault_plan_test.cpp tests
// the effects of faults.
#include "core/radio/link_check.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

class ScenarioLinks : public ::testing::Test {
 protected:
  Scenario load(const std::string& link) const {
    std::ofstream(file_) << "radio: {links: [{" << link << "}]}\n"
                         << "desired_mm_per_pixel: 2\nscene: {family: towers}\n"
                         << "fleet: [{name: jurong, vehicle: explorer}, {name: changi, vehicle: photographer}]\n";
    LoadOptions options;
    options.config_dir = source_path("config");
    return load_scenario(file_, options);
  }
  std::string complaint(const std::string& link) const try {
    load(link);
    return "none";
  } catch (const InputError& error) {
    return error.what();
  }

  ScratchFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "linked.yaml";
};

TEST_F(ScenarioLinks, ThatChangeNothingAreRefusedAsInFaults) {
  const std::string at = file_.string() + ":1: radio.links[0]";
  for (const char* nothing : {"loss: 0", "from: jurong", "burst_loss: {mean_good_s: 1, mean_burst_s: 1, loss: 0}"}) {
    EXPECT_EQ(complaint(nothing).find(at + ": changes nothing: give at least one of loss"), 0U) << complaint(nothing);
  }
  EXPECT_EQ(complaint("from: jurong, to: [jurong], loss: 1").find(at + ".to: no node sends to itself"), 0U);
  EXPECT_EQ(complaint("loss: 1, queue_bytes: 100"), at + ".queue_bytes: " + kNeedsBandwidth);
  EXPECT_EQ(complaint("from: [changi, changi], loss: 1"), at + ".from: 'changi' is named twice");
  EXPECT_EQ(complaint("to: chang, loss: 1"), at + ".to: there is no node 'chang'; did you mean 'changi'?");
}

TEST_F(ScenarioLinks, ThatChangeSomethingReadBackAsTheyAreWritten) {
  for (const char* link : {"range_m: 50", "from: uavs, to: [uavs, gcs], loss: 0.5", "from: gcs, latency_s: 1",
                           "bandwidth_bit_s: 100, queue_bytes: 7, topics: [/plan]"}) {
    EXPECT_EQ(complaint(link), "none");
    const std::string printed = to_yaml(load(link));
    std::ofstream(folder_.path() / "again.yaml") << printed;
    EXPECT_EQ(to_yaml(load_scenario(folder_.path() / "again.yaml")), printed);
  }
}

}  // namespace
}  // namespace skein
