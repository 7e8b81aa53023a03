#include "run/agent_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"
#include "run/fleet_programs.hpp"

namespace skein::cli {
namespace {

/// A script as an agent program. It has two planners, and one of them also as a program of the ground station.
constexpr const char* kAgent =
    "[ \"$1\" != --list-planners ] || echo '{\"planners\":[\"hover\",\"orbit\"],\"ground_programs\":[\"orbit\"]}'\n";

class AgentFile : public ::testing::Test {
 protected:
  AgentFile() { options_.scenario = programs_.scenario(); }

  std::string file(const std::string& name) const { return programs_.dir() / name; }
  std::string agent(const std::string& name) const {
    write_script(file(name), kAgent);
    return file(name);
  }
  FleetPlan plan() const { return plan_fleet(options_, program_dir()); }
  std::vector<ProgramSpec> flown() const { return fleet_programs(plan(), 1, programs_.dir()); }

  /// The agent program of a member, and the planner in its arguments.
  static std::string software(const std::vector<ProgramSpec>& programs, const std::string& program) {
    for (const ProgramSpec& spec : programs) {
      if (spec.name != program) continue;
      const auto option = std::find(spec.argv.begin(), spec.argv.end(), "--planner");
      return spec.argv.front() + " " + *std::next(option);
    }
    return "";
  }
  static bool is_minded(const std::vector<ProgramSpec>& programs, const std::string& program) {
    return std::ranges::any_of(programs, [&](const ProgramSpec& spec) { return spec.name == program && spec.minded; });
  }
  std::string refusal() const try {
    plan();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }

