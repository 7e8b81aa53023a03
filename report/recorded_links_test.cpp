#include "report/recorded_links.hpp"

#include <gtest/gtest.h>

#include "results/run_tables.hpp"

namespace skein::report {
namespace {

/// A run of two UAVs whose links are all up from 0 s on.
results::RunRecord two_uavs() {
  results::RunRecord run;
  run.uavs = {"a", "b"};
  const std::vector<std::string> nodes = {"gcs", "a", "b"};
  for (const std::string& from : nodes) {
    for (const std::string& to : nodes) {
      if (from != to) run.events.push_back({0, run_tables::kLinkUp, from, to});
    }
  }
  run.end_s = 60.0;
  return run;
}

/// Adds the events that all links from and to `node` close, or open if `up`.
void add_link_events(results::RunRecord& run, double time_s, const std::string& node, bool up = false) {
  for (const std::string other : {"gcs", "a", "b"}) {
    if (other == node) continue;
    for (const auto& [from, to] : {std::pair(node, other), std::pair(other, node)}) {
      run.events.push_back({0, up ? run_tables::kLinkUp : run_tables::kLinkDown, from, to, time_s});
    }
  }
}

/// The states of all links at this time: rows by sender and columns by receiver, both in the order gcs, a, b;
/// 0: blocked, 1: linked, 2: cut, 3: dead.
std::string digits(const results::RunRecord& run, double time_s) {
  std::string found;
  for (const auto& [from_s, links] : recorded_links(run)) {
    if (from_s > time_s) break;
    found = digits_of(links);
  }
  return found;
}

TEST(RecordedLinks, AreEmptyWithoutEventsAboutLinks) { EXPECT_TRUE(recorded_links({}).empty()); }

TEST(RecordedLinks, AreBlockedIfTheyCloseWithoutAFault) {
  results::RunRecord run = two_uavs();
  run.events.push_back({0, run_tables::kLinkDown, "a", "gcs", 5.0});
  EXPECT_EQ(digits(run, 4.0), "011101110");
  EXPECT_EQ(digits(run, 5.0), "011001110");
  EXPECT_FALSE(has_cuts(run));
}

TEST(RecordedLinks, LinksOfANodeInABlackoutAreCut) {
  results::RunRecord run = two_uavs();
  run.faults = {{"blackout", "b", 10.0, 20.0}};
  add_link_events(run, 10.0, "b");
  add_link_events(run, 25.0, "b", true);
  EXPECT_TRUE(has_cuts(run));
  EXPECT_EQ(digits(run, 9.9), "011101110");
  EXPECT_EQ(digits(run, 10.0), "012102220");
  EXPECT_EQ(digits(run, 20.0), "010100000") << "the fault is over, and the nodes have no line of sight";
  EXPECT_EQ(digits(run, 25.0), "011101110");
}

TEST(RecordedLinks, LinksBetweenTheGroupsOfAPartitionAreCut) {
  results::RunRecord run = two_uavs();
  run.faults = {{"partition", "gcs a | b", 10.0, 20.0}, {"kill", "a", 30.0, 40.0}};
  add_link_events(run, 10.0, "b");
  EXPECT_EQ(digits(run, 12.0), "012102220");
  run.faults[0].target = "a | b";
  run.events.push_back({0, run_tables::kLinkDown, "a", "gcs", 10.0});
  EXPECT_EQ(digits(run, 12.0), "012202220") << "a node that is in no group is in a group of its own";
  EXPECT_EQ(digits(run, 35.0), "010000000") << "a killed program cuts no link";
}

TEST(RecordedLinks, AFaultOrEventOfAnUnknownNodeChangesNoLink) {
  results::RunRecord run = two_uavs();
  add_link_events(run, 5.0, "gcs");
  run.faults = {{"blackout", "nobody", 10.0, 20.0}, {"partition", "a b gcs | nobody", 10.0, 20.0}};
  run.events.push_back({0, run_tables::kLinkUp, "nobody", "a", 11.0});
  EXPECT_EQ(digits(run, 6.0), "000001010");
  EXPECT_EQ(digits(run, 12.0), "000001010");
}

TEST(RecordedLinks, LinksOfTheStationAreCutDuringAStationOutage) {
  results::RunRecord run = two_uavs();
  run.faults = {{"station_outage", "gcs", 10.0, 20.0}};
  add_link_events(run, 10.0, "gcs");
  EXPECT_EQ(digits(run, 12.0), "022201210");
}

TEST(RecordedLinks, LinksOfAUavThatCollidedAreDead) {
  results::RunRecord run = two_uavs();
  run.collisions = {{10.0, "a", "structure", {}}};
  add_link_events(run, 10.05, "a");
  EXPECT_EQ(digits(run, 9.0), "011101110");
  EXPECT_EQ(digits(run, 12.0), "031303130");
}

}  // namespace
}  // namespace skein::report
