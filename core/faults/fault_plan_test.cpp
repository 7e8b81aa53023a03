// Fault files: reading, the times at which faults act, and the messages about invalid files.
#include "core/faults/fault_plan.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "core/faults/fault_writer.hpp"
#include "core/text/suggestion.hpp"
#include "tests/support/places.hpp"

namespace skein {
namespace {

Scenario fleet() {
  Scenario scenario;
  scenario.conditions = conditions_preset("breezy");
  scenario.name = "small";
  scenario.duration_s = 300.0;
  for (const char* name : {"jurong", "changi"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  scenario.fleet[0].vehicle.lidar.emplace();
  return scenario;
}

class FaultFile : public testing::Test {
 protected:
  FaultFile() {
    std::string name = std::string("skein_") + testing::UnitTest::GetInstance()->current_test_info()->name();
    file_ = std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()) + ".yaml");
  }
  ~FaultFile() override { std::filesystem::remove(file_); }

  FaultPlan load(const std::string& text) {
    std::ofstream(file_) << text;
    return load_fault_plan(file_, fleet());
  }
  void refused(const std::string& text, const std::string& words) {
    try {
      load(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos) << error.what();
    }
  }

  std::filesystem::path file_;
};

TEST_F(FaultFile, NoFileMeansNoFaults) { EXPECT_TRUE(load_fault_plan({}, fleet()).empty()); }

TEST_F(FaultFile, EveryKindIsRead) {
  const FaultPlan plan = load(
      "name: all\n"
      "faults:\n"
      "  - {at_s: 1, until_s: 2, link: {from: [jurong], to: gcs, loss: 0.5, burst_loss: {mean_good_s: 5, mean_burst_s: "
      "1}}}\n"
      "  - {at_s: 1, partition: [[gcs, jurong], [changi]]}\n"
      "  - {at_s: 1, blackout: changi}\n"
      "  - {at_s: 1, until_s: 3, station_outage: true}\n"
      "  - {at_s: 1, until_s: 9, kill: comm_router}\n"
      "  - {at_s: 1, until_s: 9, pause: jurong}\n"
      "  - {at_s: 1, lidar_failure: jurong}\n"
      "  - {at_s: 1, camera_failure: changi}\n"
      "  - {at_s: 1, motor_failure: {uav: changi, rotor: 3, thrust: 0.5}}\n"
      "  - {at_s: 1, command_delay: {uav: changi, exchanges: 3}}\n"
      "  - {at_s: 1, for_s: 2, odometry_freeze: changi}\n"
      "  - {at_s: 4, odometry_jump: {uav: changi, offset_m: [1, 0, 0]}}\n"
      "  - {when: 'held(changi) >= 3', stuck_gimbal: changi}\n"
      "  - {at_s: 1, gust: {uav: changi, velocity_mps: [0, 8, 0]}}\n"
      "  - {at_s: 1, for_s: 9, fix_loss: jurong}\n"
      "  - {at_s: 1, battery_loss: {uav: changi, charge: 0.3}}\n"
      "  - {at_s: 1, conditions: {wind: {mean_mps: 9}, camera: {preset: harsh}}}\n");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"link", "jurong > gcs"},      {"partition", "gcs jurong | changi"},
      {"blackout", "changi"},        {"station_outage", "gcs"},
      {"kill", "comm_router"},       {"pause", "jurong"},
      {"lidar_failure", "jurong"},   {"camera_failure", "changi"},
      {"motor_failure", "changi"},   {"command_delay", "changi"},
      {"odometry_freeze", "changi"}, {"odometry_jump", "changi"},
      {"stuck_gimbal", "changi"},    {"gust", "changi"},
      {"fix_loss", "jurong"},        {"battery_loss", "changi"},
      {"conditions", "wind camera"}};
  ASSERT_EQ(plan.faults.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(fault_kind(plan.faults[i]), expected[i].first);
    EXPECT_EQ(fault_target(plan.faults[i]), expected[i].second);
  }
}

