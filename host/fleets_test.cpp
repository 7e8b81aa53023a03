// Other fleets may fly on this host meanwhile, so each test looks only for the fleets of its own folders.
#include "host/fleets.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "host/proc_table.hpp"
#include "host/testing/ends.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/host/host_lock.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

using Strings = std::vector<std::string>;

/// A process with the command line and the environment of another program. It has just started /bin/sh under this name,
/// and is stopped. This process is its debugger.
class Sham {
 public:
  enum class Network { here, elsewhere };

  explicit Sham(Strings words, Strings environment = {}, Network network = Network::here) {
    const pid_t tester = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const bool is_there =
          network == Network::here || ::unshare(CLONE_NEWNET) == 0 || ::unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0;
      if (::getppid() == tester && is_there && ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0) {
        ::execve("/bin/sh", pointers_to(words).data(), pointers_to(environment).data());
      }
      ::_exit(1);
    }
    int status = 0;
    stands_ = ::waitpid(pid_, &status, 0) == pid_ && WIFSTOPPED(status);  // the kernel stops it at the end of execve()
    if (!stands_) pid_ = -1;
  }
  ~Sham() {
    if (pid_ < 0) return;
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Sham(const Sham&) = delete;
  Sham& operator=(const Sham&) = delete;

  /// Whether the process was started and is stopped. False if the system allows no debugger or no network namespaces.
  bool stands() const { return stands_; }
  pid_t pid() const { return pid_; }
  /// Detaches the debugger and lets the process run. @param signal  sent to the process; 0: none
  void release(int signal = 0) const {
    EXPECT_EQ(::ptrace(PTRACE_DETACH, pid_, nullptr, static_cast<long>(signal)), 0);
  }

 private:
  static std::vector<char*> pointers_to(Strings& strings) {
    std::vector<char*> pointers;
    for (std::string& text : strings) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
  }

  pid_t pid_ = -1;
  bool stands_ = false;
};

class FleetsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!Sham({"sh"}).stands()) GTEST_SKIP() << "this system does not allow processes to be traced";
  }
  std::string dir() const { return scratch_.path(); }
  /// The command line of a program of this fleet.
  Strings words(const std::string& program, const Strings& more = {}) const { return words_in(dir(), program, more); }
  static Strings words_in(const std::string& dir, const std::string& program, const Strings& more = {}) {
    Strings all = {"/opt/skein/bin/" + program, "--scenario", "towers.yaml", "--out", dir};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// A domain that no real fleet and no other test uses.
  static int own_domain() { return 1'000'000 + ::getpid(); }
  std::optional<RunningFleet> found(uid_t user = ::geteuid()) const {
    for (const RunningFleet& fleet : running_fleets(user)) {
      if (fleet.dir == dir()) return fleet;
    }
    return std::nullopt;
  }

  ScratchDir scratch_;
};

TEST_F(FleetsTest, TheCommandLineOfTheSimServerDescribesTheFleet) {
  const Strings others = {"--domain", "7",  "--agent-timeout", "8",  "--lease",    "9",
                          "--uavs",   "10", "--network",       "x0", "--security", "/keys/other"};
  const Sham before(words("comm_router", others));
  const Sham server({"/opt/skein/bin/sim_server", "--scenario", "/my/towers.yaml", "--out", dir(), "--domain", "31",
                     "--agent-timeout", "4.5", "--lease", "2.5", "--uavs", "3", "--network", "eth7", "--security",
                     "/keys/server"});
  const Sham after(words("station", others));
  const auto fleet = found();
  ASSERT_TRUE(fleet);
  EXPECT_EQ(fleet->scenario, "/my/towers.yaml");
  EXPECT_EQ(fleet->base_domain, 31);
  EXPECT_EQ(fleet->agent_timeout_s, 4.5);
  EXPECT_EQ(fleet->lease_s, 2.5);
  EXPECT_EQ(fleet->uavs, 3u);
  EXPECT_EQ(fleet->network, "eth7");
  EXPECT_FALSE(fleet->elsewhere);
  EXPECT_EQ(fleet->keys,
            (std::map<std::string, std::string>{
                {"comm_router", "/keys/other"}, {"sim_server", "/keys/server"}, {"station", "/keys/other"}}));
}

