// The signals of a hand-made run: each is compared with its definition.
#include "signals/run_signals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/radio/radio_routes.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"
#include "recording/mcap/writer.hpp"
#include "results/run_folder.hpp"
#include "signals/run_signals_fixture.hpp"

namespace skein::signals {
namespace {

TEST_F(RunSignalsTest, SignalsOfPositionsFollowTheTableOfPoses) {
  for (std::size_t tenth = 0; tenth <= 20; ++tenth) {
    const double t = 0.1 * static_cast<double>(tenth);
    run_.poses.push_back({t, "a", {3.0 * t, 0, 1}, {3, 0, 0}, true, 10.0 - t, 1.0 - 0.25 * t});
    run_.poses.push_back({t, "b", {0, 4.0, 1}, {0, 0, 0}, t < 1.0, 5.0});
  }
  const std::vector<double> x = number("x(a)"), separation = number("separation"), clearance = number("clearance");
  for (std::size_t k = 0; k < kExchanges; ++k) {
    const double t = 0.1 * static_cast<double>(k / 2);  // the time of the last row of the table
    EXPECT_NEAR(x[k], 3.0 * t, 1e-9) << k;
    EXPECT_NEAR(number("distance(a)")[k], 3.0 * t, 1e-9) << k;
    EXPECT_NEAR(number("charge(a)")[k], 1.0 - 0.25 * t, 1e-9) << k;
    EXPECT_EQ(number("charge(b)")[k], 1.0) << "b has no battery";
    if (t < 0.999) {
      EXPECT_NEAR(separation[k], std::hypot(3.0 * t, 4.0), 1e-9) << k;
    } else {
      EXPECT_EQ(separation[k], std::numeric_limits<double>::infinity()) << "one of the two UAVs is out";
    }
    EXPECT_NEAR(clearance[k], t < 0.999 ? 5.0 : 10.0 - t, 1e-9) << "the clearance of UAVs that are not out";
  }
  EXPECT_EQ(number("speed(a)")[20], 3.0);
  EXPECT_EQ(values("alive(b)"), [] {
    std::vector<double> alive(kExchanges, 1.0);
    std::fill(alive.begin() + 20, alive.end(), 0.0);
    return alive;
  }());
}

TEST_F(RunSignalsTest, TheUndisturbedDistanceIsKnownIfThatRunIsShorterOrLonger) {
  for (const double end_s : {1.0, 2.0, 3.0}) {
    results::RunRecord undisturbed = run_;
    for (std::size_t tenth = 0; 0.1 * static_cast<double>(tenth) < end_s + 0.05; ++tenth) {
      const double t = 0.1 * static_cast<double>(tenth);
      undisturbed.poses.push_back({t, "a", {0, 2.0 * t, 1}, {0, 2, 0}, true, 5.0});
    }
    const std::vector<double> flown = number("undisturbed_distance(a)", &undisturbed);
    for (std::size_t k = 0; k < kExchanges; ++k) {
      const double t = std::min(0.1 * static_cast<double>(k / 2), end_s);
      EXPECT_NEAR(flown[k], 2.0 * t, 1e-9) << k << " of " << end_s << " s";
    }
  }
  EXPECT_EQ(number("distance(a)"), steps({}));
  EXPECT_THROW(number("undisturbed_distance(a)"), InputError);
}

TEST_F(RunSignalsTest, MembersLinksAndFaultsFollowEventsAndResult) {
  run_.events = {{0, "joined", "a", ""},   {0, "link_up", "a", "gcs"}, {5, "link_down", "a", "gcs"},
                 {7, "link_up", "b", "a"}, {10, "left", "a", ""},      {20, "joined", "a", ""},
                 {30, "left", "a", ""},    {31, "joined", "a", ""}};
  EXPECT_EQ(values("member(a)"), steps({{0, 1}, {10, 0}, {20, 1}, {30, 0}, {31, 1}}));
  EXPECT_EQ(number("restarts(a)"), steps({{20, 1}, {31, 2}}));
  EXPECT_EQ(number("restarts"), number("restarts(a)"));
  EXPECT_EQ(number("leaves(a)"), steps({{10, 1}, {30, 2}}));
  EXPECT_EQ(number("leaves"), number("leaves(a)"));
  EXPECT_EQ(values("link(a, gcs)"), steps({{0, 1}, {5, 0}}));
  EXPECT_EQ(values("link(b, a)"), steps({{7, 1}}));
  EXPECT_EQ(values("link(a, b)"), steps({}));
  const auto healed = [&] { return FolderSignals(run_, scenario_).healed_s(); };
  EXPECT_EQ(healed(), 0.0);
  run_.result["faults"] = Json::array({{{"began_step", 4}, {"ended_step", 8}},
                                       {{"began_step", 6}, {"ended_step", 30}},
                                       {{"began_step", nullptr}, {"ended_step", nullptr}}});
  EXPECT_EQ(number("faults"), steps({{4, 1}, {6, 2}, {8, 1}, {30, 0}}));
  EXPECT_EQ(healed(), 1.5);
  run_.result["faults"].push_back({{"began_step", 9}, {"ended_step", nullptr}});
  EXPECT_EQ(healed(), std::nullopt);
}

TEST_F(RunSignalsTest, AProgramThatDiesForGoodDoesNotDelayTheHealing) {
  const auto healed = [&] { return FolderSignals(run_, scenario_).healed_s(); };
  const Json died{{"kind", "kill"}, {"target", "a"}, {"began_step", 12}, {"ended_step", nullptr}, {"until_s", nullptr}};
  run_.result["faults"] = Json::array({{{"kind", "link"}, {"began_step", 4}, {"ended_step", 8}}, died});
  EXPECT_NEAR(healed().value_or(-1.0), 0.6, 1e-9);
  run_.result["faults"].push_back({{"kind", "pause"}, {"began_step", 4}, {"ended_step", 20}});
  EXPECT_NEAR(healed().value_or(-1.0), 1.0, 1e-9) << "other faults end later";
  Json away = died;
  away["until_s"] = 5.0;
  run_.result["faults"].push_back(away);
  EXPECT_EQ(healed(), std::nullopt) << "a program that would have come back after the run's end";
  run_.result["faults"].back() = died;
  run_.result["faults"].back()["target"] = "station";
  EXPECT_EQ(healed(), std::nullopt) << "nobody delivers without a station";
  run_.result["faults"].back() = died;
  run_.result["faults"].back()["kind"] = "blackout";
  EXPECT_EQ(healed(), std::nullopt) << "other faults stay in force to the end";
}

TEST_F(RunSignalsTest, NumbersOfTheResultAreCalledByTheirKeys) {
  EXPECT_EQ(number("result(score)")[3], 7.5);
  EXPECT_EQ(number("result(radio.sent)")[40], 12.0);
  EXPECT_EQ(number("result(uavs.b.idle_s)")[0], 0.5);
  EXPECT_THROW(number("result(radio.snet)"), InputError);
  EXPECT_THROW(number("result(radio)"), InputError);
  EXPECT_EQ(number("result(uavs)")[9], 2.0) << "a list has a length";
}

TEST_F(RunSignalsTest, TimeWithoutWorkIsReadFromItsTable) {
  run_.work = {{1.0, "a", 7.0}, {1.0, "b", 3.0}, {2.0, "a", 8.0}, {2.0, "b", 0.0}, {3.0, "a", 9.0}};  // beyond the end
  EXPECT_EQ(number("without_work(a)"), steps({{20, 7}, {40, 8}}));
  EXPECT_EQ(number("without_work(b)"), steps({{20, 3}, {40, 0}}));
  run_.work.clear();
  EXPECT_EQ(number("without_work(b)"), steps({})) << "the table has no rows for b";
}

TEST_F(RunSignalsTest, CapturesAreCountedWhenTheyAreTakenDeliveredAndAcknowledged) {
  run_.events = {
      {2, "captured", "a", "0"}, {4, "captured", "a", "1"}, {6, "captured", "b", "0"}, {12, "released", "a", "0"}};
  run_.captures = {capture("a", 0, 0.09, 0.5, 1), capture("a", 0, 0.09, 0.5, 2),
                   capture("a", 1, 0.2, std::nullopt, 1, 0.8), capture("b", 0, 0.3, 0.6, 1, 0.3)};
  run_.scores = {{0.0, 0.0, 0.0}, {0.5, 1.0, 2.0}, {2.0, 1.5, 3.0}, {2.1, 9.0, 9.0}};  // the last is beyond the end
  EXPECT_EQ(number("captures"), steps({{2, 1}, {4, 2}, {6, 3}}));
  EXPECT_EQ(number("captures(b)"), steps({{6, 1}}));
  EXPECT_EQ(number("held(a)"), steps({{2, 1}, {4, 2}, {12, 1}}));
  EXPECT_EQ(number("delivered"), steps({{10, 1}, {12, 2}}));
  EXPECT_EQ(number("acknowledged"), steps({{12, 1}}));
  EXPECT_EQ(number("acknowledged_and_delivered"), steps({{12, 1}}));
  EXPECT_EQ(number("score"), steps({{10, 1}, {40, 1.5}}));
  EXPECT_EQ(number("points"), steps({{10, 2}, {40, 3}}));
  EXPECT_EQ(number("earned"), steps({{2, 1}, {4, 1.3}}));
  EXPECT_EQ(number("delivered_score"), steps({{10, 1}}));
  run_.captures[0].delivered_at_s = run_.captures[1].delivered_at_s = 0.65;
  EXPECT_EQ(number("acknowledged_and_delivered"), steps({})) << "the acknowledgement came before the delivery";
}

TEST_F(RunSignalsTest, LostAndLateMessagesAreCountedWhenTheyAreSent) {
  run_.messages = {{3, "a", std::nullopt}, {5, "b", 9}, {7, "a", 8}};
  EXPECT_EQ(number("lost"), steps({{3, 1}}));
  EXPECT_EQ(number("late"), steps({{5, 1}, {7, 2}}));
  EXPECT_EQ(number("late(a)"), steps({{7, 1}}));
  EXPECT_EQ(number("lost(b)"), steps({}));
}

TEST_F(RunSignalsTest, ADeliveryThatDoesNotFollowFromTheRecordIsADifference) {
  run_.events = {{0, "joined", "a", ""},     {0, "joined", "station", ""}, {0, "joined", "comm_router", ""},
                 {0, "link_up", "a", "gcs"}, {10, "captured", "a", "0"},   {20, "captured", "a", "1"}};
  run_.captures = {capture("a", 0, 0.5, 0.55), capture("a", 1, 1.0, 1.05, 1)};
  const FaultPlan plan;
  const auto differences = [&] {
    FolderSignals all(run_, scenario_, nullptr, &plan);
    const auto info = std::ranges::find(signal_table(), "custody_differences", &SignalInfo::name);
    return all.values({&*info, {}});
  };
  EXPECT_EQ(differences(), steps({}));
  run_.captures[1].delivered_at_s = 1.15;
  EXPECT_EQ(differences(), steps({{21, 1}, {23, 0}})) << "late";
  run_.captures[1].delivered_at_s = 1.0;
  EXPECT_EQ(differences(), steps({{20, 1}, {21, 0}})) << "early";
  run_.captures.pop_back();
  EXPECT_EQ(differences(), steps({{21, 1}})) << "the station has no record of it";
  EXPECT_THROW(number("custody_differences"), InputError) << "the faults are not known";
}

TEST_F(RunSignalsTest, ACollisionAfterTheLastRowOfTheTableEndsAlive) {
  run_.poses = {{0.0, "a", {0, 0, 1}}, {1.9, "a", {1, 0, 1}}};
  run_.result["collisions"] = Json::array({{{"uav", "a"}, {"with", "ground"}, {"time_s", 1.96}}});
  EXPECT_EQ(values("alive(a)").at(39), 1.0);
  EXPECT_EQ(values("alive(a)").at(40), 0.0);
  EXPECT_EQ(values("alive(b)").at(40), 1.0);
}

// The test searches through all pairs of exchanges.
TEST_F(RunSignalsTest, APathIsALinkToTheStationAndThenOneBack) {
  std::mt19937_64 random(6);
  int with_path = 0, without = 0;
  for (int round = 0; round < 300; ++round) {
    run_.events.clear();
    std::map<std::string, std::vector<bool>> on;
    for (const auto& [name, event, subject, object] :
         {std::tuple("there", "link_up", "a", "gcs"), std::tuple("back", "link_up", "gcs", "a"),
          std::tuple("a", "joined", "a", ""), std::tuple("router", "joined", "comm_router", ""),
          std::tuple("station", "joined", "station", "")}) {
      const bool is_link = std::string(event) == "link_up";
      bool now = false;
      for (std::size_t k = 0; k < kExchanges; ++k) {
        const bool next = random() % 8 == 0 ? !now : now || (k == 0 && (!is_link || random() % 3 == 0));
        if (next != now) {
          run_.events.push_back({k, next ? event : is_link ? "link_down" : "left", subject, object});
        }
        now = next;
        on[name].push_back(now);
      }
    }
    std::ranges::stable_sort(run_.events, {}, &results::EventRow::step);
    const std::size_t taken = random() % 20, told = taken + random() % 20;
    run_.events.push_back({taken, "captured", "a", "0"});
    run_.events.push_back({told, "released", "a", "0"});
    bool expected = false;
    for (std::size_t s = taken; s < told; ++s) {
      for (std::size_t r = s + 1; r < told; ++r) {
        expected |= on["there"][s] && on["a"][s] && on["router"][s] && on["station"][s + 1] && on["back"][r] &&
                    on["station"][r] && on["router"][r] && on["a"][r + 1];
      }
    }
    EXPECT_EQ(number("acknowledged_with_path").back(), expected ? 1.0 : 0.0) << round;
    ++(expected ? with_path : without);
  }
  EXPECT_GT(with_path, 30);
  EXPECT_GT(without, 30);
}

TEST_F(RunSignalsTest, APathIsSoughtOnlyWithinTheRun) {
  run_.events = {{0, "joined", "a", ""},
                 {kExchanges, "captured", "a", "0"},
                 {10'000'000, "released", "a", "0"},
                 {5, "captured", "a", "1"},
                 {10'000'000, "released", "a", "1"}};
  EXPECT_EQ(number("acknowledged_with_path"), steps({}));
}

TEST_F(RunSignalsTest, TakenOverWorkIsThatWhichNoOtherUavWouldHaveDone) {
  results::RunRecord undisturbed = run_;
  undisturbed.result["score"] = 9.0;
  undisturbed.captures = {capture("a", 0, 0.1, {}, 0), capture("a", 1, 1.0, {}, 1), capture("a", 2, 1.1, {}, 2),
                          capture("a", 3, 1.2, {}, 3), capture("b", 0, 1.9, {}, 3)};
  run_.events = {{0, "joined", "a", ""}, {10, "left", "a", ""}};
  run_.captures = {capture("a", 0, 0.1, {}, 0), capture("b", 0, 0.2, {}, 1), capture("b", 1, 1.0, {}, 2),
                   capture("b", 2, 1.5, {}, 1), capture("b", 3, 1.6, {}, 0), capture("b", 4, 1.7, {}, 3)};
  EXPECT_EQ(number("work_at_failure(a)", &undisturbed), steps({{10, 2}})) << "points 1 and 2";
  EXPECT_EQ(number("taken_over(a)", &undisturbed), steps({{20, 1}, {30, 2}}));
  EXPECT_EQ(number("taken_over(b)", &undisturbed), steps({})) << "b has not failed";
  run_.events.pop_back();
  EXPECT_EQ(number("work_at_failure(a)", &undisturbed), steps({})) << "a has not failed";
  run_.result["faults"] = Json::array({{{"target", "b"}, {"began_step", 4}}, {{"target", "a"}, {"began_step", 21}}});
  EXPECT_EQ(number("work_at_failure(a)", &undisturbed), steps({{21, 1}})) << "point 2, from its fault on";
  EXPECT_EQ(number("taken_over(a)", &undisturbed), steps({}));
  EXPECT_EQ(number("undisturbed_score", &undisturbed)[0], 9.0);
  EXPECT_THROW(number("undisturbed_score"), InputError);
}

// ---- messages ---------------------------------------------------------------------------------------------------

struct Sent {
  std::string channel;
  std::uint32_t number = 0;
  std::uint64_t step = 0;
};
struct Arrives {
  std::string source, target, topic;
  std::uint64_t number = 0, step = 0;  ///< step: in which the router hands the message on
};

void write_recording(const std::filesystem::path& dir, const std::vector<Sent>& sent,
                     const std::vector<Arrives>& arrives,
                     const std::vector<std::pair<std::uint64_t, double>>& debug = {}) {
  mcap::Writer writer(dir / run_folder::kRecording);
  std::map<std::string, std::uint16_t> channels;
  const auto channel = [&](const std::string& topic) {
    if (!channels.contains(topic)) channels[topic] = writer.add_channel(topic, "", "");
    return channels[topic];
  };
  const auto time = [](std::uint64_t step) { return step * 50'000'000; };
  const std::vector<std::uint8_t> nothing(8);
  for (const Sent& one : sent) writer.write(channel(one.channel), time(one.step), nothing, one.number);
  for (const Arrives& one : arrives) {
    msg::Arrival arrival;
    arrival.source(one.source);
    arrival.target(one.target);
    arrival.topic(one.topic);
    arrival.number(one.number);
    msg::Arrivals arrivals;
    arrivals.step(one.step);
    arrivals.arrivals({arrival, arrival});  // several in one step, and texts of any length between them
    arrivals.arrivals().pop_back();
    writer.write(channel("/skein/arrivals"), time(one.step), encode(arrivals));
  }
  for (const auto& [step, value] : debug) {
    msg::Float64 message;
    message.data(value);
    writer.write(channel("/a/debug/left"), time(step), encode(message));
  }
}

TEST_F(RunSignalsTest, MessagesAreCountedByLinkAndTopic) {
  run_.events = {{0, "link_up", "a", "b"}, {4, "link_down", "a", "b"}, {0, "link_up", "a", "gcs"}};
  write_recording(run_.dir,
                  {{"/a/plan", 0, 2},
                   {"/a/plan", 1, 5},
                   {"/b/plan", 0, 6},
                   {"/a/captures/a", 0, 3},
                   {"/a/gimbal", 0, 1},
                   {"/a/plan", 0, 20}},  // sent after its restart
                  {{"a", "b", "/plan", 0, 2},
                   {"a", "gcs", "/plan", 0, 2},
                   {"a", "gcs", "/captures/a", 0, 8},
                   {"a", "gcs", "/plan", 0, 12},
                   {"a", "b", "/plan", 1, 5},
                   {"a", "gcs", "/plan", 0, 20}});
  EXPECT_EQ(number("sent(a, b)"), steps({{2, 1}, {5, 2}, {20, 3}}));
  EXPECT_EQ(number("sent(a, gcs)"), steps({{2, 1}, {3, 2}, {5, 3}, {20, 4}}));
  EXPECT_EQ(number("sent(all, gcs, /captures)"), steps({{3, 1}}));
  EXPECT_EQ(number("sent(all, all, /plan)"), steps({{2, 2}, {5, 4}, {6, 6}, {20, 8}}));
  EXPECT_EQ(number("arrived(a, gcs)"), steps({{3, 1}, {9, 2}, {13, 3}, {21, 4}}));
  EXPECT_EQ(number("arrived(a, gcs, /plan)"), steps({{3, 1}, {13, 2}, {21, 3}}));
  EXPECT_EQ(number("arrived_once(a, gcs, /plan)"), steps({{3, 1}, {21, 2}}))
      << "a message arrives a second time at 13, and one of the restarted sender at 21";
  EXPECT_EQ(number("arrived_over_open_link(a, b)"), steps({{3, 1}})) << "the second was sent while the link was down";
  EXPECT_EQ(number("in_flight(a, gcs)"), steps({{3, 1}, {4, 2}, {9, 1}, {13, 0}}));
}

TEST_F(RunSignalsTest, ADebugValueHoldsUntilTheNextOne) {
  write_recording(run_.dir, {}, {}, {{3, 2.5}, {10, -1.0}});
  EXPECT_EQ(number("debug(a, left)"), steps({{3, 2.5}, {10, -1.0}}));
  EXPECT_EQ(number("debug(b, left)"), steps({}));
}

TEST_F(RunSignalsTest, WithoutARecordingThereAreNoMessages) { EXPECT_THROW(number("sent"), InputError); }

TEST_F(RunSignalsTest, ARecordingThatIsCutOffIsRefused) {
  write_recording(run_.dir, {{"/a/plan", 0, 2}}, {});
  const auto file = run_.dir / run_folder::kRecording;
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THROW(number("sent"), InputError);
}

TEST_F(RunSignalsTest, EverySignalOfTheTableIsKnown) {
  write_recording(run_.dir, {}, {});
  const SignalNames names(scenario_);
  for (const SignalInfo& info : signal_table()) {
    std::vector<std::string> arguments;
    for (std::size_t i = 0; i < info.required; ++i) {
      switch (info.arguments[i]) {
        case SignalArgument::path:
          arguments.emplace_back("score");
          break;
        case SignalArgument::word:
          arguments.emplace_back("left");
          break;
        default:
          arguments.emplace_back(i == 0 ? "a" : "b");
      }
    }
    const FaultPlan plan;
    FolderSignals all(run_, scenario_, &run_, &plan);
    EXPECT_EQ(all.values({&info, arguments}).size(), kExchanges) << info.name;
  }
}

}  // namespace
}  // namespace skein::signals
