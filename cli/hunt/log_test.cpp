// The folder of a hunt: a hunt continues with all earlier runs, or refuses the folder, and no option deletes a find.
#include "cli/hunt/log.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "cli/hunt/search.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const Json kHuntSettings = {{"seed", 1}, {"scenario", "towers"}};

TrialOutcome some_outcome(double score) {
  TrialOutcome outcome;
  outcome.digest = "d";
  outcome.score = score;
  outcome.began_s = {std::nullopt, 2.0};
  outcome.states = {1, 2, 3};
  return outcome;
}

class HuntLogFile : public testing::Test {
 protected:
  HuntLogFile() {
    HuntLog log(dir_, kHuntSettings, false);
    for (std::size_t i = 0; i < kCases; ++i) log.add(i, "flight " + std::to_string(i), some_outcome(double(i)));
    text_ = read_text(file_);
  }
  /// The number of cases in the log when the hunt continues.
  std::size_t cases() const {
    const HuntLog log(dir_, kHuntSettings, false);
    return log.outcomes().size();
  }
  static std::string of_case(std::uint64_t index) {
    return json_text({{"case", index}, {"flown", "x"}, {"outcome", some_outcome(1.0).to_json()}});
  }
  std::string refusal() const {
    try {
      HuntLog(dir_, kHuntSettings, false);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  static constexpr std::size_t kCases = 6;
  const ScratchDir scratch_;
  const fs::path dir_ = scratch_.path() / "hunt", file_ = dir_ / "log.jsonl";
  std::string text_;
};

TEST_F(HuntLogFile, AHuntResumesWithTheCasesInItsLog) {
  EXPECT_EQ(cases(), kCases);
  EXPECT_EQ(read_text(file_), text_);
}

TEST_F(HuntLogFile, AHuntDropsOnlyTheIncompleteLastLineOfItsLog) {
  const std::size_t begin_of_last = text_.rfind('\n', text_.size() - 2) + 1;
  for (std::size_t size = begin_of_last; size < text_.size(); ++size) {
    write_text(file_, text_.substr(0, size));
    ASSERT_EQ(cases(), kCases - 1) << size;
    ASSERT_EQ(read_text(file_), text_.substr(0, begin_of_last));
  }
  HuntLog(dir_, kHuntSettings, false).add(kCases - 1, "again", some_outcome(1.0));
  EXPECT_EQ(cases(), kCases);
}

TEST_F(HuntLogFile, ALogMayHaveTheCasesOfARoundInAnyOrder) {
  write_text(file_, of_case(HuntSearch::kMostLag - 1) + "\n" + of_case(0) + "\n");
  EXPECT_EQ(cases(), HuntSearch::kMostLag);
}

// Another build may draw other cases. It must not use the logged outcomes for them.
TEST_F(HuntLogFile, ALogWithACaseThatThisBuildDoesNotDrawIsRefused) {
  const HuntLog log(dir_, kHuntSettings, false);
  for (std::size_t i = 0; i < kCases; ++i) {
    EXPECT_NO_THROW(log.check(i, "flight " + std::to_string(i)));
    EXPECT_THROW(log.check(i, "flight " + std::to_string(i + 1)), InputError);
  }
  EXPECT_NO_THROW(log.check(kCases, "a flight that has not been flown"));
}

TEST_F(HuntLogFile, ADamagedLineIsRefusedAndNamed) {
  std::mt19937_64 random(1);
  for (std::size_t line = 1; line <= kCases; ++line) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < line; ++i) begin = text_.find('\n', begin) + 1;
    const std::size_t length = text_.find('\n', begin) - begin;
    for (const std::string& instead :
         {std::string("{}"), text_.substr(begin, 1 + random() % (length - 1)), std::string(length, '\0'),
          std::string("{\"case\": -1, \"flown\": \"x\", \"outcome\": {}}"), of_case(9'999'999),
          of_case(line + HuntSearch::kMostLag), of_case(std::numeric_limits<std::uint64_t>::max())}) {
      std::string damaged = text_;
      write_text(file_, damaged.replace(begin, length, instead));
      const std::string said = refusal();
      EXPECT_NE(said.find(file_.string() + ":" + std::to_string(line) + ": is damaged"), std::string::npos) << said;
      EXPECT_EQ(read_text(file_), damaged) << "the log stays as it is";
    }
  }
  write_text(file_, text_);
  write_text(dir_ / "hunt.json", "{\"seed\": 1,");
  EXPECT_NE(refusal().find("hunt.json: is damaged"), std::string::npos) << refusal();
  EXPECT_EQ(HuntLog(dir_, kHuntSettings, true).outcomes().size(), 0U) << "the caller asked for a new log";
}

