// `skein run --secure`: the flight is the same, and no other program receives its messages.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "cli/secure/keys.hpp"
#include "cli/secure/rules.hpp"
#include "cli/secure/security.hpp"
#include "core/topics.hpp"
#include "fleet_fixture.hpp"
#include "host/proc_table.hpp"
#include "process/files/closed_to_agents.hpp"
#include "process/files/security_files.hpp"
#include "results/run_folder.hpp"
#include "small_scene.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const std::string kVictim = "changi", kOther = "jurong";  // the small scene's fleet, in reverse order
constexpr int kVictimsDomain = 3, kOthersDomain = 2;      // from the first one on

bool is_root() { return ::geteuid() == 0; }

class Secure : public FleetTest {
 protected:
  Secure() {
    fs::permissions(folder(), fs::perms(0755));  // agents read the scenario as users of their own
    scenario_ = write_small_scene(folder() / "small");
  }

  Arguments arguments(const std::string& vendor, const Arguments& more = {},
                      const std::string& planner = "patrol") const {
    Arguments all = {scenario_, "--planner", planner, "--duration", "30", "--dds", vendor};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::string scenario_;
};

/// A secured fleet that waits for the agent of kVictim, so that other programs have time to try to join.
class SecureWaiting : public Secure, public testing::WithParamInterface<std::string> {
 protected:
  void start_fleet(const std::string& planner = "patrol", const std::string& clock = "lockstep") {
    run_ = &start("secure", arguments(GetParam(), {"--secure", "--debug", kVictim, "--clock", clock}, planner));
    ASSERT_TRUE(run_->wait_for("gdb --args")) << run_->err();
    command_ = run_->debug_command();
    std::istringstream words(command_);
    for (std::string word; words >> word;) {
      if (word == "--security") words >> keys_;
    }
    ASSERT_TRUE(fs::is_directory(keys_)) << command_;
  }

  /// Starts a program that reads the victim's topic in the victim's domain. @param keys  its keys; empty: it has none.
  ChildProcess& listen(const std::string& name, const std::string& vendor, const fs::path& keys) {
    return listen(name, vendor, keys, kVictimsDomain, topic_);
  }
  ChildProcess& listen(const std::string& name, const std::string& vendor, const fs::path& keys, int offset,
                       const topics::WireTopic& topic) {
    Arguments argv = {helper_program("radio_listener"), vendor, domain(offset), heard(name), topic.name, topic.type};
    return start_program(name, argv, keys.empty() ? Environment{} : Environment{{"SKEIN_SECURITY", keys}});
  }

  std::string domain(int offset) const { return std::to_string(run_->domains().first + offset); }
  fs::path heard(const std::string& name) const { return folder() / (name + ".heard"); }
  /// Numbers of writers that such a program has matched and of samples that it has received; -1: it never began to
  /// read.
  std::pair<long, long> ears(const std::string& name) const {
    std::istringstream text(text_of(heard(name)));
    std::string topic;
    std::pair<long, long> numbers{-1, -1};
    text >> topic >> numbers.first >> numbers.second;
    return numbers;
  }

  /// Keys for the victim's domain that another authority has signed.
  fs::path forged_keys() const {
    const fs::path dir = folder() / "forged";
    fs::create_directories(dir);
    const cli::Authority identities("identities"), documents("permissions");
    const cli::Identity identity = identities.issue("uav_agent-" + kVictim);
    const int number = run_->domains().first + kVictimsDomain;
    const auto write = [&](const char* name, const std::string& text) { std::ofstream(dir / name) << text; };
    write(security_files::kIdentityCa, identities.certificate());
    write(security_files::kCertificate, identity.certificate);
    write(security_files::kKey, identity.key);
    write(security_files::kPermissionsCa, documents.certificate());
    write(security_files::kGovernance, documents.sign(cli::governance(number, number)));
    write(security_files::kPermissions, documents.sign(cli::permissions(identity.subject, {number, number, {}})));
    return dir;
  }

  /// The log of sim_server, which is in all domains.
  std::string log() const { return text_of(run_->dir() / "sim_server.log"); }