TEST_F(FleetsTest, OptionsThatAreNotGivenHaveTheirDefaults) {
  const Sham server(words("sim_server"));
  const auto fleet = found();
  ASSERT_TRUE(fleet);
  const RunningFleet defaults;
  EXPECT_EQ(fleet->base_domain, defaults.base_domain);
  EXPECT_EQ(fleet->agent_timeout_s, defaults.agent_timeout_s);
  EXPECT_EQ(fleet->lease_s, defaults.lease_s);
  EXPECT_EQ(fleet->uavs, std::nullopt);
  EXPECT_EQ(fleet->network, "");
  EXPECT_TRUE(fleet->keys.empty());
}

TEST_F(FleetsTest, NumbersThatNoFleetCanHaveAreLeftOut) {
  const Sham server(words("sim_server", {"--domain", "1e300", "--uavs", "-1"}));
  const auto fleet = found();
  ASSERT_TRUE(fleet);
  EXPECT_EQ(fleet->base_domain, RunningFleet().base_domain);
  EXPECT_EQ(fleet->uavs, std::nullopt);
}

TEST_F(FleetsTest, TheLauncherIsTheHolderOfTheDomain) {
  const Sham server(words("sim_server", {"--domain", std::to_string(own_domain())}));
  EXPECT_EQ(found().value().launcher, std::nullopt);
  const auto lock = HostLock::try_take(domain_lock_name(own_domain()));
  ASSERT_TRUE(lock);
  EXPECT_EQ(found().value().launcher, ::getpid());
}

TEST_F(FleetsTest, TheSameDomainInAnotherNetworkNamespaceIsAnotherDomain) {
  const auto lock = HostLock::try_take(domain_lock_name(own_domain()));
  ASSERT_TRUE(lock);
  const Sham server(words("sim_server", {"--domain", std::to_string(own_domain())}), {}, Sham::Network::elsewhere);
  if (!server.stands()) GTEST_SKIP() << "this system does not allow another network namespace";
  EXPECT_TRUE(found().value().elsewhere);
  EXPECT_EQ(found().value().launcher, std::nullopt)
      << "this process holds only the domain of its own network namespace";
  EXPECT_EQ(chosen_fleet(dir(), "attach", "--out").dir, dir()) << "a user who names the folder can choose the fleet";

  const ScratchDir here;
  const Sham near(words_in(here.path(), "sim_server"));
  try {
    EXPECT_FALSE(chosen_fleet(std::nullopt, "attach", "--out").elsewhere);
  } catch (const InputError& error) {  // other fleets fly on this host
    EXPECT_EQ(std::string(error.what()).find(shown_folder(dir())), std::string::npos) << error.what();
  }
}

TEST_F(FleetsTest, ProgramsAreRecognisedByTheirCommandLines) {
  const Sham server(words("sim_server")), router(words("comm_router")), station(words("station")),
      agent(words("my_agent", {"--uav", "jurong"})), ground(words("my_agent", {"--role", "gcs"}));
  const Sham stranger(words("my_editor")), checks(Strings{"station", "--check", "--scenario", "x", "--out", dir()}),
      nowhere(Strings{"station", "--scenario", "x"}), cut(Strings{"station", "--scenario", "x", "--out"}),
      bare(Strings{"station"});
  const auto fleet = found();
  ASSERT_TRUE(fleet);
  EXPECT_EQ(fleet->programs, (std::map<std::string, pid_t>{{"sim_server", server.pid()},
                                                           {"comm_router", router.pid()},
                                                           {"station", station.pid()},
                                                           {"uav_agent-jurong", agent.pid()},
                                                           {"uav_agent-gcs", ground.pid()}}));
  EXPECT_FALSE(found(::geteuid() + 1)) << "another user must not find this fleet";
}

TEST_F(FleetsTest, WithoutASimServerThereIsNoFleet) {
  const Sham router(words("comm_router")), station(words("station"));
  EXPECT_FALSE(found());
}

