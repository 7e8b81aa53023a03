// `skein compose` and `skein keys`, with the real programs beside them.
#include "cli/command_line.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>

#include <cstdlib>
#include <set>
#include <sstream>
#include <system_error>

#include "cli/compose_command.hpp"
#include "cli/keys_command.hpp"
#include "cli/merge_command.hpp"
#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/files/security_files.hpp"
#include "process/json_text.hpp"
#include "process/program.hpp"
#include "run/results_dir.hpp"
#include "tests/support/limited_files.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

class ComposeCommand : public testing::Test {
 protected:
  ComposeCommand() {
    ::setenv("SKEIN_BIN_DIR", build_path("bin").c_str(), 1);
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
  }
  ~ComposeCommand() override {
    for (const char* name : {"SKEIN_BIN_DIR", "SKEIN_CONFIG_DIR"}) ::unsetenv(name);
  }

  int keys(const Texts& arguments) {
    Texts all = {"keys"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return make_keys(parse_command_line(all).get<KeysOptions>(), {out_, err_, false});
  }
  static mode_t mode_of(const fs::path& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
  }
  static std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
  }

  const ScratchDir scratch_;
  std::ostringstream out_, err_;
};

/// Limit of the size of a file [bytes]. The docker-compose file and some key files are longer, the first key file is
/// not.
constexpr rlim_t kRoom = 2500;

TEST_F(ComposeCommand, TheCommandWritesTheFileThatSkeinShips) {
  const Texts words = {"compose", "towers", "--planner", "kios", "--file", "docker/compose.yaml"};
  auto options = parse_command_line(words).get<ComposeOptions>();
  options.file.reset();
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone);
  EXPECT_EQ(out_.str(), read_text(source_path("docker/compose.yaml")))
      << "mend it in the source tree with: ./skein " << fmt::format("{}", fmt::join(words, " "));
}

TEST_F(ComposeCommand, AFileIsWrittenOrTheReasonIsReported) {
  auto options = parse_command_line({"compose", "towers"}).get<ComposeOptions>();
  options.file = scratch_.path() / "compose.yaml";
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone);
  EXPECT_EQ(out_.str(), "");
  options.file.reset();
  compose_fleet(options, {out_, err_, false});
  EXPECT_EQ(read_text(scratch_.path() / "compose.yaml"), out_.str());
  options.file = scratch_.path() / "there is none" / "compose.yaml";
  EXPECT_THROW(compose_fleet(options, {out_, err_, false}), InputError);
  options.images = {"jurong"};
  EXPECT_THROW(compose_fleet(options, {out_, err_, false}), InputError);
}

TEST_F(ComposeCommand, OnlyAFileThatSkeinMadeIsReplacedWithoutForce) {
  auto options = parse_command_line({"compose", "towers"}).get<ComposeOptions>();
  const fs::path file = scratch_.path() / "compose.yaml";
  options.file = file;
  write_text(file, "services: {}\n");
  try {
    compose_fleet(options, {out_, err_, false});
    ADD_FAILURE() << "the file was replaced without --force";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--file " + file.string() + ": exists already"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos) << error.what();
  }
  EXPECT_EQ(read_text(file), "services: {}\n");
  options.run.force = true;
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone);
  const std::string first = read_text(file);
  options.run.force = false;
  write_text(file, "");
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone) << "an empty file is replaced without --force";
  EXPECT_EQ(read_text(file), first);
  write_text(file, first + "# and more\n");
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone) << "the command can be repeated";
  EXPECT_EQ(read_text(file), first);
}

