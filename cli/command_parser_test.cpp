#include "cli/command_line.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "cli/bench_command.hpp"
#include "cli/check_command.hpp"
#include "cli/diff_command.hpp"
#include "cli/doctor_command.hpp"
#include "cli/help.hpp"
#include "cli/oracle_command.hpp"
#include "cli/scene_command.hpp"
#include "cli/study_options.hpp"
#include "cli/test_command.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

template <class Options>
Options parse(const std::vector<std::string>& arguments) {
  return parse_command_line(arguments).get<Options>();
}

TEST(Options, RunHasDefaults) {
  const auto run = parse<RunOptions>({"run"});
  EXPECT_EQ(run.scenario, "towers");
  EXPECT_EQ(run.planner, "flock");
  EXPECT_EQ(run.seed, 0u);
  EXPECT_EQ(run.dds, "cyclonedds");
  EXPECT_EQ(run.clock, "lockstep");
  EXPECT_FALSE(run.scene_seed || run.assets || run.duration_s || run.domain || run.stop_at_s || run.out);
  EXPECT_TRUE(run.debug.empty());
  EXPECT_FALSE(run.force || run.native);
}

TEST(Options, RunReadsAllItsOptions) {
  const auto run = parse<RunOptions>({"run",      "mbs",       "--planner",    "jurong=hover,raffles=patrol",
                                      "--seed",   "7",         "--scene-seed", "3",
                                      "--assets", "data",      "--duration",   "90.5",
                                      "--dds",    "mixed",     "--clock",      "realtime:2.5",
                                      "--debug",  "jurong",    "--native",     "--domain",
                                      "20",       "--stop-at", "12",           "--out",
                                      "o",        "--force"});
  EXPECT_EQ(run.scenario, "mbs");
  EXPECT_EQ(run.planner, "jurong=hover,raffles=patrol");
  EXPECT_EQ(run.seed, 7u);
  EXPECT_EQ(run.scene_seed, 3u);
  EXPECT_EQ(run.assets, "data");
  EXPECT_EQ(run.duration_s, 90.5);
  EXPECT_EQ(run.dds, "mixed");
  EXPECT_EQ(run.clock, "realtime:2.5");
  EXPECT_EQ(run.debug, (std::vector<std::string>{"jurong"}));
  EXPECT_EQ(run.domain, 20);
  EXPECT_EQ(run.stop_at_s, 12.0);
  EXPECT_EQ(run.out, "o");
  EXPECT_TRUE(run.force && run.native);
}

TEST(Options, TheTimeToWaitForAnAgentIsANumberOfSeconds) {
  EXPECT_FALSE(parse<RunOptions>({"run"}).agent_timeout_s);
  EXPECT_EQ(parse<RunOptions>({"run", "--agent-timeout", "2.5"}).agent_timeout_s, 2.5);
  for (const char* wrong : {"0", "-1", "nan", "inf", "soon", "0x10", "1e9", "", "1e-300", "0.09"}) {
    EXPECT_THROW(parse<RunOptions>({"run", "--agent-timeout", wrong}), InputError) << wrong;
  }
  EXPECT_THROW(parse<RunOptions>({"run", "--agent-timeout", "3", "--debug", "jurong"}), InputError);
}

TEST(Options, OtherHostsTakePartOnlyWhenAsked) {
  for (const std::string command : {"run", "compare", "contest"}) {
    const auto network = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments = {command};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return command == "run" ? parse<RunOptions>(arguments).network : parse<StudyOptions>(arguments).network;
    };
    EXPECT_EQ(network({}), std::nullopt);
    EXPECT_EQ(network({"--network"}), "all");
    EXPECT_EQ(network({"--network", "all"}), "all");
    EXPECT_EQ(network({"--network=eth0"}), "eth0");
  }
}

