#include "process/program.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <condition_variable>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "process/log_lines.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

struct Outcome {
  int code = 0;
  std::string error;
};

Outcome run(std::vector<const char*> arguments, const ProgramBody& body, const AddOptions& add_options = {}) {
  arguments.insert(arguments.begin(), "tester");
  ::testing::internal::CaptureStderr();
  const int code = run_program("tester", static_cast<int>(arguments.size()), arguments.data(), add_options, body);
  return {code, ::testing::internal::GetCapturedStderr()};
}

int nothing(const ProgramOptions&, StopSignal&) { return kExitDone; }

TEST(Program, ReturnsTheExitCodeOfItsBody) {
  EXPECT_EQ(run({}, nothing).code, 0);
  EXPECT_EQ(run({}, [](const ProgramOptions&, StopSignal&) { return kExitCheckFailed; }).code, 1);
}

TEST(Program, BadInputGivesOneMessageAndCodeTwo) {
  const auto outcome = run({}, [](const ProgramOptions&, StopSignal&) -> int {
    throw InputError("mbs.yaml:3: duration_s: must be positive");
  });
  EXPECT_EQ(outcome.code, kExitBadInput);
  EXPECT_EQ(outcome.error, "tester: mbs.yaml:3: duration_s: must be positive\n");
}

TEST(Program, OtherFailuresGiveCodeThree) {
  const auto outcome =
      run({}, [](const ProgramOptions&, StopSignal&) -> int { throw std::runtime_error("disk full"); });
  EXPECT_EQ(outcome.code, kExitProcessFailed);
  EXPECT_EQ(outcome.error, "tester: failed: disk full\n");
}

TEST(Program, APathThatCannotExistGivesCodeTwo) {
  const auto look_at = [](const std::filesystem::path& path) {
    return run({}, [&](const ProgramOptions&, StopSignal&) -> int { return std::filesystem::exists(path) ? 0 : 1; });
  };
  const std::string name(300, 'x');
  const Outcome too_long = look_at(name);
  EXPECT_EQ(too_long.code, kExitBadInput);
  EXPECT_EQ(too_long.error, "tester: " + name + ": File name too long\n");
  EXPECT_EQ(look_at("nowhere").code, kExitCheckFailed) << "a missing file is not an error of the path";
  const Outcome full = run({}, [](const ProgramOptions&, StopSignal&) -> int {
    throw std::filesystem::filesystem_error("write", "runs/x", std::make_error_code(std::errc::no_space_on_device));
  });
  EXPECT_EQ(full.code, kExitProcessFailed);
  EXPECT_EQ(full.error, "tester: runs/x: No space left on device\n");
}

std::string refusal_of_out(const std::filesystem::path& out, int control_fd = -1, int status_fd = -1) {
  ProgramOptions options;
  options.out = out;
  options.control_fd = control_fd;
  options.status_fd = status_fd;
  try {
    options.check_out();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Program, WithoutALauncherTheOutputFolderMustExist) {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path(), missing = folder / "none/x", file = folder / "file";
  std::ofstream(file) << "mine";
  EXPECT_EQ(refusal_of_out(folder), "");
  EXPECT_EQ(refusal_of_out("/dev/null"), "") << "with /dev/null, the program writes no files";
  const std::string mend = "; make this folder first, or choose another one";
  EXPECT_EQ(refusal_of_out(missing), "--out " + missing.string() + ": does not exist" + mend);
  EXPECT_EQ(refusal_of_out(file), "--out " + file.string() + ": is no folder" + mend);
  const std::string long_name(300, 'x');
  EXPECT_EQ(refusal_of_out(long_name), "--out " + long_name + ": cannot be read (File name too long)" + mend);
  EXPECT_EQ(refusal_of_out(missing, 4, 3), "") << "its launcher makes the folder";
  EXPECT_EQ(refusal_of_out(missing, -1, 1), "") << "a launcher gets the report through the pipe";
}

TEST(Program, WithoutALauncherTheOutputFolderMustBeWritable) {
  constexpr uid_t kNobody = 65534;  // root may write to every folder
  constexpr rlim_t kEnoughFiles = 64;
  const ScratchFolder scratch;
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::owner_read);
  const std::string refusal = done_with_open_files(kEnoughFiles, [&]() -> std::string {
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return "cannot become another user";
    return refusal_of_out(scratch.path());
  });
  std::filesystem::permissions(scratch.path(), std::filesystem::perms::owner_all);
  EXPECT_EQ(refusal, "--out " + scratch.path().string() +
                         ": cannot be written to (Permission denied); make this folder first, or choose another one");
}

TEST(Program, AWrongCommandLineGivesCodeTwoAndAHint) {
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{"--no-such-option"},
                                             {"--seed", "-1"},
                                             {"--seed", "x"},
                                             {"--domain", "201"},
                                             {"--duration"},
                                             {"--run", "-1"},
                                             {"--run", "18446744073709551616"},
                                             {"--run", "x"},
                                             {"--seed", "18446744073709551616"},
                                             {"--seed", "010"},
                                             {"--scene-seed", "1.5"}}) {
    const auto outcome = run(arguments, nothing);
    EXPECT_EQ(outcome.code, kExitBadInput) << arguments[0];
    EXPECT_NE(outcome.error.find("--help"), std::string::npos) << outcome.error;
  }
  EXPECT_EQ(run({"--log-level", "loud"}, nothing).code, kExitBadInput);
}