TEST_F(ComposeCommand, AFullDiskLeavesTheFormerFile) {
  auto options = parse_command_line({"compose", "towers"}).get<ComposeOptions>();
  const fs::path file = scratch_.path() / "compose.yaml", link = scratch_.path() / "link.yaml";
  fs::create_symlink(file, link);
  for (const fs::path& name : {file, link}) {
    options.file = name;
    EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone);
    const std::string before = read_text(file);
    const LimitedFiles full(kRoom);
    try {
      compose_fleet(options, {out_, err_, false});
      ADD_FAILURE() << "the file was written in spite of the full disk";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "--file " + name.string() + ": cannot be written: File too large");
    }
    EXPECT_EQ(read_text(file), before);
  }
  EXPECT_TRUE(fs::is_symlink(link)) << "the command writes to the file to which the link leads";
  EXPECT_EQ(names_in(scratch_.path()), (std::set<std::string>{"compose.yaml", "link.yaml"}));
}

TEST_F(ComposeCommand, ALinkMayLeadToAFileThatIsNotThereYet) {
  auto options = parse_command_line({"compose", "towers"}).get<ComposeOptions>();
  const fs::path link = scratch_.path() / "link.yaml";
  fs::create_symlink("compose.yaml", link);
  options.file = link;
  EXPECT_EQ(compose_fleet(options, {out_, err_, false}), kExitDone);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(scratch_.path() / "compose.yaml")));
}

TEST_F(ComposeCommand, OnlyARegularFileIsWrittenTo) {
  auto options = parse_command_line({"compose", "towers"}).get<ComposeOptions>();
  const fs::path pipe = scratch_.path() / "pipe", circle = scratch_.path() / "circle";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(circle, circle);
  options.run.force = true;
  for (const fs::path& wrong : {pipe, scratch_.path(), fs::path("/dev/null"), circle}) {
    options.file = wrong;
    try {
      compose_fleet(options, {out_, err_, false});
      ADD_FAILURE() << wrong;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(wrong.string()), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(names_in(scratch_.path()), (std::set<std::string>{"circle", "pipe"}));
}

TEST_F(ComposeCommand, TheKeyOfThePageIsBesideTheFileAndOnlyItsOwnerReadsIt) {
  if (!fs::exists(source_path("build/web/live.js"))) GTEST_SKIP() << "web/ is not built: ./skein test does that";
  const auto file_of = [&](const Texts& more) {
    Texts all = {"compose", "towers"};
    all.insert(all.end(), more.begin(), more.end());
    return compose_fleet(parse_command_line(all).get<ComposeOptions>(), {out_, err_, false});
  };
  const fs::path file = scratch_.path() / "fleet.yaml", folder = scratch_.path() / "fleet.view";
  EXPECT_EQ(file_of({"--view", "--file", file}), kExitDone);
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"live.js", "view.html", "view.key"}));
  EXPECT_EQ(mode_of(folder), 0700u);
  const std::string key = read_text(folder / "view.key").substr(0, 64), yaml = read_text(file);
  for (const char* secret : {"view.key", "view.html"}) EXPECT_EQ(mode_of(folder / secret), 0600u) << secret;
  EXPECT_NE(read_text(folder / "view.html").find("value=\"" + key + "\""), std::string::npos);
  EXPECT_NE(read_text(folder / "view.html").find("http://127.0.0.1:8080/enter"), std::string::npos);
  EXPECT_EQ(yaml.find(key), std::string::npos) << "the key is neither on a command line nor in an environment";
  EXPECT_NE(yaml.find("127.0.0.1:8080:8080"), std::string::npos);
  EXPECT_NE(yaml.find("./fleet.view"), std::string::npos) << "wherever both are taken";
  EXPECT_NE(err_.str().find((folder / "view.html").string()), std::string::npos);
  EXPECT_EQ(file_of({"--view", "192.0.2.7:8123", "--file", file}), kExitDone);
  EXPECT_NE(read_text(folder / "view.key").substr(0, 64), key) << "each call draws a new key";
  EXPECT_NE(read_text(file).find("192.0.2.7:8123:8080"), std::string::npos);
  EXPECT_NE(read_text(file).find("--view-name=192.0.2.7"), std::string::npos);
  EXPECT_THROW(file_of({"--view"}), InputError) << "--view needs an address";
  EXPECT_THROW(file_of({"--view", "flier:8080", "--file", file}), InputError);
  EXPECT_THROW(file_of({"--view", "--speed", "2", "--clock", "realtime", "--file", file}), InputError);
  EXPECT_THROW(file_of({"--view", "--pause-at", "2", "--clock", "realtime", "--file", file}), InputError);
}