TEST(Options, TheDoctorsOptionsNameAFleetAndItsNetwork) {
  const auto plain = parse<DoctorOptions>({"doctor"});
  EXPECT_FALSE(plain.net || plain.json || plain.network || plain.domain);
  EXPECT_EQ(plain.scenario, "towers");
  const auto net = parse<DoctorOptions>({"doctor", "net", "--network", "{world: {peers: [a]}}", "--as", "me", "--only",
                                         "world,gcs", "--seconds", "2.5", "--dds", "mixed", "--domain", "9"});
  EXPECT_TRUE(net.net);
  EXPECT_EQ(net.network, "{world: {peers: [a]}}");
  EXPECT_EQ(net.name, "me");
  EXPECT_EQ(net.only, (std::vector<std::string>{"world", "gcs"}));
  EXPECT_EQ(net.seconds, 2.5);
  EXPECT_EQ(net.dds, "mixed");
  EXPECT_EQ(net.domain, 9);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"doctor", "nett"},
                                                {"doctor", "--as", "me"},
                                                {"doctor", "--seconds", "3"},
                                                {"doctor", "--only", "gcs"},
                                                {"doctor", "net", "--seconds", "0"},
                                                {"doctor", "--dds", "other"},
                                                {"doctor", "--network", ""}}) {
    EXPECT_THROW(parse_command_line(wrong), InputError) << wrong.back();
  }
}

TEST(Options, TheParserAcceptsTheExamplesOfTheContainerCommands) {
  for (const std::string command : {"compose", "keys", "merge"}) {
    const std::string help = parse<HelpText>({command, "--help"}).text, mark = "\n  skein " + command + " ";
    std::size_t examples = 0;
    for (std::size_t at = 0; (at = help.find(mark, at)) != std::string::npos; ++examples) {
      std::istringstream line(help.substr(at + 9, help.find('\n', at + 1) - at - 9));
      const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
      EXPECT_NO_THROW(parse_command_line(words)) << help;
      at += mark.size();
    }
    EXPECT_GT(examples, 0u) << help;
  }
}

TEST(Options, OtherCommandsReadTheirOptions) {
  EXPECT_TRUE(parse<TestOptions>({"test", "--long"}).long_tests);
  EXPECT_EQ(parse<TestOptions>({"test", "core", "bus"}).folders, (std::vector<std::string>{"core", "bus"}));
  EXPECT_THROW(parse<TestOptions>({"test", "core", "--faults", "mine"}), InputError);
  const auto faults =
      parse<TestOptions>({"test", "--faults", "mine", "--repeat", "again,chaos", "--rotate", "--out", "o"});
  EXPECT_EQ(faults.faults, "mine");
  EXPECT_EQ(faults.repeat, (std::vector<std::string>{"again", "chaos"}));
  EXPECT_TRUE(faults.rotate);
  EXPECT_EQ(faults.out, "o");
  EXPECT_THROW(parse<TestOptions>({"test", "--faults", "mine", "--repeat", "twice"}), InputError);
  EXPECT_THROW(parse<TestOptions>({"test", "--repeat", "again"}), InputError) << "no test was named";
  EXPECT_EQ(parse<CheckOptions>({"check", "a.yaml"}).scenario, "towers");
  EXPECT_EQ(parse<CheckOptions>({"check", "a.yaml", "--scenario", "mbs"}).scenario, "mbs");
  EXPECT_EQ(parse<CheckOptions>({"check", "a.yaml", "--conditions", "wind=harsh"}).conditions, "wind=harsh");
  const auto scene = parse<SceneOptions>({"scene", "towers", "--scene-seed", "4", "--out", "there", "--force"});
  EXPECT_EQ(scene.scenario, "towers");
  EXPECT_EQ(scene.scene_seed, 4u);
  EXPECT_EQ(scene.out, "there");
  EXPECT_TRUE(scene.force);
  EXPECT_FALSE(scene.picture);
  EXPECT_TRUE(parse<SceneOptions>({"scene", "wild", "--picture"}).picture);
  EXPECT_THROW(parse<SceneOptions>({"scene", "towers"}), InputError);
  EXPECT_THROW(parse<SceneOptions>({"scene", "towers", "--out", "there", "--scene-seed", "-1"}), InputError);
  EXPECT_EQ(parse<CheckOptions>({"check", "a.yaml", "b.yaml"}).files, (std::vector<std::string>{"a.yaml", "b.yaml"}));
  EXPECT_EQ(parse<CheckOptions>({"check", "--golden", "a.csv", "b.csv"}).golden,
            (std::vector<std::string>{"a.csv", "b.csv"}));
  EXPECT_EQ(parse<DiffOptions>({"diff", "x", "y"}).run_b, "y");
  EXPECT_NE(parse<HelpText>({"--help"}).text.find("diff"), std::string::npos);
  EXPECT_NE(parse<HelpText>({"run", "--help"}).text.find("--stop-at"), std::string::npos);
  for (const std::string command : {"ps", "attach", "hunt", "blame", "rerun", "fork", "report", "replay", "convert",
                                    "doctor", "pack", "check-planner"}) {
    EXPECT_NE(parse<HelpText>({command, "--help"}).text.find("\n  skein " + command), std::string::npos) << command;
  }
  for (const char* command : {"run", "test", "check", "scene", "bench", "oracle", "contest", "compare", "diff"}) {
    const HelpText help = parse<HelpText>({command, "--help"});
    EXPECT_NE(help.text.find("Example"), std::string::npos) << command;
    EXPECT_NE(help.text.find(std::string("skein ") + command), std::string::npos) << command;
    EXPECT_EQ(help.names_planners, std::set<std::string>({"run", "contest", "compare"}).contains(command)) << command;
  }
  EXPECT_EQ(parse<HelpText>({"--version"}).text.find("skein "), 0u);
}

