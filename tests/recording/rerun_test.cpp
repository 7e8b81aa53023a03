// skein rerun and skein fork: recorded runs are flown again, with random scenes, planners and faults.
#include <fstream>
#include <random>

#include "fleet_fixture.hpp"
#include "results/run_folder.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class Rerun : public FleetTest {
 protected:
  std::string drawn(const std::vector<std::string>& of) { return of[draw_() % of.size()]; }
  std::string number(unsigned below) { return std::to_string(draw_() % below); }

  /// Arguments of a run with a random scene, planner and seed.
  Arguments drawn_flight() {
    return {drawn({"towers", "hangar", "cranes", "spire", "sail"}),
            "--planner",
            drawn({"patrol", "kios", "xxh", "star", "flock"}),
            "--seed",
            std::to_string(1 + draw_() % 500),
            "--scene-seed",
            number(500),
            "--duration",
            "40"};
  }
  ChildProcess& again(const std::string& command, const SkeinRun& run, const std::string& out, Arguments more) {
    Arguments arguments = {command, run.dir(), "--out", folder() / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return skein(arguments);
  }
  Json result_in(const std::string& out) const {
    return Json::parse(text_of(folder() / out / run_folder::kResult), nullptr, false);
  }
  static std::vector<std::string> uavs_of(const SkeinRun& run) {
    std::vector<std::string> names;
    const Json result = run.result();
    for (const Json& uav : result["uavs"]) names.push_back(uav["name"]);
    EXPECT_GE(names.size(), 3U);
    return names;
  }
  static std::string joined(const Arguments& arguments) {
    std::string text;
    for (const std::string& argument : arguments) text += argument + " ";
    return text;
  }

  std::mt19937 draw_{static_cast<unsigned>(::getpid())};
};

TEST_F(Rerun, EachAgentRepeatsItsRecordedOutput) {
  for (int round = 0; round < 2; ++round) {
    Arguments flight = drawn_flight();
    if (round == 1) {
      flight.insert(flight.end(), {"--faults", write("faults.yaml",
                                                     "faults:\n  - {at_s: 8, until_s: 14, kill: changi}\n"
                                                     "  - {at_s: 0, link: {loss: 0.2}}\n"
                                                     "  - {at_s: 20, until_s: 24, kill: comm_router}\n")});
    }
    SCOPED_TRACE(joined(flight));
    flight.push_back(round == 0 ? "--dds=mixed" : "--one-process");
    SkeinRun& run = this->run("run" + std::to_string(round), flight);
    for (const std::string& uav : uavs_of(run)) {
      const std::string out = uav + std::to_string(round);
      ChildProcess& process = again("rerun", run, out, {"--uav", uav});
      EXPECT_EQ(process.wait().code, 0) << process.out() << process.err();
      EXPECT_NE(process.out().find(uav + ": the output is the recorded one"), std::string::npos) << process.out();
      EXPECT_EQ(result_in(out)["digest"], run.result()["digest"]) << uav;
    }
  }
}

TEST_F(Rerun, ARerunOverDdsHasTheSameDigest) {
  SkeinRun& run = this->run("run", drawn_flight());
  const std::string uav = drawn(uavs_of(run));
  ChildProcess& process = again("rerun", run, "again", {"--uav", uav, "--dds", drawn({"cyclonedds", "fastdds"})});
  EXPECT_EQ(process.wait().code, 0) << process.out() << process.err();
  EXPECT_EQ(result_in("again")["digest"], run.digest());
}

TEST_F(Rerun, AnotherPlannerGetsTheSameInputsAndItsDifferenceIsReported) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "kios", "--duration", "40", "--one-process"});
  ChildProcess& process = again("rerun", run, "other", {"--uav", "jurong", "--planner", "patrol"});
  EXPECT_EQ(process.wait().code, 1) << process.err();
  EXPECT_NE(process.out().find("jurong first differs at "), std::string::npos) << process.out();
  EXPECT_EQ(result_in("other")["digest"], run.digest()) << "the output of the other planner changed the flight";
  EXPECT_EQ(text_of(folder() / "other" / "trajectories.csv"), text_of(run.dir() / "trajectories.csv"));
  ChildProcess& debugged = again("rerun", run, "none", {"--uav", "jurong", "--debug", "changi=gdb"});
  EXPECT_EQ(debugged.wait().code, 2) << debugged.out();
  EXPECT_NE(debugged.err().find("only the program of jurong runs"), std::string::npos) << debugged.err();
  ChildProcess& fork = again("fork", run, "none", {"--at", "20", "--planner", "patrol"});
  EXPECT_EQ(fork.wait().code, 2) << fork.out();
  EXPECT_NE(fork.err().find("--planner patrol: must be UAV=PLANNER"), std::string::npos) << fork.err();
}

