// The same command gives the same digest with any DDS vendors, any order of arrivals, and any load of the machine.
#include "fleet_fixture.hpp"

namespace skein::test {
namespace {

/// Long enough that all UAVs fly, photograph and deliver.
const Arguments kTowers = {"towers", "--planner", "patrol", "--duration", "75"};
const Arguments kOneProcess = {"--one-process"};

/// A process that keeps one core busy.
class BusyCore {
 public:
  explicit BusyCore(const std::filesystem::path& folder)
      : spinner_({"/bin/sh", "-c", "while :; do :; done"}, {}, folder / "spinner.out", folder / "spinner.err") {}

 private:
  ChildProcess spinner_;
};

class Determinism : public FleetTest {
 protected:
  /// Flies a run, which must be complete. @returns its digest.
  std::string digest(const std::string& name, const Arguments& arguments, const Environment& environment = {}) {
    SkeinRun& done = run(name, arguments, environment);
    const Json result = done.result();
    EXPECT_EQ(result["status"], "completed") << name;
    EXPECT_TRUE(result["deterministic"]) << name;
    EXPECT_EQ(done.digest().size(), 64u) << name;
    EXPECT_GT(result["radio"]["delivered"], 0) << name << ": a run without radio messages proves little";
    return done.digest();
  }

  int diff(const std::string& a, const std::string& b, std::string& text) {
    ChildProcess& process = skein({"diff", folder() / a, folder() / b});
    text = process.out() + process.err();
    return process.wait().code;
  }
};

TEST_F(Determinism, VendorsOrderOfArrivalAndLoadDoNotShowInTheDigest) {
  const std::string reference = digest("cyclonedds", kTowers);
  EXPECT_EQ(digest("fastdds", joined(kTowers, {"--dds", "fastdds"})), reference);
  EXPECT_EQ(digest("mixed", joined(kTowers, {"--dds", "mixed"})), reference);
  for (int chaos = 1; chaos <= (long_tests() ? 5 : 3); ++chaos) {
    const std::string number = std::to_string(chaos);
    EXPECT_EQ(digest("chaos" + number, joined(kTowers, {"--dds", chaos % 2 == 0 ? "mixed" : "cyclonedds"}),
                     {{"SKEIN_CHAOS", number}}),
              reference)
        << "SKEIN_CHAOS=" << number;
  }
  EXPECT_EQ(digest("one_process", joined(kTowers, kOneProcess)), reference);
  const BusyCore busy(folder());
  EXPECT_EQ(digest("busy", kTowers), reference);
  std::string text;
  EXPECT_EQ(diff("cyclonedds", "busy", text), 0);
  EXPECT_EQ(text, "the runs are the same\n");
}

/// Under conditions, too: wind, odometry errors, batteries, LiDAR errors, blur, path loss; with a restart.
TEST_F(Determinism, AFlightUnderConditionsIsTheSameOverAllVendorsAndInOneProcess) {
  const std::string faults = write("faults.yaml", "faults:\n  - {at_s: 25, until_s: 27, kill: jurong}\n");
  const Arguments harsh = {"towers", "--planner",    "patrol", "--duration", "40",  "--seed",
                           "1",      "--conditions", "harsh",  "--faults",   faults};
  const std::string reference = digest("harsh", harsh);
  EXPECT_EQ(digest("fastdds", joined(harsh, {"--dds", "fastdds"}), {{"SKEIN_CHAOS", "1"}}), reference);
  EXPECT_EQ(digest("one_process", joined(harsh, kOneProcess)), reference);
}

TEST_F(Determinism, EachSeedGivesAnotherRunThatCanBeRepeated) {
  const Arguments one = joined(kTowers, {"--seed", "1"}), two = joined(kTowers, {"--seed", "2"});
  const std::string digest_of_one = digest("seed1", joined(one, kOneProcess)),
                    digest_of_two = digest("seed2", joined(two, kOneProcess));
  EXPECT_NE(digest_of_one, digest_of_two);
  EXPECT_EQ(digest("again", joined(two, {"--dds", "mixed"})), digest_of_two);
  EXPECT_EQ(digest("again", joined(one, {"--force"})), digest_of_one)
      << "an earlier result in the folder influenced the run";
  std::string text;
  EXPECT_EQ(diff("seed1", "seed2", text), 1);
  EXPECT_NE(text.find("first difference at step 0 (0 s):\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  jurong position\n"), std::string::npos) << text;  // its start offset is random
}

TEST_F(Determinism, TwoFleetsAtOnceDoNotDisturbEachOther) {
  SkeinRun& one = start("one", kTowers);
  SkeinRun& two = start("two", joined(kTowers, {"--dds", "mixed"}));
  EXPECT_EQ(one.exit_code(), 0) << one.err();
  EXPECT_EQ(two.exit_code(), 0) << two.err();
  EXPECT_EQ(one.digest().size(), 64u);
  EXPECT_EQ(one.digest(), two.digest());
  EXPECT_TRUE(one.domains().second < two.domains().first || two.domains().second < one.domains().first)
      << one.domains().first << " and " << two.domains().first;
}

TEST_F(Determinism, OptionsThatChangeNothingDoNotChangeTheDigest) {
  const Arguments brief = {"towers", "--planner", "hover", "--duration", "5"};
  const auto quick = [&](const std::string& name, const Arguments& more) {
    return run(name, joined(joined(brief, more), kOneProcess)).digest();
  };
  const std::string reference = quick("default", {});
  EXPECT_EQ(quick("zero", {"--scene-seed", "0"}), reference);
  EXPECT_EQ(quick("longer", {"--stop-at", "1000"}), reference) << "an end that is never reached changed the digest";
  EXPECT_NE(quick("seeded", {"--seed", "7"}), reference);
}

TEST_F(Determinism, AnExportedSceneIsTheSameScene) {
  const std::string folder = this->folder() / "exported";
  ChildProcess& scene = skein({"scene", "spire", "--scene-seed", "2", "--out", folder});
  ASSERT_EQ(scene.wait().code, 0) << scene.err();
  const Arguments brief = {"--planner", "patrol", "--duration", "15"};
  const std::string loaded = run("loaded", joined(joined({folder + "/spire.yaml"}, brief), kOneProcess)).digest();
  EXPECT_EQ(loaded.size(), 64u);
  EXPECT_EQ(loaded, run("made", joined(joined({"spire", "--scene-seed", "2"}, brief), kOneProcess)).digest());
}

TEST_F(Determinism, AnOfficialSceneHasOneDigestOverDdsAndInOneProcess) {
  if (std::getenv("SKEIN_ASSETS") == nullptr) GTEST_SKIP() << "SKEIN_ASSETS is not set";
  const Arguments mbs = {"mbs", "--planner", "patrol", "--duration", "75"};
  EXPECT_EQ(digest("mixed", joined(mbs, {"--dds", "mixed"}), {{"SKEIN_CHAOS", "1"}}),
            digest("one_process", joined(mbs, kOneProcess)));
}

}  // namespace
}  // namespace skein::test
