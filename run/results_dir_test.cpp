#include "run/results_dir.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <thread>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// A folder for results, inside a scratch folder. The test holds the lock of the scratch folder itself.
class OutDir {
 public:
  OutDir() { fs::create_directory(path_); }
  const fs::path& path() const { return path_; }

 private:
  const ScratchDir scratch_;
  const fs::path path_ = scratch_.path() / "out";
};

/// While this object lives, the given folder is the current folder.
class CurrentFolder {
 public:
  explicit CurrentFolder(const fs::path& folder) { fs::current_path(folder); }
  ~CurrentFolder() { fs::current_path(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

 private:
  const fs::path before_ = fs::current_path();
};

TEST(ResultsDir, TheDefaultNameDescribesTheRun) {
  EXPECT_EQ(default_results_dir("towers", "patrol", 3), "runs/towers-patrol-3");
  EXPECT_EQ(default_results_dir("towers", "a=b:c/d", 0), "runs/towers-a_b_c_d-0");
}

TEST(ResultsDir, TheFirstFreeNumberedNameIsChosen) {
  const OutDir scratch;
  const fs::path base = scratch.path() / "runs" / "towers-kios-0";
  EXPECT_EQ(free_results_dir(base), base);
  fs::create_directories(base);
  EXPECT_EQ(free_results_dir(base), base) << "an empty folder counts as free";
  write_text(base / "sim_server.mcap", "of a launcher that was killed");
  EXPECT_EQ(free_results_dir(base), base.string() + "-2");
  fs::create_directories(base.string() + "-2");
  write_text(base.string() + "-2/result.json", "{}");
  write_text(base.string() + "-3", "a file");
  fs::create_directory_symlink(base, base.string() + "-4");
  EXPECT_EQ(free_results_dir(base), base.string() + "-5");
  EXPECT_FALSE(fs::exists(base.string() + "-5")) << "free_results_dir() must not create the folder";
}

TEST(ResultsDir, IsCreatedWithItsParents) {
  const OutDir scratch;
  const ResultsDir dir(scratch.path() / "a/b", false);
  EXPECT_TRUE(fs::is_directory(dir.path()));
}

TEST(ResultsDir, AnExistingResultIsKeptUnlessForced) {
  const OutDir scratch;
  write_text(scratch.path() / "result.json", "{}");
  EXPECT_THROW(ResultsDir::check(scratch.path(), false), InputError);
  EXPECT_THROW(ResultsDir(scratch.path(), false), InputError);
  EXPECT_TRUE(fs::exists(scratch.path() / "result.json"));
  ResultsDir::check(scratch.path(), true);
  EXPECT_TRUE(fs::exists(scratch.path() / "result.json"));
  const ResultsDir dir(scratch.path(), true);
  EXPECT_FALSE(fs::exists(scratch.path() / "result.json"));
}

TEST(ResultsDir, OnlyFilesThatARunWritesAreRemoved) {
  const OutDir scratch;
  const auto of_runs = {"station.report.json", "station.journal", "comm_router.counts",       "uav_agent-alpha.log",
                        "digests.csv",         "scene.json",      "station.report.json.tmp7", "result.json.tmp1234"};
  const auto of_others = {"notes.txt", "my.log", "station-notes.txt", "mine.tmp7"};
  for (const char* name : of_runs) write_text(scratch.path() / name, "x");
  for (const char* name : of_others) write_text(scratch.path() / name, "x");
  const ResultsDir dir(scratch.path(), true);
  for (const char* name : of_runs) EXPECT_FALSE(fs::exists(scratch.path() / name)) << name;
  for (const char* name : of_others) EXPECT_TRUE(fs::exists(scratch.path() / name)) << name;
}

TEST(ResultsDir, WithoutForceAFileThatARunWouldWriteOrDeleteIsKeptAndNamed) {
  for (const char* name : {"scene.json", "station.log", "hand-bob.csv", "map-x.bt", "uav_agent-alpha.txt"}) {
    const OutDir scratch;
    write_text(scratch.path() / name, "mine");
    const auto refusal = [&](const auto& take) -> std::string {
      try {
        take();
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    };
    for (const std::string& told : {refusal([&] { ResultsDir::check(scratch.path(), false); }),
                                    refusal([&] { const ResultsDir dir(scratch.path(), false); })}) {
      EXPECT_NE(told.find(scratch.path().string() + " holds '" + name + "'"), std::string::npos) << told;
      EXPECT_NE(told.find("--force"), std::string::npos) << told;
    }
    EXPECT_EQ(read_text(scratch.path() / name), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
    EXPECT_NO_THROW(ResultsDir(scratch.path(), Earlier::keep));
    EXPECT_EQ(read_text(scratch.path() / name), "mine");
  }
}

TEST(ResultsDir, AFolderWithOnlyOtherFilesIsAcceptedAndKeepsItsPermissions) {
  const OutDir scratch;
  write_text(scratch.path() / "notes.txt", "mine");
  fs::create_directory(scratch.path() / "uav_agent-sources");
  fs::permissions(scratch.path(), fs::perms(0755));
  struct stat before {
  }, after{};
  ASSERT_EQ(::stat(scratch.path().c_str(), &before), 0);
  { const ResultsDir dir(scratch.path(), false); }
  ASSERT_EQ(::stat(scratch.path().c_str(), &after), 0);
  EXPECT_EQ(after.st_mode, before.st_mode);
  EXPECT_EQ(after.st_gid, before.st_gid);
  EXPECT_EQ(read_text(scratch.path() / "notes.txt"), "mine");
  if (::geteuid() != 0) GTEST_SKIP() << "agents have users of their own only if root starts them";
  const fs::path created = scratch.path() / "created";
  { const ResultsDir dir(created, false); }
  ASSERT_EQ(::stat(created.c_str(), &after), 0);
  EXPECT_EQ(after.st_mode & S_IRWXG, 0U) << "the folder must be closed to agents";
}

TEST(ResultsDir, TwoRunsNeverShareAFolder) {
  const OutDir scratch;
  {
    const ResultsDir first(scratch.path(), false);
    EXPECT_THROW(ResultsDir(scratch.path(), false), InputError);
    try {
      ResultsDir::check(scratch.path(), false);
      ADD_FAILURE() << "the second run was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("another run is writing there"), std::string::npos) << error.what();
    }
  }
  const ResultsDir second(scratch.path(), false);
}

// A command that only asks whether a run writes to a folder takes the folder's lock for a moment. This must not keep
// another command from taking the folder.
TEST(ResultsDir, AskingWhetherAFolderIsInUseKeepsNoLauncherOut) {
  const OutDir scratch;
  write_text(scratch.path() / "result.json", "{}");
  std::atomic<bool> over = false;
  std::size_t asked = 0;
  std::thread asking([&] {
    while (!over) {
      try {
        ResultsDir::check(scratch.path(), false);
      } catch (const InputError&) {  // the folder has a result, or is in use
        ++asked;
      }
    }
  });
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    try {
      const ResultsDir dir(scratch.path(), Earlier::keep);
    } catch (const FolderInUse&) {
      ++refused;
    }
  }
  over = true;
  asking.join();
  EXPECT_EQ(refused, 0);
  EXPECT_GT(asked, 0U);
}

TEST(ResultsDir, RunsWithoutOutThatStartAtOnceGetDifferentFolders) {
  const OutDir scratch;
  const CurrentFolder current(scratch.path());
  const RunOptions run;
  const auto first = ResultsDir::take(run, "towers");
  fs::remove(first->path() / "result.json.tmp-room");  // as if the first run had only just locked the folder
  const auto second = ResultsDir::take(run, "towers");
  EXPECT_EQ(second->given(), first->given().string() + "-2");
  RunOptions forced, named;
  forced.force = true;
  named.out = first->given();
  EXPECT_THROW(ResultsDir::take(forced, "towers"), FolderInUse);
  EXPECT_THROW(ResultsDir::take(named, "towers"), FolderInUse);
}

TEST(ResultsDir, RunsThatACommandPutsElsewhereGetDifferentFolders) {
  const OutDir scratch;
  RunOptions run;
  run.usual_out = scratch.path() / "fork";
  EXPECT_EQ(results_dir_of(run, "towers"), scratch.path() / "fork");
  const auto first = ResultsDir::take(run, "towers");
  fs::remove(first->path() / "result.json.tmp-room");  // as if the first run had only just locked the folder
  EXPECT_EQ(results_dir_of(run, "towers"), first->given()) << "the folder looks free";
  EXPECT_EQ(ResultsDir::take(run, "towers")->given(), scratch.path() / "fork-2");
  run.force = true;
  EXPECT_THROW(ResultsDir::take(run, "towers"), FolderInUse);
  run.out = scratch.path() / "named";
  EXPECT_EQ(ResultsDir::take(run, "towers")->given(), *run.out);
}

TEST(ResultsDir, AFolderForSeveralFlightsMustBeEmptyOrForced) {
  const OutDir scratch;
  const fs::path usual = scratch.path() / "blame", named = scratch.path() / "named", mine = named / "as-it-was/mine";
  fs::create_directories(mine.parent_path());
  write_text(mine, "mine");
  try {
    ResultsDir::take_for_flights(named, usual, false);
    ADD_FAILURE() << "the folder was accepted";
  } catch (const InputError& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find(named.string() + ": 'as-it-was' exists already"), std::string::npos) << told;
    EXPECT_NE(told.find("--force"), std::string::npos) << told;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(named), {}), 1);
  EXPECT_EQ(ResultsDir::take_for_flights(named, usual, true)->given(), named);
  EXPECT_EQ(read_text(mine), "mine") << "only a flight that needs the place deletes the file";

  fs::create_directory(scratch.path() / "new");
  write_text(scratch.path() / "new/job.log", "of the job that flies");
  EXPECT_EQ(ResultsDir::take_for_flights(scratch.path() / "new", usual, false)->given(), scratch.path() / "new");
  const auto first = ResultsDir::take_for_flights(std::nullopt, usual, false);
  EXPECT_EQ(first->given(), usual);
  EXPECT_EQ(ResultsDir::take_for_flights(std::nullopt, usual, false)->given(), usual.string() + "-2");
  EXPECT_THROW(ResultsDir::take_for_flights(std::nullopt, usual, true), FolderInUse);
  EXPECT_THROW(ResultsDir::take_for_flights(usual, usual, true), FolderInUse);
}

TEST(ResultsDir, LogsAndEntriesOfFileSystemsAreNotForeign) {
  const OutDir scratch;
  EXPECT_EQ(foreign_entry(scratch.path()), "");
  EXPECT_EQ(foreign_entry(scratch.path() / "none"), "");
  for (const char* name : {"slurm-17.out", "job.log", "job.err", ".hidden", "result.json.tmp-room"}) {
    write_text(scratch.path() / name, "x");
  }
  fs::create_directory(scratch.path() / "lost+found");
  EXPECT_EQ(foreign_entry(scratch.path()), "");
  fs::create_directory(scratch.path() / "log.log");
  EXPECT_EQ(foreign_entry(scratch.path()), "log.log") << "a folder is not a log";
  write_text(scratch.path() / "a.json", "x");
  EXPECT_EQ(foreign_entry(scratch.path()), "a.json");
  fs::remove(scratch.path() / "a.json");
  fs::remove(scratch.path() / "log.log");

  const fs::path printed = scratch.path() / "output of job 17";
  write_text(printed, "");
  EXPECT_EQ(foreign_entry(scratch.path()), printed.filename());
  for (const int fd : {STDOUT_FILENO, STDERR_FILENO}) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::dup2(::open(printed.c_str(), O_WRONLY | O_APPEND), fd);
      ::_exit(foreign_entry(scratch.path()).empty() ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << fd;
  }
}

TEST(ResultsDir, AFileIsRefusedAsAFolder) {
  const OutDir scratch;
  write_text(scratch.path() / "file", "");
  EXPECT_THROW(ResultsDir(scratch.path() / "file", true), InputError);
  EXPECT_THROW(ResultsDir(scratch.path() / "file/below", true), InputError);
}

TEST(ResultsDir, APathThatCannotExistIsTheUsersMistake) {
  const OutDir scratch;
  fs::create_symlink(scratch.path() / "b", scratch.path() / "a");
  fs::create_symlink(scratch.path() / "a", scratch.path() / "b");
  for (const fs::path& dir :
       {scratch.path() / "a", scratch.path() / "a/below", scratch.path() / std::string(5000, 'x')}) {
    EXPECT_THROW(ResultsDir(dir, false), InputError) << dir;
    EXPECT_THROW(ResultsDir(dir, true), InputError) << dir;
  }
}

TEST(ResultsDir, PipesAndLinksWithNamesOfFilesAreDeletedAndAFolderIsNamed) {
  const OutDir scratch;
  ASSERT_EQ(::mkfifo((scratch.path() / "sim_server.log").c_str(), 0600), 0);
  write_text(scratch.path() / "mine.txt", "kept");
  fs::create_symlink(scratch.path() / "mine.txt", scratch.path() / "station.journal");
  fs::create_symlink("/dev/full", scratch.path() / "events.csv");
  EXPECT_THROW(ResultsDir(scratch.path(), false), InputError);
  { const ResultsDir dir(scratch.path(), true); }
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
  EXPECT_EQ(read_text(scratch.path() / "mine.txt"), "kept");
  fs::create_directory(scratch.path() / "sim_server.log");
  try {
    const ResultsDir dir(scratch.path(), true);
    ADD_FAILURE() << "the folder was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sim_server.log"), std::string::npos) << error.what();
  }
}

/// The result of `body` under a limit of the file size, which has the same effect on a program as a full disk.
int with_file_limit(rlim_t bytes, const std::function<bool()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(body() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(ResultsDir, ARunDoesNotStartWithoutSpaceForItsResult) {
  const OutDir scratch;
  EXPECT_EQ(with_file_limit(1000,
                            [&] {
                              try {
                                const ResultsDir dir(scratch.path(), false);
                                return false;
                              } catch (const InputError& error) {
                                return std::string(error.what()).find(scratch.path()) != std::string::npos;
                              }
                            }),
            0);
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(ResultsDir, AResultThatCannotBeWrittenIsReportedAndLeavesNoPartOfAFile) {
  const OutDir scratch;
  EXPECT_EQ(with_file_limit(300 << 10,
                            [&] {
                              const ResultsDir dir(scratch.path(), false);
                              const std::string whole(200 << 10, 'x'), too_long(400 << 10, 'x');
                              return dir.write_result(whole).empty() &&
                                     dir.write_result(too_long).find("result.json") != std::string::npos;
                            }),
            0);
  EXPECT_EQ(fs::file_size(scratch.path() / "result.json"), 200U << 10) << "the former result stays";
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), {}), 1);
}

}  // namespace
}  // namespace skein::cli