  const topics::WireTopic topic_ = topics::odometry(kVictim);
  SkeinRun* run_ = nullptr;
  std::string command_;
  fs::path keys_;  ///< folder of the victim's keys
};

TEST_P(SecureWaiting, FliesAsAnOpenFleetAndOtherProgramsGetNothing) {
  const std::string vendor = GetParam(), other_vendor = vendor == "fastdds" ? "cyclonedds" : "fastdds";
  SkeinRun& open = run("open", arguments(vendor));
  start_fleet();
  const fs::path others_keys = keys_.parent_path() / ("uav_agent-" + kOther);
  listen("friend", vendor, keys_);
  listen("nobody", vendor, {});
  listen("foreigner", other_vendor, {});
  listen("forger", vendor, forged_keys());
  listen("neighbour", vendor, others_keys);
  start_program("impostor", {helper_program("impostor"), vendor, domain(kOthersDomain), domain(kVictimsDomain),
                             heard("impostor"), others_keys, topic_.name, topic_.type});
  // Once the listener with the victim's own certificate has matched, the others have had enough time, too.
  EXPECT_TRUE(eventually([&] { return ears("friend").first == 1; }));
  const std::string refusal = vendor == "fastdds" ? "Not found a rule allowing to use the domain" : "denied by default";
  const std::string forgery = "certificate signature failure";
  for (const std::string& text : {std::string("has no certificate"), refusal, forgery}) {
    EXPECT_TRUE(eventually([&] { return log().find(text) != std::string::npos; }, std::chrono::seconds(20)))
        << text << " is not in the log:\n"
        << log();
  }
  start_program("agent", {"/bin/sh", "-c", command_});
  EXPECT_EQ(run_->exit_code(), 0) << run_->err();

  EXPECT_GT(ears("friend").second, 100);
  for (const char* name : {"nobody", "foreigner", "forger", "neighbour", "impostor"}) {
    EXPECT_LE(ears(name).first, 0) << name;
    EXPECT_LE(ears(name).second, 0) << name;
  }
  const Json open_result = open.result(), result = run_->result();
  EXPECT_EQ(run_->digest(), open.digest());
  EXPECT_EQ(result["score"], open_result["score"]);
  EXPECT_GT(result["score"].get<double>(), 0.0);
  EXPECT_TRUE(result["deterministic"]);
  expect_complete_result(*run_);
  EXPECT_TRUE(fs::exists(run_->dir() / run_folder::map_file(kOther)))
      << "the agent writes in a folder of its own, from which the launcher must fetch the map";

  EXPECT_FALSE(fs::exists(keys_.parent_path()));
  for (const auto& entry : fs::directory_iterator(run_->dir())) {
    EXPECT_EQ(text_of(entry.path()).find("PRIVATE KEY"), std::string::npos) << entry.path();
  }
}

TEST_P(SecureWaiting, TheStationsProgramReadsTheScoreButNoIndices) {
  start_fleet("patrol,gcs=listen", "realtime:10");  // slow enough that writers match readers in time
  const fs::path keys = keys_.parent_path() / "uav_agent-gcs", station = keys_.parent_path() / "station";
  constexpr int kGcsDomain = 1;
  listen("score", GetParam(), keys, kGcsDomain, topics::score());
  listen("indices", GetParam(), keys, kGcsDomain, topics::score_eval());
  listen("judge", GetParam(), station, kGcsDomain, topics::score_eval());
  EXPECT_TRUE(eventually([&] { return ears("score").first == 1 && ears("judge").first == 1; }));
  start_program("agent", {"/bin/sh", "-c", command_});
  EXPECT_EQ(run_->exit_code(), 0) << run_->err();
  EXPECT_GT(ears("score").second, 0);
  EXPECT_GT(ears("judge").second, 0)
      << "the station's own keys must allow to read what the strategy's program must not";
  EXPECT_LE(ears("indices").first, 0);
  EXPECT_LE(ears("indices").second, 0);
}

INSTANTIATE_TEST_SUITE_P(Vendors, SecureWaiting, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& vendor) { return vendor.param; });