TEST(Options, ACommandHasTheOptionsOfItsOwnType) {
  const Command command = parse_command_line({"diff", "x", "y"});
  ASSERT_NE(command.get_if<DiffOptions>(), nullptr);
  EXPECT_EQ(command.get_if<DiffOptions>()->run_a, "x");
  EXPECT_EQ(command.get_if<RunOptions>(), nullptr);
  EXPECT_THROW(command.get<RunOptions>(), std::bad_any_cast);
}

TEST(Options, OracleReadsAllItsOptions) {
  const auto oracle = parse<OracleOptions>(
      {"oracle", "towers", "--scene-seed", "4", "--assets", "data", "--clearance", "0.75", "--outside", "--json"});
  EXPECT_EQ(oracle.scenario, "towers");
  EXPECT_EQ(oracle.scene_seed, 4u);
  EXPECT_EQ(oracle.assets, "data");
  EXPECT_EQ(oracle.clearances_m, (std::vector<double>{0.75}));
  EXPECT_TRUE(oracle.outside_only && oracle.json);
  EXPECT_FALSE(oracle.vehicle || oracle.plan);
  EXPECT_TRUE(parse<OracleOptions>({"oracle", "towers", "--plan"}).plan);
  EXPECT_TRUE(parse<OracleOptions>({"oracle", "towers"}).clearances_m.empty());
  const auto several = parse<OracleOptions>({"oracle", "towers", "--clearance", "0.5,0.8,2.5", "--vehicle"});
  EXPECT_EQ(several.clearances_m, (std::vector<double>{0.5, 0.8, 2.5}));
  EXPECT_TRUE(several.vehicle);
  for (const char* clearance : {"-1", "nan", "x", "1000"}) {
    EXPECT_THROW(parse_command_line({"oracle", "towers", "--clearance", clearance}), InputError) << clearance;
  }
  EXPECT_THROW(parse_command_line({"oracle"}), InputError);
}

TEST(Options, ContestAndCompareReadAllTheirOptions) {
  const auto contest = parse<StudyOptions>({"contest",
                                            "--planners",
                                            "kios,xxh:faithful=true",
                                            "--planners",
                                            "star",
                                            "--planner",
                                            "patrol,jurong=hover",
                                            "--tests",
                                            "3",
                                            "--rank",
                                            "median",
                                            "--scenarios",
                                            "towers,sail",
                                            "--assets",
                                            "data",
                                            "--duration",
                                            "60",
                                            "--dds",
                                            "mixed",
                                            "--jobs",
                                            "2",
                                            "--out",
                                            "o",
                                            "--force"});
  EXPECT_TRUE(contest.contest && contest.force);
  EXPECT_EQ(contest.planner_lists, (std::vector<std::string>{"kios,xxh:faithful=true", "star"}));
  EXPECT_EQ(contest.planners, std::vector<std::string>{"patrol,jurong=hover"});
  EXPECT_EQ(contest.seeds, "1-3");
  EXPECT_EQ(contest.rank, Rank::median);
  EXPECT_EQ(contest.scenarios, (std::vector<std::string>{"towers", "sail"}));
  EXPECT_EQ(contest.assets, "data");
  EXPECT_EQ(contest.duration_s, 60.0);
  EXPECT_EQ(contest.dds, "mixed");
  EXPECT_EQ(contest.jobs, 2);
  EXPECT_EQ(contest.out, "o");
  EXPECT_EQ(parse<StudyOptions>({"contest", "--planners", "a"}).seeds, "1-5");
  EXPECT_EQ(parse<StudyOptions>({"contest", "--planners", "a"}).rank, Rank::maximum);

  const auto compare = parse<StudyOptions>({"compare", "--planners", "a,b", "--seeds", "3,5", "--scene-seed", "4"});
  EXPECT_FALSE(compare.contest);
  EXPECT_EQ(compare.seeds, "3,5");
  EXPECT_EQ(compare.scene_seed, 4u);
  EXPECT_EQ(parse<StudyOptions>({"compare"}).seeds, "0-4");
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"contest", "--tests", "0"},
                                             {"contest", "--rank", "mean"},
                                             {"contest", "--rank", "0"},
                                             {"contest", "--seeds", "3"},
                                             {"compare", "--tests", "3"},
                                             {"compare", "--jobs", "0"},
                                             {"compare", "--scene-seed", "-1"}}) {
    EXPECT_THROW(parse_command_line(wrong), InputError) << wrong[1];
  }
}

