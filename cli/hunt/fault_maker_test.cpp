// Random schedules of faults: Skein accepts each as a fault file, reads it back unchanged, and all faults end in time.
#include "cli/hunt/fault_maker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "cli/hunt/trial.hpp"
#include "core/faults/fault_check.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

constexpr std::uint64_t kSchedules = 400;

/// How long a fault is in force. If it waits for a condition, the time counts from when the condition holds.
double length_s(const Fault& fault) { return fault.waits ? fault.for_s.value() : fault.until_s.value() - fault.at_s; }

/// The longest time that a fault may last. No planner can save a vehicle that lacks thrust, or flies by a wrong
/// position, for longer.
double longest_s(const Fault& fault) {
  const std::string kind = fault_kind(fault);
  if (kind == "motor_failure") return 2.0;
  return kind.starts_with("odometry_") ? 12.0 : 40.0;
}

class FaultMakers : public testing::Test {
 protected:
  FaultMakers() {
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    LoadOptions load;
    load.duration_s = 120.0;
    load.conditions = "breezy";  // all kinds of faults are possible
    towers_ = load_scenario("towers", load);
    space_.heal_by_s = 77.0;
    space_.ground_program = true;
  }

  /// Calls `look` with random schedules and with variations of them, as a search makes them.
  void each(const auto& look) const {
    const FaultMaker maker(towers_, space_);
    std::vector<Fault> former;
    for (std::uint64_t i = 0; i < kSchedules; ++i) {
      RandomStream draw(7, "test", i);
      std::vector<Fault> faults = i % 2 == 0 ? maker.schedule(draw) : maker.varied(former, former, draw);
      look(faults);
      former = std::move(faults);
    }
  }

  FaultPlan read_back(const std::vector<Fault>& faults) const {
    const std::filesystem::path file = scratch_.path() / "faults.yaml";
    write_text(file, Trial{{}, faults}.text());
    return load_fault_plan(file, towers_);
  }

  Scenario towers_;
  FaultSpace space_;
  const ScratchDir scratch_;
};

TEST_F(FaultMakers, DrawnFaultsMakeAFaultFileThatReadsBackTheSame) {
  each([&](const std::vector<Fault>& faults) {
    ASSERT_FALSE(faults.empty());
    const FaultPlan plan = read_back(faults);
    ASSERT_EQ(plan.faults.size(), faults.size());
    for (std::size_t i = 0; i < faults.size(); ++i) {
      EXPECT_EQ(fault_line(plan.faults[i]), fault_line(faults[i]));
      EXPECT_EQ(plan.faults[i].begin(), faults[i].begin()) << fault_line(faults[i]);
      EXPECT_EQ(plan.faults[i].end(), faults[i].end()) << fault_line(faults[i]);
      EXPECT_EQ(plan.faults[i].for_s, faults[i].for_s) << fault_line(faults[i]);
    }
  });
}

TEST_F(FaultMakers, EachFaultLastsLongEnoughToActWhateverTheExchangePeriod) {
  for (const double period_s : {kTickS, 0.05, 0.75, 1.0}) {  // 1 s is the longest
    towers_.exchange_period_s = period_s;
    each([&](const std::vector<Fault>& faults) {
      for (const Fault& fault : faults) {
        EXPECT_TRUE(has_exchange(fault, towers_)) << fault_line(fault);
        if (fault.waits) {
          EXPECT_GE(fault.for_s.value(), period_s - 1e-9) << fault_line(fault);
        }
      }
    });
  }
}

TEST_F(FaultMakers, AllFaultsEndInTimeExceptPermanentKills) {
  const std::vector<std::string> uavs = towers_.uav_names();
  int deaths = 0, kills = 0;
  each([&](const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) {
      const auto* kill = std::get_if<Kill>(&fault.action);
      kills += kill != nullptr ? 1 : 0;
      EXPECT_LT(fault.at_s, space_.heal_by_s) << fault_line(fault);
      if (!fault.until_s) {
        ASSERT_NE(kill, nullptr) << fault_line(fault);
        EXPECT_NE(std::ranges::find(uavs, kill->member), uavs.end()) << fault_line(fault);
        ++deaths;
        continue;
      }
      EXPECT_LE(*fault.until_s, space_.heal_by_s + 1e-9) << fault_line(fault);
      // No fault is shorter than a tenth of a second, whether it is drawn or varied.
      EXPECT_GE(*fault.until_s - fault.at_s, 0.1 - 1e-9) << fault_line(fault);
      EXPECT_GE(fault.for_s.value_or(0.1), 0.1 - 1e-9) << fault_line(fault);
    }
  });
  EXPECT_GT(deaths, 0);
  EXPECT_LT(3 * deaths, kills);
}

/// A permanent kill has no end. Each variation of it ends in time, or is again a permanent kill.
TEST_F(FaultMakers, VariationsOfAPermanentKillEndInTime) {
  const FaultMaker maker(towers_, space_);
  const std::vector<Fault> death = {{.at_s = 20.0, .until_s = std::nullopt, .action = Kill{towers_.uav_names()[0]}}};
  int others = 0;
  for (std::uint64_t i = 0; i < kSchedules; ++i) {
    RandomStream draw(8, "test", i);
    for (const Fault& fault : maker.varied(death, {}, draw)) {
      if (!fault.until_s) continue;
      ++others;
      EXPECT_GE(*fault.until_s - fault.at_s, 0.1 - 1e-9) << fault_line(fault);
      EXPECT_LE(*fault.until_s, space_.heal_by_s + 1e-9) << fault_line(fault);
    }
  }
  EXPECT_GT(others, 50);
}