TEST_F(FleetsTest, AUsersCommandIsTheFirstProcessWithItsVariables) {
  const Sham server(words("sim_server"));
  const Sham command({"sh", "-c", "sleep 1000 & wait"},
                     {"SKEIN_UAV=jurong", "SKEIN_OUT=" + dir(), "PATH=/usr/bin:/bin"});
  const Sham half({"sh"}, {"SKEIN_UAV=changi"}), other_half({"sh"}, {"SKEIN_OUT=" + dir()});
  command.release();
  ASSERT_TRUE(eventually([&] {
    return std::ranges::any_of(all_processes(), [&](pid_t pid) { return parent_of(pid) == command.pid(); });
  }));
  EXPECT_EQ(found().value().programs,
            (std::map<std::string, pid_t>{{"sim_server", server.pid()}, {"uav_agent-jurong", command.pid()}}));
}

TEST_F(FleetsTest, AFleetIsChosenByItsFolder) {
  const ScratchDir other, empty;
  const Sham server(words("sim_server")), second(words_in(other.path(), "sim_server"));
  EXPECT_EQ(chosen_fleet(scratch_.path() / ".", "attach", "--out").programs.at("sim_server"), server.pid());
  EXPECT_EQ(chosen_fleet(other.path(), "attach", "--out").programs.at("sim_server"), second.pid());
  EXPECT_THROW(chosen_fleet(empty.path(), "attach", "--out"), InputError);
  EXPECT_THROW(chosen_fleet(empty.path() / "none", "attach", "--out"), InputError);
  try {
    chosen_fleet(std::nullopt, "attach", "--out");
    FAIL() << "a fleet was chosen, although two fly";
  } catch (const InputError& error) {
    for (const auto& folder : {scratch_.path(), other.path()}) {
      EXPECT_NE(std::string(error.what()).find(shown_folder(folder)), std::string::npos) << error.what();
    }
  }
}

TEST_F(FleetsTest, TheStateOfAProcessIsDebuggedStoppedOrRunning) {
  const Sham process({"sh", "-c", "sleep 1000"}, {"PATH=/usr/bin:/bin"});
  const std::string debugger = process_name(::getpid()) + " (process " + std::to_string(::getpid()) + ")";
  EXPECT_EQ(state_text(process.pid()), "debugged by " + debugger);
  process.release(SIGSTOP);
  EXPECT_TRUE(eventually([&] { return state_text(process.pid()) == "stopped"; })) << state_text(process.pid());
  EXPECT_EQ(::kill(process.pid(), SIGCONT), 0);
  EXPECT_TRUE(eventually([&] { return state_text(process.pid()) == "runs"; })) << state_text(process.pid());
}

TEST(SimulatedTime, IsThatOfTheLastRowThatIsCertainlyComplete) {
  const ScratchDir scratch;
  RunningFleet fleet;
  fleet.dir = scratch.path();
  EXPECT_EQ(simulated_s(fleet), std::nullopt) << "there is no file";
  std::string text;
  const auto after = [&](const std::string& more) {
    text += more;
    write_text(scratch.path() / run_folder::kTrajectories, text);
    return simulated_s(fleet);
  };
  EXPECT_EQ(after(""), std::nullopt);
  EXPECT_EQ(after("time_s,uav,x\n"), std::nullopt);
  EXPECT_EQ(after("12"), std::nullopt) << "the row may still be incomplete: the time may be 12.5";
  EXPECT_EQ(after(".5,a,1\n13"), 12.5);
  EXPECT_EQ(after(".75,a,2\n14.2"), 13.75);
}

TEST(ShownFolder, IsRelativeOnlyBelowTheWorkingFolder) {
  const std::filesystem::path here = std::filesystem::current_path();
  EXPECT_EQ(shown_folder(here / "runs" / "7"), "runs/7");
  EXPECT_EQ(shown_folder(here.parent_path() / "no_such_sibling"), here.parent_path() / "no_such_sibling");
}

}  // namespace
}  // namespace skein::cli