TEST_F(Rerun, AForkWithoutAChangeIsTheRun) {
  SkeinRun& run = this->run("run", drawn_flight());
  ChildProcess& process = again("fork", run, "fork", {"--at", std::to_string(3 + draw_() % 35)});
  EXPECT_EQ(process.wait().code, 0) << process.out() << process.err();
  EXPECT_NE(process.out().find("the fork is the same run"), std::string::npos) << process.out();
  EXPECT_EQ(result_in("fork")["digest"], run.digest());
  EXPECT_TRUE(text_of(folder() / "fork" / run_folder::kRecording) == text_of(run.dir() / run_folder::kRecording))
      << "the recordings differ";
}

TEST_F(Rerun, AForkDiffersFromTheRunOnlyAfterTheGivenTime) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "kios", "--duration", "60", "--one-process"});
  ChildProcess& process = again("fork", run, "fork", {"--at", "30", "--planner", "jurong=hover"});
  EXPECT_EQ(process.wait().code, 0) << process.out() << process.err();
  const auto then = read_csv(run.dir() / "digests.csv"), now = read_csv(folder() / "fork" / "digests.csv");
  std::size_t same = 0;
  while (same < std::min(then.size(), now.size()) && then[same] == now[same]) ++same;
  EXPECT_GE(same, 600U) << "the first 30 s, in steps of 0.05 s, must be the same";
  EXPECT_LT(same, 640U);
  EXPECT_EQ(result_in("fork")["differences"], Json::array())
      << "neither hover's unused output before the fork nor other UAVs' output may count as a difference";
}

TEST_F(Rerun, RunsThatCannotBeFlownAgainAreReported) {
  SkeinRun& without = this->run("without", {"towers", "--planner", "hover", "--duration", "2", "--record=none"});
  const auto refused = [&](const std::string& command, const SkeinRun& run, const Arguments& more,
                           const std::string& why) {
    ChildProcess& process = again(command, run, "refused", more);
    EXPECT_EQ(process.wait().code, 2);
    EXPECT_NE(process.err().find(why), std::string::npos) << process.err();
    EXPECT_FALSE(fs::exists(folder() / "refused" / run_folder::kResult));
  };
  refused("rerun", without, {"--uav", "jurong"}, "there is no recording.mcap");
  SkeinRun& whole = this->run("whole", {"towers", "--planner", "hover", "--duration", "2"});
  refused("rerun", whole, {"--uav", "nobody"}, "nobody");
  refused("fork", whole, {"--at", "1", "--planner", "jurong=nothing"}, "nothing");
  refused("fork", whole, {"--at", "500"}, "the run ended at ");
  SkeinRun& other = this->run("other", {"towers", "--planner", "hover", "--duration", "2", "--seed", "3"});
  fs::copy_file(other.dir() / run_folder::kRecording, whole.dir() / run_folder::kRecording,
                fs::copy_options::overwrite_existing);
  refused("rerun", whole, {"--uav", "jurong"}, "is the recording of another run");
  refused("fork", whole, {"--at", "1"}, "is the recording of another run");
  Json unknown = Json::parse(text_of(other.dir() / run_folder::kResult));
  unknown.erase("checksum");
  unknown["command"] = "  ";
  std::ofstream(other.dir() / run_folder::kResult) << unknown.dump();
  refused("rerun", other, {"--uav", "jurong"}, "does not say how it was started");
  fs::resize_file(whole.dir() / run_folder::kRecording, fs::file_size(whole.dir() / run_folder::kRecording) / 2);
  refused("rerun", whole, {"--uav", "jurong"}, "cut off");
}

TEST_F(Rerun, ASecondRerunHasAFolderOfItsOwn) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "hover", "--duration", "2", "--one-process"});
  for (const char* folder : {"rerun-jurong", "rerun-jurong-2"}) {
    ChildProcess& process = skein({"rerun", run.dir(), "--uav", "jurong"});
    EXPECT_EQ(process.wait().code, 0) << process.err();
    EXPECT_TRUE(fs::exists(run.dir() / folder / run_folder::kResult)) << folder;
  }
  for (const char* folder : {"fork", "fork-2"}) {
    ChildProcess& process = skein({"fork", run.dir(), "--at", "1"});
    EXPECT_EQ(process.wait().code, 0) << process.err();
    EXPECT_TRUE(fs::exists(run.dir() / folder / run_folder::kResult)) << folder;
  }
}

TEST_F(Rerun, SimultaneousRerunsHaveFoldersOfTheirOwn) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "hover", "--duration", "2", "--one-process"});
  for (const auto& [name, more] : {std::pair<std::string, Arguments>{"rerun-jurong", {"--uav", "jurong"}},
                                   std::pair<std::string, Arguments>{"fork", {"--at", "1"}}}) {
    const std::string command = name.substr(0, name.find('-'));
    Arguments words = {program("skein"), command, run.dir()};
    words.insert(words.end(), more.begin(), more.end());
    ChildProcess &one = start_program(name, words), &other = start_program(name + "-2", words);
    EXPECT_EQ(one.wait().code, 0) << one.err();
    EXPECT_EQ(other.wait().code, 0) << other.err();
    for (const std::string& folder : {name, name + "-2"}) {
      EXPECT_TRUE(fs::exists(run.dir() / folder / run_folder::kResult)) << folder;
    }
  }
}