TEST_F(FaultFile, MayBeAFaultTestAndMayNameAnotherFaultFile) {
  ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
  EXPECT_EQ(load("faults: [{at_s: 1, blackout: changi}]\nrun: {seed: 1}\nexpect: {}\n").faults.size(), 1u);
  const std::filesystem::path other = file_.string() + "_other.yaml";
  std::filesystem::copy_file(file_, other);
  const FaultPlan plan = load("name: mine\nfaults: ./" + other.filename().string());
  EXPECT_EQ(plan.name, "mine");
  ASSERT_EQ(plan.faults.size(), 1u);
  EXPECT_EQ(fault_target(plan.faults[0]), "changi");
  std::filesystem::copy_file(file_, other, std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(load("faults: ./" + other.filename().string()), InputError)
      << "the named file must not name a third one";
  std::filesystem::remove(other);
  ::unsetenv("SKEIN_CONFIG_DIR");
}

TEST_F(FaultFile, AFaultActsFromItsBeginUntilItsEnd) {
  const FaultPlan plan = load("faults: [{at_s: 10, until_s: 12.5, blackout: jurong}]");
  EXPECT_FALSE(plan.faults[0].active(ticks(10.0) - 1));
  EXPECT_TRUE(plan.faults[0].active(ticks(10.0)));
  EXPECT_TRUE(plan.faults[0].active(ticks(12.5) - 1));
  EXPECT_FALSE(plan.faults[0].active(ticks(12.5)));
}

TEST_F(FaultFile, TimesMayBeDrawnByTheSeed) {
  const std::string text =
      "faults: [{at_s: [8, 12], until_s: [20, 21], blackout: changi}, {at_s: [8, 12], kill: jurong}]";
  load(text);
  std::set<double> begins, ends;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const FaultPlan plan = load_fault_plan(file_, fleet(), seed);
    const Fault &first = plan.faults[0], &second = plan.faults[1];
    EXPECT_TRUE(first.at_s >= 8.0 && first.at_s <= 12.0) << first.at_s;
    EXPECT_TRUE(*first.until_s >= 20.0 && *first.until_s <= 21.0) << *first.until_s;
    EXPECT_NE(first.at_s, second.at_s) << "each fault draws its own";
    EXPECT_EQ(load_fault_plan(file_, fleet(), seed).faults[0].at_s, first.at_s);
    begins.insert(first.at_s);
    ends.insert(*first.until_s);
  }
  EXPECT_GT(begins.size(), 40u);
  EXPECT_GT(ends.size(), 40u);
  refused("faults: [{at_s: [12, 8], blackout: changi}]", "at_s: must be a time, or [earliest, latest]");
  refused("faults: [{at_s: [8], blackout: changi}]", "faults[0].at_s");
  refused("faults: [{at_s: [8, x], blackout: changi}]", "faults[0].at_s[1]: must be a number");
  refused("faults: [{at_s: [8, 12], until_s: 12, blackout: changi}]", "must be later than at_s, 12");
  refused("faults: [{at_s: [8, 12], until_s: [11, 14], blackout: changi}]", "must be later than at_s, 12");
  refused("faults: [{at_s: 1, until_s: [2, 9], blackout: changi}, {at_s: [8, 12], blackout: changi}]", "contradicts");
}

