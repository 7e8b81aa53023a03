// The conversion of fault tests of earlier versions: which property replaces each key, and which text stays as it is.
// The properties must judge made-up runs as the keys did.
#include "cli/fault_tests/conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "cli/fault_tests/fault_test.hpp"
#include "core/text/text.hpp"
#include "host/testing/fake_programs.hpp"
#include "signals/judge.hpp"
#include "signals/run_signals.hpp"

namespace skein::cli {
namespace {

const std::string kFlown = "run: {scenario: ./small.yaml, duration_s: 60}\nfaults: [{at_s: 10, blackout: alpha}]\n";

std::string text_of(const std::string& old) { return converted(parse_config_document(old, "old.yaml")); }

class Converted : public testing::Test {
 protected:
  FaultTest load(const std::string& text) {
    write_text(programs_.dir() / "mine.yaml", text);
    return load_fault_test(programs_.dir() / "mine.yaml");
  }

  FakePrograms programs_;
};

struct OldKey {
  const char *expect, *properties;
};

TEST_F(Converted, EachKeyBecomesItsProperty) {
  const std::vector<OldKey> table = {
      {"collisions: {at_most: 2}", "  no_collision: off\n  collisions: always result(collisions) <= 2\n"},
      {"collisions: {at_least: 0}", "  no_collision: off\n"},
      {"score: {at_least: 3.5}", "  score: always result(score) >= 3.5\n"},
      {"score_earned: 8", "  score_earned: always result(score_earned) == 8\n"},
      {"points_detected: {at_least: 1, at_most: 9}",
       "  points_detected: always result(points_detected) >= 1 and result(points_detected) <= 9\n"},
      {"scans: {at_most: 900}", "  scans: always result(timing.scans) <= 900\n"},
      {"score_vs_fault_free: {at_least: 0.95}", "  score_share: {share: 95 %}\n"},
      {"score_vs_fault_free: {at_least: 0.8}", "  score_share: ready\n"},
      {"score_vs_fault_free: {at_least: 0.7, at_most: 0.99}",
       "  score_vs_fault_free: finally score >= 0.7 * undisturbed_score and score <= 0.99 * undisturbed_score\n"},
      {"earned_vs_fault_free: {at_least: 0.9}", "  earned_vs_fault_free: finally earned >= 0.9 * undisturbed_earned\n"},
      {"score_vs_earned: {at_least: 0.99}", "  delivered_share: ready\n"},
      {"uavs: {alpha: {captures: 0, idle_s: {at_most: 20}, max_speed_mps: {at_most: 8}}}",
       "  alpha_totals: always result(uavs.alpha.captures) == 0 and result(uavs.alpha.idle_s) <= 20 s and "
       "result(uavs.alpha.max_speed_mps) <= 8 m/s\n"},
      {"during: [{captures: {at_least: 3}, delivered: 0}]",
       "  fleet: finally gain(captures) >= 3 and gain(delivered) == 0\n"},
      {"during: [{after_s: 40.1, until_s: 56, uavs: {alpha: {delivered: 0, late: {at_most: 2}}}}]",
       "  alpha_from_40_1_to_56_s: always gain(delivered(alpha)) == 0 and gain(late(alpha)) <= 2 from 40.05 s to 56 "
       "s\n"},
      {"during: [{after_s: 20, distance_m: {at_least: 9}, acknowledged: 0, score: {at_most: 2}}]",
       "  fleet_from_20_s: finally gain(acknowledged) == 0 and gain(score) <= 2 after 19.95 s\n"
       "  fleet_way_from_20_s: finally gain(distance) >= 9 m after 20 s\n"},
      {"during: [{until_s: 60, lost: {at_least: 1}}, {lost: {at_least: 2}}]",
       "  fleet: finally gain(lost) >= 1\n  fleet_2: finally gain(lost) >= 2\n"},
      {"left: [alpha, station]",
       "  left: finally leaves(alpha) >= 1 and leaves(station) >= 1 and leaves == leaves(alpha) + leaves(station)\n"},
      {"rejoined: []", "  rejoined: always restarts == 0\n"},
      {"taken_over: {uav: alpha, within_s: 20, points: 5}",
       "  alpha_taken_over: whenever rises(work_at_failure(alpha)), eventually taken_over(alpha) >= 5 within 20 s\n"},
      {"custody: exact", "  custody_exact: ready\n"},
      {"custody: none", "  custody_kept: off\n  score_adds_up: off\n"},
  };
  std::set<std::string> seen;
  for (const auto& [expect, properties] : table) {
    const std::string text = text_of(kFlown + "expect: {" + expect + "}\n");
    EXPECT_EQ(text, kFlown + "properties:\n" + properties) << expect;
    EXPECT_NO_THROW(load(text)) << text;
    seen.insert(std::string(expect).substr(0, std::string(expect).find(':')));
  }
  EXPECT_EQ(seen, (std::set<std::string>{old_expectations().begin(), old_expectations().end()}));
}

TEST_F(Converted, AnExpectationThatHoldsByDefaultOrIsStatedElsewhereIsDropped) {
  EXPECT_EQ(text_of(kFlown + "expect: {collisions: 0, custody: kept}\n"), kFlown);
  EXPECT_EQ(text_of("faults: []\nexpect: {collisions: 0}\n"), "faults: []\nexpect: {}\n")
      << "the file remains a fault test";
  const std::string stated = "properties:\n  score_share: {share: 90 %}\n  custody_exact: ready\n";
  EXPECT_EQ(text_of(kFlown +
                    "expect: {score_vs_fault_free: {at_least: 0.9},\n"
                    "  custody: exact}\n" +
                    stated),
            kFlown + stated);
  EXPECT_EQ(text_of(kFlown + "expect: {score_vs_fault_free: {at_least: 0.95}}\n" + stated),
            kFlown + stated + "  score_vs_fault_free: finally score >= 0.95 * undisturbed_score\n");
  const std::string capsule = "properties: {separation: ready}\ncapsule: {property: separation, skein: '1'}\n";
  EXPECT_EQ(text_of(kFlown + "expect: {custody: none, collisions: {at_least: 0}}\n" + capsule), kFlown + capsule);
}

TEST_F(Converted, TheTextOutsideExpectStaysAsItIs) {
  const std::string text = text_of("# a test\n" + kFlown +
                                   "expect:   # two things\n  score: {at_least: 3}  # '#1'\n\n  radio: {sent: 3}\n"
                                   "# behind\nproperties:   \n    low: always z(alpha) < 60 m # low\n\n# end");
  EXPECT_EQ(text, "# a test\n" + kFlown +
                      "# two things\n# '#1'\nexpect: {radio: {sent: 3}}\n# behind\nproperties:   \n" +
                      "    low: always z(alpha) < 60 m # low\n    score: always result(score) >= 3\n\n# end\n");
  EXPECT_NO_THROW(load(text));
  const std::string flow = text_of(kFlown +
                                   "properties: {a: 'always z(alpha) < 60 m', # }\n  separation: {least: 1 m}}\n"
                                   "expect: {score: 3}");
  EXPECT_EQ(flow, kFlown + "properties: {a: 'always z(alpha) < 60 m', # }\n  separation: {least: 1 m}, " +
                      "score: 'always result(score) == 3'}\n");
  EXPECT_NO_THROW(load(flow));
  for (const std::string& same : {kFlown, kFlown + "expect: {status: completed}", std::string("faults: []")}) {
    EXPECT_EQ(text_of(same), same);
  }
}

TEST_F(Converted, AFileThatCannotBeConvertedIsRefusedWithItsLine) {
  const auto refused = [](const std::string& text, const std::string& words) {
    try {
      text_of(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  for (const char* other : {"name: towers\nfleet: []\n", "properties: {separation: ready}\n", "expect: {score: 3}\n",
                            "- faults\n", "faults\n"}) {
    refused(other, "old.yaml:1: faults: is missing, so this is not a fault test");
  }
  refused(kFlown + "expect: {during: 3}", "old.yaml:3: expect.during: must be a list");
  refused("{faults: [], expect: {score: 3}}", "old.yaml:1: expect: cannot be converted: let `expect:` begin a line");
  refused(kFlown + "properties: ./mine.yaml\nexpect: {score: 3}",
          "old.yaml:3: properties: names a file, to which convert adds nothing");
}

// ---- the same judgement -------------------------------------------------------------------------------------------

/// A run of 60.3 s of alpha and beta, with drawn events and drawn old keys.
struct Drawn {
  explicit Drawn(std::uint64_t seed) : random(seed) {
    run.result = {{"sim_time_s", 60.3}, {"score", 0.0}};
    for (const char* name : {"alpha", "beta"}) {
      double x_m = 0.0;
      for (std::uint64_t k = 0; k <= 1206; k += 2) {
        const double step_m = static_cast<double>(below(2));
        x_m += step_m;
        run.poses.push_back({0.05 * static_cast<double>(k), name, {x_m, 0.0, 1.0}});
        if (k > 0) events.push_back({"distance_m", name, k, step_m});
      }
    }
    for (std::uint64_t k = 1; k < 1190; k += 1 + below(40)) add_capture(k, below(2) > 0 ? "alpha" : "beta");
  }

  std::uint64_t below(std::uint64_t n) { return random() % n; }

  /// Adds a capture that may be delivered and acknowledged, and a message with captures that is lost or late.
  void add_capture(std::uint64_t k, const std::string& uav) {
    const std::uint64_t number = run.captures.size();
    const bool is_delivered = below(2) > 0, is_acknowledged = below(2) > 0, is_lost = below(2) > 0;
    const auto time_s = [](std::uint64_t step) { return 0.05 * static_cast<double>(step); };
    run.captures.push_back(
        {uav, number, time_s(k), number, 0.5, is_delivered ? std::optional(time_s(k + 5)) : std::nullopt, ""});
    run.events.push_back({k, run_tables::kCaptured, uav, std::to_string(number)});
    if (is_acknowledged) run.events.push_back({k + 7, run_tables::kReleased, uav, std::to_string(number)});
    run.messages.push_back({k, uav, is_lost ? std::nullopt : std::optional(k + 3)});
    events.push_back({"captures", uav, k, 1.0});
    events.push_back({is_lost ? "lost" : "late", uav, k, 1.0});
    if (is_delivered) events.push_back({"delivered", uav, k + 5, 1.0});
    if (is_acknowledged) events.push_back({"acknowledged", uav, k + 7, 1.0});
  }

  /// Adds a window with limits near the values in it. Updates `holds` with the verdict of an earlier version.
  std::string window() {
    const std::uint64_t from = 2 * below(500), to = from + 2 + 2 * below(100);
    const bool has_end = below(3) > 0, is_alpha = below(2) > 0;
    std::string limits;
    for (const char* kind : {"captures", "delivered", "acknowledged", "lost", "late", "distance_m"}) {
      if (below(3) > 0) continue;
      double seen = 0.0;
      for (const Event& event : events) {
        // The vehicle flew the distance to its first position in the window before the window.
        const bool is_in = event.step >= from + (kind == std::string("distance_m")) && (!has_end || event.step <= to);
        if (event.kind == kind && is_in && (!is_alpha || event.uav == "alpha")) seen += event.amount;
      }
      const double least = std::max(0.0, seen + static_cast<double>(below(3)) - 1.0);
      const double most = least + static_cast<double>(below(2));
      const bool has_least = below(3) > 0, has_most = !has_least || below(2) > 0;
      holds = holds && (!has_least || seen >= least) && (!has_most || seen <= most);
      limits += ", " + std::string(kind) + ": {" + (has_least ? "at_least: " + number_text(least) : "") +
                (has_least && has_most ? ", " : "") + (has_most ? "at_most: " + number_text(most) : "") + "}";
    }
    if (is_alpha && !limits.empty()) limits = ", uavs: {alpha: {" + limits.substr(2) + "}}";
    return "{after_s: " + number_text(0.05 * static_cast<double>(from)) +
           (has_end ? ", until_s: " + number_text(0.05 * static_cast<double>(to)) : "") + limits + "}";
  }

  struct Event {
    std::string kind, uav;
    std::uint64_t step = 0;
    double amount = 0.0;
  };
  std::mt19937_64 random;
  results::RunRecord run;
  std::vector<Event> events;
  bool holds = true;
};

TEST_F(Converted, PropertiesJudgeADrawnRunAsTheOldKeysDid) {
  int held = 0, failed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Drawn drawn(seed);
    const std::string expect = "expect: {custody: none, during: [" + drawn.window() + ", " + drawn.window() + "]}\n";
    const FaultTest test = load(text_of(kFlown + expect));
    signals::FolderSignals signals(drawn.run, test.plan.scenario, nullptr, &test.plan.faults);
    const auto findings = signals::judge_properties(test.property_set, signals);
    const bool holds = std::ranges::none_of(findings, [](const signals::PropertyFinding& finding) {
      return finding.verdict.outcome == properties::Verdict::Outcome::fails;
    });
    EXPECT_EQ(holds, drawn.holds) << seed << ": " << expect << test.document.text;
    ++(holds ? held : failed);
  }
  EXPECT_GT(held, 10);
  EXPECT_GT(failed, 10);
}

}  // namespace
}  // namespace skein::cli