TEST_F(ComposeCommand, EachProgramGetsAFolderOfKeysThatOnlyItsOwnerReads) {
  for (const char* vendor : {"cyclonedds", "fastdds"}) {
    const fs::path folder = scratch_.path() / vendor;
    EXPECT_EQ(keys({"towers", "--planner", "xxh", "--dds", vendor, "--out", folder}), kExitDone);
    std::set<std::string> programs = {"sim_server", "comm_router", "station", "uav_agent-gcs"};
    for (const char* uav : {"jurong", "raffles", "sentosa", "changi", "nanyang"}) {
      programs.insert(std::string("uav_agent-") + uav);
    }
    EXPECT_EQ(names_in(folder), programs);
    std::set<std::string> private_keys;
    for (const std::string& program : programs) {
      EXPECT_EQ(mode_of(folder / program), 0700u);
      EXPECT_EQ(names_in(folder / program),
                std::set<std::string>(security_files::kAll.begin(), security_files::kAll.end()));
      for (const char* file : security_files::kAll) EXPECT_EQ(mode_of(folder / program / file), 0600u) << file;
      private_keys.insert(read_text(folder / program / security_files::kKey));
    }
    EXPECT_EQ(private_keys.size(), programs.size());
  }
}

TEST_F(ComposeCommand, KeysAreNeverOverwritten) {
  const fs::path folder = scratch_.path() / "keys", key = folder / "station" / security_files::kKey;
  EXPECT_EQ(keys({"towers", "--out", folder}), kExitDone);
  const std::string before = read_text(key);
  EXPECT_THROW(keys({"towers", "--out", folder}), InputError);
  EXPECT_EQ(read_text(key), before);
  EXPECT_FALSE(before.empty());
  write_text(scratch_.path() / "file", "");
  EXPECT_THROW(keys({"towers", "--out", scratch_.path() / "file" / "keys"}), InputError);
  EXPECT_THROW(parse_command_line({"keys", "towers"}), InputError) << "--out is missing";
}

TEST_F(ComposeCommand, AFullDiskLeavesNoPartOfTheKeys) {
  const fs::path folder = scratch_.path() / "keys";
  {
    const LimitedFiles full(kRoom);
    try {
      keys({"towers", "--out", folder});
      ADD_FAILURE() << "the keys were written in spite of the full disk";
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find(folder.string()), std::string::npos) << error.what();
    }
  }
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_EQ(keys({"towers", "--out", folder}), kExitDone) << "the command can be repeated";
}

TEST_F(ComposeCommand, ADebuggedProgramWaitsAndNoProgramIsTakenForDead) {
  const auto file_of = [&](const Texts& more) {
    Texts all = {"compose", "towers", "--planner", "kios"};
    all.insert(all.end(), more.begin(), more.end());
    out_.str("");
    compose_fleet(parse_command_line(all).get<ComposeOptions>(), {out_, err_, false});
    return out_.str();
  };
  const auto count = [](const std::string& text, const std::string& part) {
    int times = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++times;
    return times;
  };
  const std::string usual = file_of({}), debugged = file_of({"--debug", "jurong", "--debug", "station=wait"});
  EXPECT_EQ(count(usual, "--wait-for-debugger"), 0);
  EXPECT_EQ(count(debugged, "--wait-for-debugger"), 2);
  EXPECT_EQ(count(debugged, "--lease=3600"), count(usual, "--lease=10"));
  EXPECT_EQ(count(debugged, "--agent-timeout=0"), 1);
  for (const char* wrong : {"jurong=gdb", "jurong=strace", "nobody", "jurong="}) {
    EXPECT_THROW(file_of({"--debug", wrong}), InputError) << wrong;
  }
}