class HuntLogs : public testing::Test {
 protected:
  HuntLogs() { fs::create_directories(dir_); }
  ~HuntLogs() override { fs::remove_all(dir_); }

  void find(const std::string& name) const {
    fs::create_directories(dir_ / "finds" / name);
    std::ofstream(dir_ / "finds" / (name + ".yaml")) << "name: " << name << '\n';
  }

  const fs::path dir_ = fs::path(testing::TempDir()) / ("skein_hunt_log_" + std::to_string(::getpid()));
  const Json one_{{"seed", 1}}, other_{{"seed", 2}};
};

TEST_F(HuntLogs, ANewHuntKeepsAndNamesTheFindsOfEveryEarlierHunt) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  find("separation-3");
  find("all_fly_on-17");
  EXPECT_THROW(HuntLog(dir_, other_, false), InputError);
  {
    const HuntLog second(dir_, other_, true);
    EXPECT_TRUE(second.outcomes().empty());
    ASSERT_EQ(second.kept(), (std::vector<fs::path>{dir_ / "earlier/1/finds/all_fly_on-17.yaml",
                                                    dir_ / "earlier/1/finds/separation-3.yaml"}));
    EXPECT_EQ(read_text(second.kept().front()), "name: all_fly_on-17\n");
  }
  EXPECT_TRUE(fs::is_directory(dir_ / "earlier/1/finds/separation-3")) << "the results folder of the find";
  EXPECT_NE(read_text(dir_ / "earlier/1/log.jsonl").find("\"first\""), std::string::npos);
  EXPECT_EQ(parse_json(read_text(dir_ / "earlier/1/hunt.json")), one_);

  find("separation-3");
  const HuntLog third(dir_, other_, true);
  EXPECT_EQ(third.kept(), std::vector<fs::path>{dir_ / "earlier/2/finds/separation-3.yaml"})
      << "also with the same settings";
  EXPECT_TRUE(fs::exists(dir_ / "earlier/1/finds/separation-3.yaml"));
}

TEST_F(HuntLogs, ARefusalNamesADifferentSettingAlsoIfThisCommandDoesNotHaveIt) {
  const Json in_long_rounds{{"round", 128}, {"seed", 1}};
  HuntLog(dir_, in_long_rounds, false).add(0, "first", {.digest = "ab"});
  try {
    HuntLog(dir_, other_, false);
    ADD_FAILURE() << "the hunt was continued";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("differs in seed, round; choose another --out"), std::string::npos)
        << error.what();
  }
}