TEST(Options, BenchReadsAllItsOptions) {
  EXPECT_TRUE(parse<BenchOptions>({"bench"}).sizes.empty());
  const auto bench =
      parse<BenchOptions>({"bench", "--quick", "--sizes", "1,20", "--repeat", "5", "--scenario", "mbs", "--assets",
                           "data", "--dds", "fastdds", "--json", "b.json", "--duration", "30"});
  EXPECT_TRUE(bench.quick);
  EXPECT_EQ(bench.sizes, (std::vector<std::size_t>{1, 20}));
  EXPECT_EQ(bench.scenarios, std::vector<std::string>{"mbs"});
  EXPECT_EQ(bench.repeats, 5);
  EXPECT_EQ(bench.duration_s, 30.0);
  EXPECT_EQ(bench.json, "b.json");
  EXPECT_EQ(parse<BenchOptions>({"bench", "--sizes", "129,1024"}).sizes, (std::vector<std::size_t>{129, 1024}));
  for (const char* size : {"0", "1025", "x"}) EXPECT_THROW(parse_command_line({"bench", "--sizes", size}), InputError);
  const auto planners = parse<BenchOptions>({"bench", "--planners", "--against", "old.csv", "--write", "new.csv"});
  EXPECT_TRUE(planners.planners);
  EXPECT_EQ(planners.against, "old.csv");
  EXPECT_EQ(planners.write, "new.csv");
  EXPECT_THROW(parse_command_line({"bench", "--write", "new.csv"}), InputError);
  const auto sensing = parse<BenchOptions>({"bench", "--write", "docs", "--sensing", "--quick"});
  EXPECT_TRUE(sensing.sensing && sensing.quick);
  EXPECT_EQ(sensing.write, "docs");
  EXPECT_THROW(parse_command_line({"bench", "--sensing", "--planners"}), InputError);
  const auto tracking = parse<BenchOptions>({"bench", "--tracking", "--quick", "--duration", "60"});
  EXPECT_TRUE(tracking.tracking && tracking.quick);
  EXPECT_EQ(tracking.duration_s, 60.0);
  EXPECT_THROW(parse_command_line({"bench", "--sensing", "--tracking"}), InputError);
  EXPECT_THROW(parse_command_line({"bench", "--tracking", "--write", "docs"}), InputError);
  EXPECT_TRUE(parse<BenchOptions>({"bench", "--view", "--quick"}).view);
  EXPECT_THROW(parse_command_line({"bench", "--view", "--tracking"}), InputError);
}

TEST(Options, BenchMakesOneKindOfMeasurement) {
  const std::vector<std::string> kinds = {"--planners", "--sensing", "--tracking", "--view", "--profile", "--python"};
  for (const std::string& kind : kinds) {
    for (const std::string& other : kinds) {
      if (kind == other) continue;
      EXPECT_THROW(parse_command_line({"bench", kind, other}), InputError) << kind << " " << other;
    }
  }
}

TEST(Options, AHuntRefusesStatusAndDetach) {
  parse_command_line({"hunt", "towers", "--executor", "slurm"});
  EXPECT_THROW(parse_command_line({"hunt", "towers", "--executor", "slurm", "--detach"}), InputError);
  EXPECT_THROW(parse_command_line({"hunt", "--status", "runs/hunt"}), InputError);
  parse_command_line({"compare", "--status", "runs/compare"});
}