/// A script replaces Docker's client. Its engine is available until a certain file exists.
class ComposeUp : public testing::Test {
 protected:
  ComposeUp() {
    ::setenv("PATH", (programs_.dir().string() + ":" + path_).c_str(), 1);
    write_script(programs_.dir() / "docker", "gone=" + gone().string() + " folder=" + programs_.dir().string() + R"(
case "$*" in
  "image inspect"*) if [ -e "$folder/first" ]; then . "$folder/first"; fi ;;
  "compose version"|version*) ;;
  *" down "*) if [ -e "$gone" ]; then echo "no engine"; exit 1; fi ;;
  compose*) ;;
  "ps --all"*) for name in sim_server comm_router station uav_agent-alpha uav_agent-beta; do echo "$name id-$name"; done ;;
  "logs --follow id-sim_server") . "$folder/server" ;;
  "logs --follow"*) until [ -e "$gone" ] || [ -e "$folder/over" ]; do sleep 0.01; done ;;
  inspect*alpha) if [ -e "$folder/again" ]; then echo 2026-02-03T04:05:06.7Z; else echo 2026-01-01T00:00:00Z; fi ;;
  inspect*) echo 2026-01-01T00:00:00Z ;;
  "logs --since 2026-02-03T04:05:06.7Z id-uav_agent-alpha") echo "for the launcher"; echo "its second life" >&2 ;;
  "wait id-sim_server") if [ -e "$gone" ]; then echo "no engine" >&2; exit 1; fi; echo 12 ;;
  wait*) if [ -e "$gone" ]; then echo "no engine" >&2; exit 1; fi; echo 0 ;;
esac
)");
  }
  ~ComposeUp() override { ::setenv("PATH", path_.c_str(), 1); }

  fs::path gone() const { return programs_.dir() / "gone"; }
  int up() { return up_with({"--out", programs_.dir() / "out"}); }
  int up_with(const Texts& more) {
    Texts words = {"compose", programs_.scenario(), "--planner", "hover", "--up"};
    words.insert(words.end(), more.begin(), more.end());
    return compose_fleet(parse_command_line(words).get<ComposeOptions>(), {out_, err_, false});
  }

  const FakePrograms programs_;
  const std::string path_ = ::getenv("PATH");
  std::ostringstream out_, err_;
};

TEST_F(ComposeUp, AFolderWithFilesThatItWouldOverwriteIsRefused) {
  for (const char* name : {"compose.yaml", "compose.log", "agents"}) {
    fs::create_directories(programs_.dir() / "out");
    write_text(programs_.dir() / "out" / name, "mine");
    EXPECT_THROW(up(), InputError) << name;
    EXPECT_EQ(read_text(programs_.dir() / "out" / name), "mine");
    fs::remove_all(programs_.dir() / "out");
  }
}

TEST_F(ComposeUp, ALauncherThatMayOpenTooFewFilesIsRefusedBeforeTheEngineIsAsked) {
  write_script(programs_.dir() / "docker", "touch " + gone().string());
  const std::string said = done_with_open_files(24, [&] {
    up();
    return std::string("accepted");
  });
  EXPECT_NE(said.find("a process may have 24 open files"), std::string::npos) << said;
  EXPECT_FALSE(fs::exists(gone()));
}

// The first command takes the folder after the second one has made its checks, but before the second one flies.
TEST_F(ComposeUp, TwoCommandsAtOnceWithoutOutGetDifferentFolders) {
  const fs::path before = fs::current_path(), usual = default_results_dir("small", "hover", 0);
  const std::string first = programs_.dir() / usual;
  write_text(programs_.dir() / "first", "mkdir -p " + first + "; echo first >" + first + "/result.json\n");
  write_text(programs_.dir() / "server", "touch " + (programs_.dir() / "over").string() + "\n");
  fs::current_path(programs_.dir());
  const int code = up_with({});
  fs::current_path(before);
  EXPECT_EQ(code, kExitProcessFailed) << err_.str();
  EXPECT_EQ(read_text(first + "/result.json"), "first\n");
  EXPECT_NE(err_.str().find("results in " + usual.string() + "-2"), std::string::npos) << err_.str();
  EXPECT_TRUE(fs::exists(first + "-2/result.json"));
}