TEST_F(FaultFile, WrongFaultsAreRefusedWithLineAndKey) {
  refused("faults: [{at_s: 1, blackout: changy}]",
          ":1: faults[0].blackout: there is no UAV 'changy'; did you mean 'changi'?");
  refused("faults:\n  - {at_s: 1, kill: router}", ":2: faults[0].kill: there is no program 'router'");
  refused("faults: [{at_s: 300, blackout: changi}]",
          "faults[0].at_s: is after the end: the mission of 'small' lasts 300 s");
  refused("faults: [{at_s: 1, until_s: 301, blackout: changi}]", "faults[0].until_s: is after the end");
  refused("faults: [{at_s: 5, until_s: 5, blackout: changi}]", "faults[0].until_s: must be later than at_s, 5");
  refused("faults: [{at_s: 1, link: {loss: 1.5}}]", "faults[0].link.loss: must be a number within [0, 1], not '1.5'");
  refused("faults: [{at_s: 1, link: {to: nobody}}]", "faults[0].link.to: there is no node 'nobody'");
  refused("faults: [{at_s: 1}]", "faults[0]: must have exactly one of link, partition");
  refused("faults: [{at_s: 1, blackout: jurong, kill: changi}]", "it has 2");
  refused("faults: [{at_s: 1, station_outage: false}]", "station_outage: must be true");
  refused("faults: [{at_s: 1, lidar_failure: changi}]", "'changi' has no LiDAR");
  refused("faults: [{at_s: 1, partition: [[jurong], [changi, jurong]]}]", "'jurong' is in two groups");
  refused("faults: [{at_s: 1, blackot: jurong}]", "unknown key 'faults[0].blackot'");
  refused("faults: [{blackout: jurong}]", "missing key 'faults[0].at_s'");
  refused("faults: [{at_s: 1, motor_failure: {uav: changi, rotor: 6}}]", "rotor");
  refused("faults: {at_s: 1", "");
}

TEST_F(FaultFile, FaultsThatCanNeverActAreRefused) {
  refused("faults:\n  - {at_s: 10.01, until_s: 10.04, blackout: changi}",
          ":2: faults[0]: no exchange begins between 10.01 s and 10.04 s");
  refused("faults: [{at_s: 10.01, until_s: 10.04, blackout: changi}]", "the next one at 10.05 s");
  refused("faults: [{at_s: 10.01, for_s: 0.02, blackout: changi}]", "no exchange begins");
  refused("faults: [{when: held > 1, at_s: 10.01, until_s: 10.04, blackout: changi}]", "no exchange begins");
  for (const char* at : {"at_s: 0", "at_s: 10", "when: held > 1"}) {
    refused("faults:\n  - {" + std::string(at) + ", for_s: 1e-9, blackout: changi}",
            ":2: faults[0].for_s: must be at least 0.0025 s, one tick of simulated time");
    EXPECT_NO_THROW(load("faults: [{" + std::string(at) + ", for_s: 0.0025, blackout: changi}]"));
  }
  refused("faults: [{at_s: 0, for_s: [1e-9, 1], blackout: changi}]", "faults[0].for_s: must be at least 0.0025 s");
  refused("faults:\n  - {at_s: 0, until_s: 1e-9, blackout: changi}",
          ":2: faults[0].until_s: must be at least 0.0025 s, one tick of simulated time, later than at_s, 0");
  refused("faults: [{at_s: 1e-9, until_s: 2e-9, blackout: changi}]", "faults[0].until_s: must be at least 0.0025 s");
  EXPECT_NO_THROW(load("faults: [{at_s: 10, until_s: 10.01, blackout: changi}]"));
  EXPECT_NO_THROW(load("faults: [{at_s: 10.04, until_s: 10.06, blackout: changi}]"));
  EXPECT_NO_THROW(load("faults: [{when: held > 1, for_s: 0.01, blackout: changi}]"))
      << "the fault begins with an exchange, so it acts";
  for (const char* nothing : {"{}", "{loss: 0}", "{from: jurong}", "{latency_s: 0, topics: [/plan]}",
                              "{reordering: {probability: 0, delay_s: 1}}"}) {
    refused(std::string("faults: [{at_s: 1, link: ") + nothing + "}]", "faults[0].link: changes nothing: give");
  }
  refused("faults: [{at_s: 1, link: {from: jurong, to: jurong, loss: 1}}]",
          "faults[0].link.to: no node sends to itself: name another node than 'jurong'");
  refused("faults: [{at_s: 1, link: {loss: 1, queue_bytes: 100}}]",
          "faults[0].link.queue_bytes: needs bandwidth_bit_s");
  EXPECT_NO_THROW(load("faults: [{at_s: 1, link: {bandwidth_bit_s: 1000, queue_bytes: 100}}]"));
  refused("faults: [{at_s: 1, partition: [[], [gcs]]}]", "faults[0].partition: must have no empty group");
  const std::string everybody = joined(fleet().uav_names());
  refused("faults: [{at_s: 1, partition: [[gcs, " + everybody + "]]}]", "faults[0].partition: changes nothing");
  EXPECT_NO_THROW(load("faults: [{at_s: 1, partition: [[" + everybody + "]]}]")) << "this partition cuts gcs off";
  refused("faults: [{at_s: 1, link: {from: [changi, changi], loss: 1}}]", "link.from: 'changi' is named twice");
}