TEST(Options, TheLargestSeedAndTheLimitsAreAccepted) {
  EXPECT_EQ(parse<RunOptions>({"run", "--seed", "18446744073709551615"}).seed, ~std::uint64_t{0});
  EXPECT_EQ(parse<RunOptions>({"run", "--clock", "realtime:1000"}).clock, "realtime:1000");
  EXPECT_EQ(parse<RunOptions>({"run", "--stop-at", "36000"}).stop_at_s, 36000.0);
}

TEST(Options, InvalidArgumentsAreRefused) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"fly"},
      {"run", "a", "b"},
      {"run", "--seed", "-1"},
      {"run", "--seed", "x"},
      {"run", "--dds", "opendds"},
      {"run", "--duration", "0"},
      {"run", "--duration", "nan"},
      {"run", "--stop-at", "inf"},
      {"run", "--scene-seed", "1.5"},
      {"run", "--clock", "realtime:inf"},
      {"run", "--clock", "realtime:0"},
      {"run", "--clock", "realtime:fast"},
      {"run", "--clock", "fast"},
      {"run", "--clock", "realtime:1e-12"},
      {"run", "--clock", "realtime:10000"},
      {"run", "--clock", "realtime:0x2"},
      {"run", "--seed", "99999999999999999999"},
      {"run", "--seed", ""},
      {"run", "--duration", "0x10"},
      {"run", "--duration", " 5"},
      {"run", "--stop-at", "1e18"},
      {"run", "--out", ""},
      {"run", "--agent="},
      {"run", ""},
      {"scene", "towers", "--out", ""},
      {"compare", "--planners", ""},
      {"check", ""},
      {"run", "--no-such-option"},
      {"check"},
      {"diff", "x"},
  };
  for (const auto& arguments : wrong) {
    EXPECT_THROW(parse_command_line(arguments), InputError) << (arguments.empty() ? "" : arguments.back());
  }
}

TEST(Options, ARefusalOfAnArgumentTellsTheCorrection) {
  const auto said = [](const std::vector<std::string>& arguments) -> std::string {
    try {
      parse_command_line(arguments);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(0, std::string(error.what()).find('\n'));
    }
    return "accepted";
  };
  EXPECT_EQ(said({"run", "--seed", "1", "--seed", "2"}), "--seed: is given 2 times; give it once");
  EXPECT_EQ(said({"run", "--domain", "--force"}), "--domain: '--force' must be a whole number of at most nine digits");
  EXPECT_EQ(said({"run", "--domain=99999999999"}),
            "--domain: '99999999999' must be a whole number of at most nine digits");
  EXPECT_EQ(said({"run", "--force=maybe"}), "--force: takes no value, such as 'maybe'; leave '=' and the value out");
  const std::string unexpected = "The following argument was not expected: ";
  EXPECT_EQ(said({"run", "--planer=kios"}), unexpected + "--planer=kios; did you mean '--planner'?");
  EXPECT_EQ(said({"run", "--force", "--xyzzy"}), unexpected + "--xyzzy");
  EXPECT_EQ(said({"run", "towers", "cranes"}), unexpected + "cranes");
}

TEST(Options, FaultTestOptionsAreRefusedWithoutFaultTests) {
  const auto test = parse<TestOptions>(
      {"test", "--faults", "d", "--agent", "a", "--jobs", "3", "--seeds", "1-20", "--junit", "x.xml", "-v"});
  EXPECT_EQ(test.agent, "a");
  EXPECT_EQ(test.jobs, 3);
  EXPECT_EQ(test.seeds, "1-20");
  EXPECT_EQ(test.junit, "x.xml");
  EXPECT_TRUE(test.verbose);
  for (const std::vector<std::string>& alone : std::vector<std::vector<std::string>>{
           {"--agent", "a"}, {"--jobs", "3"}, {"--seeds", "3"}, {"--junit", "x"}, {"-v"}}) {
    std::vector<std::string> arguments = {"test"};
    arguments.insert(arguments.end(), alone.begin(), alone.end());
    EXPECT_THROW(parse_command_line(arguments), InputError) << alone.front();
  }
  EXPECT_THROW(parse_command_line({"test", "--faults", "d", "--jobs", "0"}), InputError);
}

}  // namespace
}  // namespace skein::cli