TEST_F(Secure, AgentsCannotReadFilesOfOtherProgramsOrGroundTruth) {
  if (!is_root()) GTEST_SKIP() << "agents have users of their own only when the launcher is root";
  fs::permissions(folder() / "small/scene/points.pcd", fs::perms(0600));
  // Files and processes that an agent must not reach, the launcher included; each output line names one that it
  // reached.
  const fs::path script = write("look.sh",
                                "mine=${SKEIN_SECURITY%/*}\n"
                                "for file in $mine/station/key.pem $mine/uav_agent-" +
                                    kVictim + "/key.pem " + (folder() / "small/scene/points.pcd").string() + " " +
                                    (folder() / "probed/scene.json").string() +
                                    " /proc/$PPID/environ; do\n"
                                    "  cat $file > /dev/null 2>&1 && echo can read $file\n"
                                    "done > $SKEIN_OUT/looked\n"
                                    "cat $SKEIN_SECURITY/key.pem > /dev/null && id -u >> $SKEIN_OUT/looked\n"
                                    "kill -0 $PPID 2> /dev/null && echo can kill >> $SKEIN_OUT/looked\n"
                                    "exec " +
                                    helper_program("minimal_client") + "\n");
  SkeinRun& probed = run("probed", {scenario_, "--secure", "--duration", "10", "--planner",
                                    "hover," + kOther + "=exec:exec /bin/sh " + script.string()});
  const std::string looked = text_of(probed.dir() / ("uav_agent-" + kOther + ".looked"));
  const int uid = std::atoi(looked.c_str());
  EXPECT_EQ(looked, std::to_string(uid) + "\n") << "the agent could read more than its own key";
  EXPECT_GE(uid, static_cast<int>(cli::kFirstAgentUser));
  EXPECT_LE(uid, static_cast<int>(cli::kLastAgentUser));
  EXPECT_TRUE(probed.result()["deterministic"]);
  for (const Json& warning : probed.result()["warnings"]) {
    EXPECT_EQ(warning.get<std::string>().find("points.pcd"), std::string::npos) << warning;
  }
  EXPECT_EQ(fs::status(probed.dir()).permissions(), fs::perms(0705))
      << "the folder must be open again after the run, except to agents";
}

TEST_F(Secure, AgentsCannotReadGroundTruthOfEarlierRuns) {
  if (!is_root()) GTEST_SKIP() << "agents have users of their own only when the launcher is root";
  // Places with ground truth of earlier runs: the folder of an unsecured run ("earlier"); the folder of a run that an
  // ordinary user or an older version has left readable ("older"); and a cache that agents can enter, with a world that
  // was left readable, its estimate, and the world that this test's last flight generates.
  const fs::path cache = folder() / "open_cache", worlds = cache / "skein/worlds";
  const Environment open_cache = {{"XDG_CACHE_HOME", cache}};
  run("earlier", {scenario_, "--duration", "5", "--planner", "hover"});
  run("older", {"wild", "--scene-seed", "4", "--duration", "5", "--planner", "hover"}, open_cache);
  run("points", {"towers", "--duration", "5", "--planner", "hover", "--no-oracle"}, open_cache);
  const auto open_up = [](const fs::path& path) {
    ASSERT_EQ(::chown(path.c_str(), 1000, 1000), 0);
    fs::permissions(path, fs::perms(fs::is_directory(path) ? 0755 : 0644));
  };
  std::vector<fs::path> secret = {folder() / "earlier/scene.json", folder() / "older/scene.json"};
  open_up(folder() / "older");
  for (const auto& entry : fs::recursive_directory_iterator(cache)) {
    if (entry.path().filename() == run_folder::kSceneFiles) {
      for (const auto& file : fs::recursive_directory_iterator(entry)) {
        if (file.is_regular_file()) secret.push_back(file.path());
      }
      open_up(entry.path());
    }
    if (entry.path().parent_path() == cache / "skein" && entry.is_regular_file()) {
      secret.push_back(entry.path());
      open_up(entry.path());
    }
  }
  ASSERT_GE(secret.size(), 6u)
      << "files of a mesh, points and an estimate, and the points of a procedural scene, are missing";
  for (const char* kind : {"oracle-", "points-"}) {
    EXPECT_TRUE(std::ranges::any_of(secret, [&](const fs::path& file) {
      return file.filename().string().starts_with(kind);
    })) << kind;
  }
  std::string files;
  for (const fs::path& file : secret) files += " " + file.string();
  const fs::path script = write("look.sh", "for file in" + files + " $(find " + worlds.string() +
                                               " -name '*.pcd' -o -name '*.stl'); do\n"
                                               "  cat $file > /dev/null 2>&1 && echo can read $file\n"
                                               "done > $SKEIN_OUT/looked\n"
                                               "cat " +
                                               worlds.string() +
                                               "/*/*/*.yaml > /dev/null && id -G >> $SKEIN_OUT/looked\n"
                                               "exec " +
                                               helper_program("minimal_client") + "\n");
  const auto looked = [&](const std::string& name, const std::string& scene_seed) {
    const std::string spy = Json::parse(text_of(folder() / "older/result.json"))["uavs"][0]["name"];
    SkeinRun& flown = run(name,
                          {"wild", "--scene-seed", scene_seed, "--secure", "--duration", "5", "--planner",
                           "hover," + spy + "=exec:exec /bin/sh " + script.string()},
                          open_cache);
    return text_of(flown.dir() / ("uav_agent-" + spy + ".looked"));
  };
  for (const char* scene_seed : {"4", "5"}) {
    const std::string said = looked("spy-" + std::string(scene_seed), scene_seed);
    EXPECT_EQ(said.find("can read"), std::string::npos) << said;
    EXPECT_NE(said.find(std::to_string(kAgentsGroup)), std::string::npos)
        << "the agent could read more than the scenarios: " << said;
  }
  // All other users can still read these files.
  const auto reader = [&](const fs::path& file) {
    ChildProcess& cat =
        start_program("cat" + std::to_string(std::hash<std::string>{}(file)),
                      {"/usr/bin/setpriv", "--reuid", "12345", "--regid", "12345", "--clear-groups", "/bin/cat", file});
    return cat.wait().code;
  };
  for (const fs::path& file : secret) EXPECT_EQ(reader(file), 0) << file;
}