TEST_F(FaultMakers, NoFaultLastsLongerThanItsKindMay) {
  std::map<std::string, double> longest_shares;  // longest duration of each kind, as a share of its limit
  each([&](const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) {
      if (!fault.until_s) continue;
      EXPECT_LE(length_s(fault), longest_s(fault) + 1e-9) << fault_line(fault);
      double& most = longest_shares[fault_kind(fault)];
      most = std::max(most, length_s(fault) / longest_s(fault));
    }
  });
  for (const std::string& kind : fault_kinds())
    EXPECT_GT(longest_shares[kind], 0.5) << kind << " never lasts longer than 0.5 s";
}

/// From a fault of any length, a search can reach shorter and longer ones, up to the limits.
TEST_F(FaultMakers, AVariationMayLastShorterOrLonger) {
  const FaultMaker maker(towers_, space_);
  const std::string uav = towers_.uav_names()[0];
  const std::vector<FaultAction> actions = {Pause{uav}, MotorFailure{uav, 1, 0.8}, OdometryFreeze{uav}};
  // No random fault begins at this time, so a fault that does is a variation of this one, with another length.
  constexpr double kBegin_s = 0.5;
  for (const FaultAction& action : actions) {
    for (const bool waits : {false, true}) {
      for (const double before_s : {0.1, 0.5, 2.0, 12.0, 40.0}) {
        Fault fault{.at_s = kBegin_s, .until_s = kBegin_s + before_s, .action = action, .waits = waits};
        if (before_s > longest_s(fault)) continue;
        if (waits) {
          fault.when = FaultCondition{"captures >= 1"};
          fault.for_s = before_s;
        }
        double least_s = before_s, most_s = before_s;
        for (std::uint64_t i = 0; i < kSchedules; ++i) {
          RandomStream draw(9, "test", i);
          const Fault varied = maker.varied({fault}, {}, draw).at(0);
          if (varied.at_s != kBegin_s) continue;
          least_s = std::min(least_s, length_s(varied));
          most_s = std::max(most_s, length_s(varied));
        }
        const std::string what = fault_line(fault) + ", " + std::to_string(before_s) + " s";
        EXPECT_GE(least_s, 0.1 - 1e-9) << what;
        EXPECT_LE(most_s, longest_s(fault) + 1e-9) << what;
        EXPECT_TRUE(before_s <= 0.1 || least_s < before_s - 0.05) << what << ": never shorter";
        EXPECT_TRUE(before_s >= longest_s(fault) || most_s > before_s + 0.05) << what << ": never longer";
      }
    }
  }
}

TEST_F(FaultMakers, EveryKindIsDrawnUnlessTheUserChoosesKinds) {
  std::set<std::string> seen;
  each([&](const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) seen.insert(fault_kind(fault));
  });
  EXPECT_EQ(seen, std::set<std::string>(fault_kinds().begin(), fault_kinds().end()));
  seen.clear();
  space_.kinds = {"kill", "link"};
  each([&](const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) seen.insert(fault_kind(fault));
  });
  EXPECT_EQ(seen, std::set<std::string>({"kill", "link"}));
}

/// Each case must be a fault file that its run accepts, also if it varies a case of a run under other conditions.
TEST_F(FaultMakers, OnlyFaultsThatArePossibleUnderTheConditionsAreDrawn) {
  LoadOptions load;
  load.duration_s = 120.0;
  std::vector<Fault> former;
  std::map<std::string, std::set<std::string>> kinds;
  const std::vector<std::string> all = {"none", "breezy", "none,wind=harsh", "none,odometry=breezy+camera=harsh",
                                        "none,battery=harsh"};
  const FaultMaker maker(towers_, space_);
  for (std::uint64_t i = 0; i < kSchedules; ++i) {
    RandomStream draw(11, "weather", i);
    const std::string& conditions = all[i % all.size()];
    const FaultMaker here = maker.under(conditions);
    const std::vector<Fault> faults = i % 2 == 0 ? here.schedule(draw) : here.varied(former, former, draw);
    ASSERT_FALSE(faults.empty());
    load.conditions = conditions;
    towers_ = load_scenario("towers", load);
    EXPECT_NO_THROW(read_back(faults)) << conditions;
    for (const Fault& fault : faults) kinds[conditions].insert(fault_kind(fault));
    former = faults;
  }
  for (const char* kind : {"gust", "fix_loss", "battery_loss", "conditions"}) {
    EXPECT_TRUE(kinds["breezy"].contains(kind)) << kind;
    EXPECT_FALSE(kinds["none"].contains(kind)) << kind;
  }
  EXPECT_TRUE(kinds["none,wind=harsh"].contains("gust"));
  EXPECT_FALSE(kinds["none,wind=harsh"].contains("battery_loss"));
}

TEST_F(FaultMakers, WhereNoKindIsPossibleNothingIsDrawn) {
  space_.kinds = {"battery_loss", "fix_loss"};
  const FaultMaker maker = FaultMaker(towers_, space_).under("none");
  RandomStream draw(12, "nothing", 0);
  EXPECT_TRUE(maker.schedule(draw).empty());
  const std::vector<Fault> loss = {{.at_s = 5.0, .until_s = 9.0, .action = FixLoss{towers_.uav_names()[0]}}};
  EXPECT_TRUE(maker.varied(loss, loss, draw).empty());
}

TEST_F(FaultMakers, TheNameOfALinkFaultIncludesItsEffects) {
  LinkEffect effect;
  effect.duplication = 0.5;
  const std::vector<std::string> words = words_of({1.0, 2.0, effect});
  EXPECT_EQ(words, std::vector<std::string>({"link", "duplication"}));
}

}  // namespace
}  // namespace skein::cli