TEST_F(ComposeUp, AnEngineThatGoesAwayIsReportedOnceWithWhatMayBeLeft) {
  write_text(programs_.dir() / "server", "touch " + gone().string() + "\n");
  EXPECT_EQ(up(), kExitProcessFailed) << err_.str();
  const std::string err = err_.str(), what = "the Docker engine does not answer any more";
  const std::size_t said = err.find(what);
  ASSERT_NE(said, std::string::npos) << err;
  EXPECT_EQ(err.find(what, said + 1), std::string::npos) << err;
  EXPECT_NE(err.find("docker compose --project-name skein-"), std::string::npos) << err;
  EXPECT_NE(err.find("compose.yaml down --volumes"), std::string::npos) << err;
  EXPECT_EQ(read_json(programs_.dir() / "out" / "result.json")["status"], "aborted");
}

TEST_F(ComposeUp, TheLogOfARestartedContainerHasItsLaterOutput) {
  const std::string folder = programs_.dir().string();
  write_text(programs_.dir() / "server", "touch " + folder + "/again " + folder + "/over\n");
  EXPECT_EQ(up(), kExitProcessFailed) << err_.str();
  const auto log_of = [&](const std::string& name) { return read_text(programs_.dir() / "out" / (name + ".log")); };
  EXPECT_TRUE(log_of("uav_agent-alpha")
                  .ends_with("[skein] the container was started again at 2026-02-03T04:05:06.7Z; what it wrote since "
                             "then:\nits second life\n"))
      << log_of("uav_agent-alpha");
  EXPECT_EQ(log_of("uav_agent-beta").find("started again"), std::string::npos) << log_of("uav_agent-beta");
}

// A container may end with any exit code, so its exit code says nothing about the engine.
TEST_F(ComposeUp, AFailedContainerIsNotReportedAsALostEngine) {
  write_text(programs_.dir() / "server", "touch " + (programs_.dir() / "over").string() + "\n");
  EXPECT_EQ(up(), kExitProcessFailed) << err_.str();
  EXPECT_NE(err_.str().find("exit code 12"), std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find("does not answer"), std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find("down --volumes"), std::string::npos) << err_.str();
}

TEST(Options, FleetsInContainersHaveTheFlightOptionsOfRun) {
  const auto compose = parse_command_line({"compose", "cranes", "--planner", "kios", "--image", "jurong=mine",
                                           "--image", "changi=mine", "--subnet", "10.1.0.0/20", "--file", "f"})
                           .get<ComposeOptions>();
  EXPECT_EQ(compose.run.scenario, "cranes");
  EXPECT_EQ(compose.images, (std::vector<std::string>{"jurong=mine", "changi=mine"}));
  EXPECT_EQ(
      compose.run.command,
      "skein compose cranes --planner kios --image jurong=mine --image changi=mine --subnet 10.1.0.0/20 --file f");
  EXPECT_FALSE(compose.up);
  EXPECT_THROW(parse_command_line({"compose", "--up", "--file", "f"}), InputError);
  const auto keys = parse_command_line({"keys", "cranes", "--domain", "7", "--out", "o"}).get<KeysOptions>();
  EXPECT_EQ(keys.run.domain, 7);
  EXPECT_EQ(keys.out, "o");
  const auto merge =
      parse_command_line({"merge", "there", "--scenario", "s.yaml", "--assets", "data"}).get<MergeOptions>();
  EXPECT_EQ(merge.dir, "there");
  EXPECT_EQ(merge.scenario, "s.yaml");
  EXPECT_EQ(merge.assets, "data");
  EXPECT_THROW(parse_command_line({"merge"}), InputError) << "the results folder is missing";
}

}  // namespace
}  // namespace skein::cli