TEST_F(Secure, NoProcessIsLeftUnderTheUserIdsOfARun) {
  if (!is_root()) GTEST_SKIP() << "agents have users of their own only when the launcher is root";
  const fs::path script = write("stay.sh",
                                "setsid sleep 1000 &\n"
                                "id -u > $SKEIN_OUT/uid\n"
                                "exec " +
                                    helper_program("minimal_client") + "\n");
  const auto fly = [&](const std::string& name) {
    SkeinRun& done = run(name, {scenario_, "--secure", "--duration", "5", "--planner",
                                "hover," + kOther + "=exec:exec /bin/sh " + script.string()});
    return static_cast<uid_t>(std::atoi(text_of(done.dir() / ("uav_agent-" + kOther + ".uid")).c_str()));
  };
  const auto has_processes = [](uid_t user) {
    const std::vector<pid_t> all = cli::all_processes();
    return std::any_of(all.begin(), all.end(), [&](pid_t pid) { return cli::belongs_to(pid, user); });
  };
  const uid_t first = fly("first");
  ASSERT_GE(first, cli::kFirstAgentUser);
  EXPECT_FALSE(has_processes(first));
  // If a process with this user id exists nevertheless, the next run takes another id.
  const std::string id = std::to_string(first);
  start_program("survivor", {"/usr/bin/setpriv", "--reuid", id, "--regid", id, "--clear-groups", "/bin/sleep", "1000"});
  ASSERT_TRUE(eventually([&] { return has_processes(first); }));
  EXPECT_NE(fly("second"), first);
}

TEST_F(Secure, ForgedReportsAreRefusedAndCounted) {
  SkeinRun& forged = run("forged", {scenario_, "--secure", "--duration", "10", "--planner",
                                    "hover," + kOther + "=exec:exec " + helper_program("minimal_client") + " forge"});
  const Json station = Json::parse(text_of(forged.dir() / "station.report.json"));
  EXPECT_GT(station["reports_received"], 100);
  EXPECT_GT(station["refused"]["unknown"], 100);
  EXPECT_EQ(station["points_detected"], 0);
  EXPECT_EQ(forged.result()["score"], 0.0);
}

TEST_F(Secure, FilesThatStayReadableAreReported) {
  SkeinRun& told = run("told", {scenario_, "--secure", "--duration", "5", "--planner", "hover"});
  const std::string expected = is_root() ? "small/scene/points.pcd" : "without root";
  const Json warnings = told.result()["warnings"];
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [&](const Json& warning) {
    return warning.get<std::string>().find(expected) != std::string::npos;
  })) << warnings;
}

TEST_F(Secure, BadRequestsAreRefusedBeforeAnythingStarts) {
  SkeinRun& mixed = run("mixed", arguments("mixed", {"--secure"}), {}, 2);
  EXPECT_NE(mixed.err().find("--secure --dds mixed"), std::string::npos) << mixed.err();
  if (!is_root()) return;
  for (const char* name : {"tmp", "no_keys"}) fs::create_directory(folder() / name);
  fs::permissions(folder() / "tmp", fs::perms(0700));
  fs::permissions(folder() / "no_keys", fs::perms(0755));
  SkeinRun& no_keys =
      run("no_keys", arguments("cyclonedds", {"--secure"}), {{"TMPDIR", (folder() / "tmp").string()}}, 2);
  EXPECT_NE(no_keys.err().find("cannot read " + (folder() / "tmp").string()), std::string::npos) << no_keys.err();
  EXPECT_EQ(fs::status(no_keys.dir()).permissions(), fs::perms(0755)) << "the mode that it had before";
  fs::permissions(folder() / "small", fs::perms(0700));
  SkeinRun& closed = run("closed", arguments("cyclonedds", {"--secure"}), {}, 2);
  EXPECT_NE(closed.err().find("chmod o+rX " + (folder() / "small").string()), std::string::npos) << closed.err();
}

}  // namespace
}  // namespace skein::test