TEST(Program, EmptyValuesOfOptionsAreRefused) {
  for (const std::vector<const char*>& arguments : std::vector<std::vector<const char*>>{
           {"--uav="}, {"--uav", ""}, {"--check", "--uav=", "jurong"}, {"--faults="}, {"--network="}, {"--check="}}) {
    std::string uav;
    const auto outcome = run(arguments, nothing, [&](CLI::App& app) { app.add_option("--uav", uav); });
    const std::string option = arguments.size() > 2 ? "--uav" : std::string(arguments[0]);
    EXPECT_EQ(outcome.code, kExitBadInput) << option;
    EXPECT_EQ(outcome.error.find("tester: " + option.substr(0, option.find('=')) + ": must not be empty"), 0U)
        << outcome.error;
    EXPECT_NE(outcome.error.find("--help"), std::string::npos) << outcome.error;
  }
  EXPECT_EQ(run({"--network"}, nothing).code, kExitDone) << "the value of this option may be left out";
  EXPECT_EQ(run({"--network", "--check"}, nothing).code, kExitDone);
}

TEST(Program, ListsWithEmptyItemsAreRefused) {
  const auto outcome_of = [](const std::vector<const char*>& arguments) {
    std::vector<std::string> uavs;
    return run(arguments, nothing, [&](CLI::App& app) { app.add_option("--stand-ins", uavs)->delimiter(','); });
  };
  for (const std::vector<const char*>& arguments :
       std::vector<std::vector<const char*>>{{"--stand-ins", "a,,b"},
                                             {"--stand-ins=a,"},
                                             {"--stand-ins", ",a", "--check"},
                                             {"--check", "--stand-ins", ","},
                                             {"--stand-ins", ",", "--check"},
                                             {"--stand-ins", "a", "b,"}}) {
    const auto outcome = outcome_of(arguments);
    EXPECT_EQ(outcome.code, kExitBadInput) << outcome.error;
    EXPECT_EQ(outcome.error.find("tester: --stand-ins: "), 0U) << outcome.error;
  }
  EXPECT_EQ(outcome_of({"--stand-ins", "a,b", "--check"}).code, kExitDone);
  EXPECT_EQ(outcome_of({"--stand-ins=a,b"}).code, kExitDone);
}

TEST(Program, ReadsItsOptionsAndTheirDefaults) {
  run({}, [](const ProgramOptions& options, StopSignal&) {
    EXPECT_EQ(options.scenario, "towers");
    EXPECT_EQ(options.dds, "cyclonedds");
    EXPECT_EQ(options.seed, 0u);
    EXPECT_FALSE(options.scene_seed.has_value());
    EXPECT_FALSE(options.duration_s.has_value());
    EXPECT_EQ(options.status_fd, -1);
    EXPECT_FALSE(options.network);
    return 0;
  });
  std::string uav;
  const auto outcome = run(
      {"--scenario", "mbs", "--assets", "/data", "--seed", "18446744073709551615", "--scene-seed", "4", "--uavs", "7",
       "--duration", "12.5", "--check", "--network", "--status-fd", "7", "--uav", "jurong"},
      [](const ProgramOptions& options, StopSignal&) {
        EXPECT_EQ(options.scenario, "mbs");
        EXPECT_EQ(options.assets, "/data");
        EXPECT_EQ(options.seed, 18446744073709551615ull);
        EXPECT_EQ(options.scene_seed, 4u);
        EXPECT_EQ(options.duration_s, 12.5);
        EXPECT_TRUE(options.check_only);
        EXPECT_EQ(options.network, "all");
        EXPECT_EQ(options.status_fd, 7);
        EXPECT_EQ(options.load_options().scene_seed, 4u);
        EXPECT_EQ(options.load_options().uavs, 7u);
        return 0;
      },
      [&](CLI::App& app) { app.add_option("--uav", uav); });
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(uav, "jurong");
}

TEST(Program, LogsToStderr) {
  const auto outcome = run({"--log-level", "info"}, [](const ProgramOptions&, StopSignal&) {
    spdlog::info("ready");
    spdlog::debug("not shown");
    return 0;
  });
  EXPECT_EQ(outcome.error, "[tester] info ready\n");
}

TEST(Program, WarningsAreRecognisedAmongTheLinesOfALog) {
  const auto outcome = run({"--log-level", "info"}, [](const ProgramOptions&, StopSignal&) {
    spdlog::info("ready");
    spdlog::warn("the first");
    spdlog::error("no warning but an error");
    spdlog::info("[x] warning about nothing");
    spdlog::warn("the second");
    return 0;
  });
  std::istringstream log(outcome.error);
  std::vector<std::string> warnings;
  for (std::string line; std::getline(log, line);) {
    if (log_lines::is_warning(line)) warnings.push_back(line);
  }
  EXPECT_EQ(warnings, (std::vector<std::string>{"[tester] warning the first", "[tester] warning the second"}));
}

TEST(Program, SignalsReachTheBody) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto outcome = run({}, [signal](const ProgramOptions&, StopSignal& stop) {
      std::mutex mutex;
      std::condition_variable changed;
      bool woken = false;
      EXPECT_FALSE(stop.requested());
      stop.on_stop([&] {
        const std::lock_guard lock(mutex);
        woken = true;
        changed.notify_one();
      });
      std::raise(signal);
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return woken; });
      lock.unlock();
      stop.on_stop({});
      return stop.requested() ? kExitInterrupted : kExitProcessFailed;
    });
    EXPECT_EQ(outcome.code, kExitInterrupted);
  }
}

TEST(StopSignal, CallsTheCallbackAtOnceIfTheStopCameBefore) {
  StopSignal stop;
  stop.stop();
  int calls = 0;
  stop.on_stop([&] { ++calls; });
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(stop.requested());
}

}  // namespace
}  // namespace skein