TEST_F(FaultFile, TimesInAFileByHandMayExceedTheMissionTime) {
  const double end_s = 300.0 + fleet().takeoff_timeout_s;
  const std::string late = "faults: [{at_s: 300.05, until_s: 310, blackout: changi}]";
  EXPECT_EQ(load("by_hand: true\n" + late).faults[0].begin(), ticks(300.05));
  refused("by_hand: false\n" + late, "is after the end");
  refused("by_hand: true\nfaults: [{at_s: " + std::to_string(end_s) + ", blackout: changi}]", "is after the end");
  EXPECT_TRUE(load("by_hand: true\nfaults: []").empty());
}

TEST_F(FaultFile, ADurationMayReplaceTheEnd) {
  const std::string text = "faults: [{at_s: [8, 12], for_s: [2, 3], blackout: changi}]";
  load(text);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Fault fault = load_fault_plan(file_, fleet(), seed).faults[0];
    const double length_s = *fault.until_s - fault.at_s;
    EXPECT_TRUE(length_s >= 2.0 - 1e-9 && length_s <= 3.0 + 1e-9) << length_s;
  }
  refused("faults: [{at_s: 8, for_s: 2, until_s: 9, blackout: changi}]", "for_s: cannot stand beside until_s");
  refused("faults: [{at_s: 299, for_s: 2, blackout: changi}]", "is after the end");
  refused("faults: [{at_s: 8, for_s: 2, blackout: changi}, {at_s: 9, blackout: changi}]", "contradicts");
}

TEST_F(FaultFile, AWaitingFaultActsFromTheTimeAtWhichItIsSetOff) {
  const FaultPlan plan = load(
      "faults: [{when: held(changi) >= 3, for_s: 2, blackout: changi}, {when: time > 1 s, at_s: 5, until_s: 9, "
      "blackout: jurong}]");
  for (const Tick begin : {ticks(1.0), ticks(7.05)}) {
    Fault fault = plan.faults[0];
    EXPECT_FALSE(fault.active(begin));
    EXPECT_TRUE(fault.may_begin(begin));
    fault.set_off(begin);
    EXPECT_FALSE(fault.active(begin - 1));
    EXPECT_TRUE(fault.active(begin));
    EXPECT_TRUE(fault.active(begin + ticks(2.0) - 1));
    EXPECT_FALSE(fault.active(begin + ticks(2.0)));
    EXPECT_FALSE(fault.may_begin(begin)) << "a fault begins only once";
  }
  Fault bounded = plan.faults[1];
  EXPECT_FALSE(bounded.may_begin(ticks(5.0) - 1));
  EXPECT_TRUE(bounded.may_begin(ticks(5.0)));
  EXPECT_FALSE(bounded.may_begin(ticks(9.0)));
}

TEST_F(FaultFile, WrongConditionsAreRefusedWithTheirColumn) {
  refused("faults:\n  - {when: hold(changi) >= 3, blackout: changi}",
          ":2:12: faults[0].when: there is no signal 'hold'; did you mean 'held'?");
  refused("faults:\n  - when: z(changi) >\n      3 s\n    blackout: changi", ":3:7: faults[0].when: units do not fit");
  refused("faults: [{when: score > 3, blackout: changi}]",
          ":1:17: faults[0].when: 'score' is known only after the run");
  refused("faults: [{when: gain(held) > 3, blackout: changi}]", "'gain' looks back");
  refused("faults: [{when: held > 1, blackout: changi}, {at_s: 200, blackout: changi}]", "contradicts");
  EXPECT_NO_THROW(load("faults: [{when: held > 1, until_s: 200, blackout: changi}, {at_s: 200, blackout: changi}]"));
}