  FakePrograms programs_;
  RunOptions options_;
  const std::string alpha_ = programs::agent_program("alpha"), beta_ = programs::agent_program("beta"),
                    gcs_ = programs::kGroundAgent, stock_ = file("uav_agent");
};

// 129 UAVs are too many for DDS.
TEST_F(AgentFile, ALargeFleetFliesInOneProcessIfTheUserDoesNotChoose) {
  write_text(programs_.scenario(), scenario_of(129));
  options_.planner = "hover";
  const auto planned = [&] { return plan_fleet(options_, program_dir(), Processes::one_if_possible); };
  EXPECT_THROW(planned(), InputError) << "there is no program for a fleet in one process";
  agent(std::string(programs::kAgent) + programs::kFleetSuffix);
  EXPECT_TRUE(planned().options.one_process);
  EXPECT_NE(refusal().find("a fleet of 129 UAVs is too large for DDS"), std::string::npos) << refusal();
  options_.planner = "hover,u1=exec:./mine";
  EXPECT_THROW(planned(), InputError) << "this program needs DDS";
}

TEST_F(AgentFile, OptionsOfPlannersReachOnlyUavsWithPlanners) {
  agent(programs::kAgent);
  options_.clock = "realtime";
  options_.planner = "ros,beta=orbit,gcs=orbit";
  options_.keep_maps_s = 5.0;
  options_.time_parts = true;
  for (const ProgramSpec& program : flown()) {
    for (const char* option : {"--maps-every", "--time-parts"}) {
      EXPECT_EQ(std::ranges::count(program.argv, option), program.name == beta_ ? 1 : 0) << program.name << option;
    }
  }
  for (const char* planner : {"ros", "exec:./mine", "ros,beta=exec:./mine"}) {
    options_.planner = planner;
    EXPECT_NE(refusal().find("--keep-maps: programs of your own"), std::string::npos) << planner << refusal();
  }
}

TEST_F(AgentFile, EachPlannerFliesInTheProgramThatItNames) {
  const std::string a = agent("a"), b = agent("b");
  options_.planner = "orbit:x=1@" + a + ",beta=hover@" + b;
  const auto programs = flown();
  EXPECT_EQ(software(programs, alpha_), a + " orbit:x=1");
  EXPECT_EQ(software(programs, beta_), b + " hover");
  EXPECT_EQ(software(programs, gcs_), a + " orbit:x=1")
      << "the station has the planner and program of the UAVs that are not named";
  for (const std::string& program : {alpha_, beta_, gcs_}) EXPECT_TRUE(is_minded(programs, program)) << program;
  EXPECT_FALSE(is_minded(programs, programs::kSimServer));
  EXPECT_FALSE(plan().agent);
  EXPECT_EQ(agent_files(plan()), (std::vector<std::filesystem::path>{a, b}));
  options_.debug = {"beta"};
  EXPECT_NE(debug_command(plan(), beta_, 1, programs_.dir()).find("gdb --args " + b + " "), std::string::npos);
}

TEST_F(AgentFile, APlannerWithoutAProgramFliesInTheFleetsProgram) {
  const std::string a = agent("a"), b = agent("b");
  options_.planner = "hover,beta=orbit@" + a + ",gcs=orbit@" + b;
  EXPECT_EQ(software(flown(), alpha_), stock_ + " hover");
  EXPECT_EQ(software(flown(), beta_), a + " orbit");
  EXPECT_EQ(software(flown(), gcs_), b + " orbit");
  EXPECT_FALSE(is_minded(flown(), alpha_)) << "only programs of users have a minder";
  options_.agent = b;
  EXPECT_EQ(software(flown(), alpha_), b + " hover");
  EXPECT_EQ(software(flown(), beta_), a + " orbit");
}

TEST_F(AgentFile, NamingTheStockProgramHasTheEffectOfNamingNone) {
  options_.planner = "hover@" + file("../" + programs_.dir().filename().string() + "/uav_agent");
  std::filesystem::create_symlink(stock_, file("link"));
  for (const std::string& planner : {options_.planner, "hover@" + file("link")}) {
    options_.planner = planner;
    EXPECT_EQ(written(plan().planners[0]), "hover");
    EXPECT_EQ(software(flown(), alpha_), stock_ + " hover");
    EXPECT_FALSE(is_minded(flown(), alpha_));
  }
  options_.agent = agent("a");
  EXPECT_EQ(software(flown(), alpha_), stock_ + " hover")
      << "the planner names it, so the fleet's own program does not replace it";
  EXPECT_EQ(written(plan().planners[0]), "hover@" + stock_) << "the name is needed if the fleet has another program";
  options_.agent.reset();
  options_.planner = "waypoints:a@b.yaml@" + stock_;
  EXPECT_EQ(written(plan().planners[0]), options_.planner) << "without the program, the text would be read otherwise";
  EXPECT_EQ(software(flown(), alpha_), stock_ + " waypoints:a@b.yaml");
}

TEST_F(AgentFile, EachProgramChecksItsOwnPlanners) {
  const std::string a = agent("a"), b = agent("b");
  options_.planner = "orbit@" + a + ",beta=orbit@" + b + ",gcs=orbit@" + b;
  const auto programs = check_programs(plan(), programs_.dir());
  EXPECT_EQ(software(programs, alpha_), a + " orbit");
  EXPECT_EQ(software(programs, beta_), b + " orbit") << "two programs may have a planner of the same name";
  EXPECT_EQ(software(programs, gcs_), b + " orbit");
  options_.planner = "orbit@" + a + ",gcs=none";
  EXPECT_EQ(check_programs(plan(), programs_.dir()).size(), 2u)
      << "the checks are by sim_server and, for both UAVs, by one agent program";
}

// The plan is made before the launcher empties the folder of an earlier run.
TEST_F(AgentFile, AWrongNumberOfThreadsIsRefusedWhenThePlanIsMade) {
  write_script(file("uav_agent_fleet"), "");
  write_script(stock_, kAgent);
  options_.planner = "hover";
  options_.one_process = true;
  ::setenv("SKEIN_THREADS", "x", 1);
  EXPECT_NE(refusal().find("SKEIN_THREADS: 'x' must be a whole number"), std::string::npos) << refusal();
  ::setenv("SKEIN_THREADS", "3", 1);
  EXPECT_EQ(plan().options.threads, 3);
  ::unsetenv("SKEIN_THREADS");
}

TEST_F(AgentFile, AProgramThatIsNotAnAgentIsNamedWithACorrection) {
  write_text(file("text"), "no program");
  write_script(file("other"), "echo two of a kind\nexit 3\n");
  const auto refused = [&](const std::string& planner, const std::vector<std::string>& parts) {
    options_.planner = planner;
    const std::string message = refusal();
    for (const std::string& part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
    }
  };
  refused("hover@" + file("missing"), {"--planner hover@" + file("missing") + ": ", "no such file"});
  refused("hover,beta=hover@" + file("text"), {"--planner hover@" + file("text") + ": ", "cannot be executed"});
  refused("hover,gcs=hover@" + file("other"), {"skein_add_agent()", "exec:CMD", "two of a kind"});
  refused("hover,beta=orbits:x=1@" + agent("a"),
          {"--planner orbits:x=1@" + file("a") + ": ", "there is no planner 'orbits'", "did you mean 'orbit'?"});
  refused(std::string(100000, 'a') + "@" + agent("a"), {"there is no planner 'aaa", "...' in it; known are: hover"});
  EXPECT_LT(refusal().size(), 1000U);
  refused("waypoints:a@b.yaml", {"no such file", "write waypoints:a@b.yaml@" + stock_});
}

}  // namespace
}  // namespace skein::cli