TEST_F(HuntLogs, RefuseAFolderWithOtherFilesAndChangeNothingThere) {
  fs::permissions(dir_, fs::perms(0755));
  struct stat before {
  }, after{};
  ASSERT_EQ(::stat(dir_.c_str(), &before), 0);
  const auto refusal = [&](bool force) -> std::string {
    try {
      HuntLog(dir_, one_, force);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  // The reports of a run and of a study have the name of a hunt's; a study with --executor has a folder `sweep`, too.
  for (const std::string name : {"report.html", "log.jsonl", "finds", "flights", "earlier", "sweep"}) {
    write_text(dir_ / name, "mine");
    for (const bool force : {false, true}) {
      EXPECT_NE(refusal(force).find("'" + name + "' exists and belongs to no hunt"), std::string::npos) << name;
      EXPECT_EQ(read_text(dir_ / name), "mine");
    }
    fs::remove(dir_ / name);
  }
  for (const std::string name : {"result.json", "notes.txt", "study.json"}) {
    write_text(dir_ / name, "mine");
    EXPECT_NE(refusal(false).find("'" + name + "' exists and belongs to no hunt"), std::string::npos) << refusal(false);
    EXPECT_NE(refusal(false).find("--force"), std::string::npos) << refusal(false);
    EXPECT_EQ(std::distance(fs::directory_iterator(dir_), {}), 1) << "nothing is written";
    EXPECT_EQ(refusal(true), "");
    EXPECT_EQ(read_text(dir_ / name), "mine");
    fs::remove_all(dir_);
    fs::create_directory(dir_);
    ASSERT_EQ(::chmod(dir_.c_str(), 0755), 0);
  }
  write_text(dir_ / "slurm-17.out", "of the job that hunts");
  EXPECT_EQ(refusal(false), "");
  ASSERT_EQ(::stat(dir_.c_str(), &after), 0);
  EXPECT_EQ(after.st_mode, before.st_mode) << "a folder that the user made stays as open as it is";
  EXPECT_EQ(after.st_gid, before.st_gid);
}

TEST_F(HuntLogs, NeverShareAFolder) {
  HuntLog first(dir_, one_, false);
  first.add(0, "first", {.digest = "ab"});
  for (const bool force : {false, true}) {
    EXPECT_THROW(HuntLog(dir_, one_, force), FolderInUse);
    EXPECT_THROW(HuntLog(dir_, other_, force), FolderInUse);
  }
  first.add(1, "second", {.digest = "cd"});
  EXPECT_EQ(first.outcomes().size(), 2U);
  EXPECT_EQ(std::ranges::count(read_text(dir_ / "log.jsonl"), '\n'), 2);
}

// Otherwise the hunt would fly for hours without a log, and the same command would fly all cases again.
TEST_F(HuntLogs, ALogThatCannotBeWrittenEndsTheHunt) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    HuntLog log(dir_, one_, false);
    log.add(0, "first", {.digest = "ab"});
    const rlim_t most = fs::file_size(dir_ / "log.jsonl") + 10;
    const rlimit limit{most, most};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      log.add(1, "second", {.digest = "cd"});
    } catch (const std::runtime_error& error) {
      code = std::string(error.what()).find("log.jsonl: cannot be written") != std::string::npos ? 0 : 2;
    }
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(HuntLog(dir_, one_, false).outcomes().size(), 1U) << "the next hunt drops the incomplete line";
}

// Finds are of little use without the log and the settings of their hunt.
TEST_F(HuntLogs, ALogStaysAsItWasWhenItsSettingsCannotBeKept) {
  constexpr std::size_t kLimit = 300 << 10;  // a limit on the size of files has the effect of a full disk
  const Json large{{"seed", 1}, {"text", std::string(2 * kLimit, 'x')}};
  HuntLog(dir_, large, false).add(0, "first", {.digest = "ab"});
  find("separation-3");
  const std::string log = read_text(dir_ / "log.jsonl"), settings = read_text(dir_ / "hunt.json");
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{kLimit, kLimit};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      HuntLog(dir_, other_, true);
    } catch (const std::runtime_error&) {
      code = 0;
    }
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(status, 0) << "the child did not report that the settings cannot be written";
  EXPECT_TRUE(fs::exists(dir_ / "finds/separation-3.yaml"));
  EXPECT_EQ(read_text(dir_ / "log.jsonl"), log);
  EXPECT_EQ(read_text(dir_ / "hunt.json"), settings);

  const HuntLog second(dir_, other_, true);
  EXPECT_EQ(second.kept(), std::vector<fs::path>{dir_ / "earlier/1/finds/separation-3.yaml"});
  EXPECT_EQ(read_text(dir_ / "earlier/1/log.jsonl"), log);
  EXPECT_EQ(read_text(dir_ / "earlier/1/hunt.json"), settings);
}

TEST_F(HuntLogs, ThatContinueKeepFindsWhereTheyAre) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  find("separation-3");
  const HuntLog again(dir_, one_, false);
  EXPECT_TRUE(again.kept().empty());
  EXPECT_EQ(again.outcomes().size(), 1U);
  EXPECT_TRUE(fs::exists(dir_ / "finds/separation-3.yaml"));
}

TEST_F(HuntLogs, WithoutFindsKeepNothingOfAnEarlierHunt) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  const HuntLog second(dir_, other_, true);
  EXPECT_TRUE(second.kept().empty());
  EXPECT_FALSE(fs::exists(dir_ / HuntLog::kEarlier));
}

}  // namespace
}  // namespace skein::cli