TEST_F(FaultFile, WrongTopicsAreRefused) {
  refused("faults: [{at_s: 1, link: {loss: 1, topics: plan}}]", "'plan' is not a topic; write it like '/plan'");
  refused("faults: [{at_s: 1, link: {loss: 1, topics: []}}]", "must name at least one topic");
  refused("faults: [{at_s: 1, link: {range_m: 10, topics: [/plan]}}]", "cannot stand beside range_m");
  EXPECT_NO_THROW(load("faults: [{at_s: 1, link: {loss: 1, topics: [/plan, /captures]}}]"));
}

TEST_F(FaultFile, ContradictionsAreRefused) {
  const std::string kill = "{at_s: 10, until_s: 20, kill: changi}";
  refused("faults: [" + kill + ", {at_s: 15, pause: changi}]",
          "faults[1]: contradicts faults[0]: both affect the process of changi at the same time");
  refused("faults: [{at_s: 5, blackout: jurong}, {at_s: 100, until_s: 110, blackout: jurong}]", "the radio of jurong");
  EXPECT_NO_THROW(load("faults: [" + kill + ", {at_s: 20, until_s: 25, pause: changi}, {at_s: 12, kill: jurong}]"));
  EXPECT_NO_THROW(load("faults: [{at_s: 1, link: {loss: 0.1}}, {at_s: 1, link: {loss: 0.2}}]"));
}

TEST_F(FaultFile, AnyNameIsReadAsItIsWritten) {
  Scenario scenario = fleet();
  for (const char* name : {"null", "true", "12", "a-b_c"}) {
    scenario.fleet[1].name = name;
    std::ofstream(file_) << by_hand_text("any name", {fault_line({1.0, std::nullopt, Blackout{name}})});
    EXPECT_EQ(std::get<Blackout>(load_fault_plan(file_, scenario).faults.at(0).action).uav, name);
  }
}

TEST_F(FaultFile, CutLinksFollowThePlan) {
  const FaultPlan plan = load("faults: [{at_s: 10, until_s: 20, blackout: jurong}, {at_s: 15, station_outage: true}]");
  EXPECT_EQ(cut_links(plan, fleet(), ticks(5.0)), std::nullopt);
  const LinkMatrix<std::uint8_t> jurong(3, {0, 1, 0, 1, 0, 1, 0, 1, 0});  // gcs, jurong, changi
  EXPECT_EQ(cut_links(plan, fleet(), ticks(10.0)), jurong);
  const LinkMatrix<std::uint8_t> both(3, {0, 1, 1, 1, 0, 1, 1, 1, 0});
  EXPECT_EQ(cut_links(plan, fleet(), ticks(15.0)), both);
  const LinkMatrix<std::uint8_t> station(3, {0, 1, 1, 1, 0, 0, 1, 0, 0});
  EXPECT_EQ(cut_links(plan, fleet(), ticks(20.0)), station);
}

TEST_F(FaultFile, ManyFaultsOfOneProgramAreComparedWithTheirNeighboursOnly) {
  std::string text = "faults:\n";
  for (int i = 0; i < 5000; ++i) {
    const std::string at = std::to_string(i % 2 == 0 ? 1 + i * 0.05 : 298 - i * 0.05);  // from both ends
    text += "- {at_s: " + at + ", until_s: " + std::to_string(std::stod(at) + 0.0025) + ", kill: changi}\n";
  }
  EXPECT_EQ(load(text).faults.size(), 5000U);
  refused(text + "- {at_s: 100, until_s: 110, pause: changi}\n", "contradicts");
  refused(
      "faults:\n- {at_s: 10, kill: changi}\n- {at_s: 5, until_s: 10, kill: changi}\n- {at_s: 20, until_s: 21, kill: "
      "changi}\n",
      "faults[2]: contradicts faults[0]");
}

}  // namespace
}  // namespace skein