/// Commands read a run in which one bit of a file is flipped.
class DamagedRun : public Rerun {
 protected:
  void flip(const fs::path& file, const std::string& bytes) {
    std::string bad = bytes;
    const std::size_t bit = std::uniform_int_distribution<std::size_t>(0, 8 * bytes.size() - 1)(draw_);
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(file, std::ios::binary) << bad;
    what_ = file.filename().string() + ", bit " + std::to_string(bit);
  }
  void expect_reported(const Arguments& command, int code, const std::string& file) {
    ChildProcess& process = skein(command);
    EXPECT_EQ(process.wait().code, code) << what_ << ": " << joined(command) << process.out() << process.err();
    EXPECT_NE(process.err().find(file), std::string::npos) << what_ << ": " << joined(command) << process.err();
    EXPECT_NE(process.err().find("damaged"), std::string::npos) << what_ << ": " << joined(command) << process.err();
  }

  std::string what_;
};

TEST_F(DamagedRun, EachCommandThatReadsTheRecordingReportsAFlippedBit) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "patrol", "--duration", "15", "--one-process"});
  fs::copy(run.dir(), folder() / "sound", fs::copy_options::recursive);
  const fs::path file = run.dir() / run_folder::kRecording;
  const std::string bytes = text_of(file);
  for (int draw = 0; draw < 8 && !HasFailure(); ++draw) {
    flip(file, bytes);
    expect_reported({"fork", run.dir(), "--at", "5", "--out", folder() / "no"}, 2, run_folder::kRecording);
    expect_reported({"rerun", run.dir(), "--uav", "jurong", "--out", folder() / "no"}, 2, run_folder::kRecording);
    EXPECT_FALSE(fs::exists(folder() / "no" / run_folder::kResult));
    expect_reported({"report", run.dir()}, 1, run_folder::kRecording);
    expect_reported({"diff", run.dir(), folder() / "sound"}, 2, run_folder::kRecording);
  }
  expect_reported({"merge", run.dir()}, 1, run_folder::kRecording);
}

TEST_F(DamagedRun, EachCommandThatReadsTheResultReportsAFlippedBit) {
  SkeinRun& run = this->run("run", {"towers", "--planner", "patrol", "--duration", "15", "--one-process"});
  fs::copy(run.dir(), folder() / "sound", fs::copy_options::recursive);
  const fs::path file = run.dir() / run_folder::kResult;
  Json result = Json::parse(text_of(file));
  const std::string bytes = text_of(file).substr(0, text_of(file).find("\"checksum\""));
  const std::string rest = text_of(file).substr(bytes.size());
  for (int draw = 0; draw < 12 && !HasFailure(); ++draw) {
    flip(file, bytes);
    std::ofstream(file, std::ios::binary | std::ios::app) << rest;
    if (Json::parse(text_of(file), nullptr, false) == result) continue;  // flipped the case of an exponent's letter
    expect_reported({"diff", run.dir(), folder() / "sound"}, 2, run_folder::kResult);
    expect_reported({"fork", run.dir(), "--at", "5", "--out", folder() / "no"}, 2, run_folder::kResult);
    expect_reported({"report", run.dir()}, 2, run_folder::kResult);
  }
  // A result that was edited, and whose checksum was removed.
  result["score"] = 1234.5;
  result.erase("checksum");
  std::ofstream(file) << result.dump();
  ChildProcess& diff = skein({"diff", run.dir(), folder() / "sound"});
  EXPECT_EQ(diff.wait().code, 1);
  EXPECT_NE(diff.out().find("score 1234.5"), std::string::npos) << diff.out();
}

TEST_F(DamagedRun, DiffNamesTheMessageThatDiffers) {
  SkeinRun& one = this->run("one", {"towers", "--planner", "patrol", "--duration", "20", "--one-process"});
  SkeinRun& other =
      this->run("other", {"towers", "--planner", "patrol,jurong=hover", "--duration", "20", "--one-process"});
  SkeinRun& same = this->run("same", {"towers", "--planner", "patrol", "--duration", "20", "--dds=mixed"});
  ChildProcess& differs = skein({"diff", one.dir(), other.dir()});
  EXPECT_EQ(differs.wait().code, 1) << differs.err();
  EXPECT_NE(differs.out().find("recording.mcap, at "), std::string::npos) << differs.out();
  EXPECT_NE(differs.out().find("/jurong/"), std::string::npos) << differs.out();
  ChildProcess& equal = skein({"diff", one.dir(), same.dir()});
  EXPECT_EQ(equal.wait().code, 0) << equal.out() << equal.err();
  EXPECT_EQ(equal.out(), "the runs are the same\n");
}

}  // namespace
}  // namespace skein::test
