// The options of a run, written as a command line and as the JSON that the process of a flight gets.
#include "cli/run_arguments.hpp"

#include <gtest/gtest.h>

#include "cli/command_line.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// The options that Skein reads from the command line of the given options.
RunOptions parsed_again(const RunOptions& given) {
  const auto again = parse_command_line(arguments_of(given)).get<RunOptions>();
  EXPECT_EQ(arguments_of(again), arguments_of(given));
  return again;
}

RunOptions unusual_run() {
  RunOptions run;
  run.scenario = "./my scenes/a.yaml";
  run.planner = "hover,jurong=exec:./mine --speed 3, 4";
  run.seed = 18446744073709551615u;
  run.scene_seed = 4;
  run.uavs = 7;
  run.assets = "/some where";
  run.duration_s = 0.1;
  run.rules = "paper";
  run.faults = "a.yaml";
  run.dds = "mixed";
  run.clock = "realtime:2";
  run.agent = "mine";
  run.stop_at_s = 1e-3;
  run.keep_maps_s = 2.5;
  run.out = "here";
  run.native = run.secure = run.force = true;
  run.attainable = run.report = false;
  return run;
}

TEST(RunArguments, OfARunAreReadBack) {
  parsed_again(RunOptions());
  EXPECT_EQ(arguments_of(RunOptions()),
            (std::vector<std::string>{"run", "towers", "--planner=" + std::string(kDefaultPlanner), "--seed=0",
                                      "--dds=cyclonedds", "--clock=lockstep", "--record=run"}));
  const RunOptions run = unusual_run();
  const RunOptions again = parsed_again(run);
  EXPECT_EQ(again.planner, run.planner);
  EXPECT_EQ(again.scenario, run.scenario);
  EXPECT_EQ(again.uavs, run.uavs);
  EXPECT_EQ(again.duration_s, run.duration_s);
  EXPECT_FALSE(again.attainable);
  EXPECT_FALSE(again.report);
  EXPECT_EQ(again.keep_maps_s, 2.5);
  EXPECT_NE(again.command.find("'--planner=hover,jurong=exec:./mine --speed 3, 4'"), std::string::npos)
      << "the command is quoted for a shell: " << again.command;
  EXPECT_TRUE(again.secure);
}

TEST(RunArguments, OfAFlightAreReadBackFromJson) {
  RunOptions run = unusual_run();
  const RunOptions flown = flight_of(flight_words(run).back());
  EXPECT_EQ(flight_words(flown), flight_words(run));
  EXPECT_EQ(flown.seed, run.seed);
  EXPECT_EQ(flown.duration_s, run.duration_s);
  EXPECT_EQ(flown.out, run.out);
  EXPECT_EQ(flown.command, parsed_again(run).command) << "the command is that of the same command line";
  EXPECT_EQ(parse_command_line(flight_words(run)).get<RunOptions>().planner, run.planner);
  run.one_process = true;  // excludes --dds
  EXPECT_EQ(flight_of(flight_words(run).back()).command, parsed_again(run).command);
}

TEST(RunArguments, OfAFlightKeepEveryPathAndNumberExactly) {
  RunOptions run = unusual_run();
  run.scenario = "a \"quoted\"\n\\ näme'.yaml";
  run.out = "{}, \"seed\":7/\t";
  run.duration_s = 0.1 + 0.2;
  run.stop_at_s = 1e-300;
  const RunOptions flown = flight_of(flight_words(run).back());
  EXPECT_EQ(flown.scenario, run.scenario);
  EXPECT_EQ(flown.out, run.out);
  EXPECT_EQ(flown.seed, run.seed);
  EXPECT_EQ(flown.duration_s, run.duration_s);
  EXPECT_EQ(flown.stop_at_s, run.stop_at_s);
  run.out = "caf\xe9";
  EXPECT_THROW(flight_words(run), InputError) << "JSON cannot represent the value";
}

TEST(RunArguments, OfAFlightAreRefusedIfAFlightCannotHaveThem) {
  const auto refusal = [](const std::vector<std::string>& words) -> std::string {
    try {
      parse_command_line(words);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal({kFlight, "{}"}), "accepted");
  EXPECT_EQ(refusal({kFlight, R"({"one-process": true, "dds": "fastdds"})"}),
            R"(--flight: "dds": "fastdds" is of the wrong kind, or does not go with one-process)");
  EXPECT_EQ(refusal({kFlight, R"({"sede": 3})"}), "--flight: a flight has no option 'sede'; did you mean 'seed'?");
  for (const char* wrong : {R"("seed": "3")", R"("seed": -3)", R"("seed": 2.5)", R"("seed": null)", R"("out": 7)",
                            R"("log": "a=info")", R"("log": [1])", R"("secure": "yes")", R"("uavs": 1e30)"}) {
    const std::string said = refusal({kFlight, "{" + std::string(wrong) + "}"});
    EXPECT_NE(said.find("is of the wrong kind"), std::string::npos) << said;
  }
  for (const char* value : {R"("dds": "rti")", R"("record": "some")", R"("clock": "never")", R"("duration": -1)",
                            R"("scenario": "", "planner": "")"}) {
    EXPECT_NE(refusal({kFlight, "{" + std::string(value) + "}"}), "accepted") << value;
  }
  for (const char* text : {"", "{", "[]", "3", "null", "{\"seed\": 1} x"}) {
    EXPECT_NE(refusal({kFlight, text}).find("is for Skein's own commands"), std::string::npos) << text;
  }
  for (const std::vector<std::string>& words : {std::vector<std::string>{kFlight}, {kFlight, "{}", "{}"}}) {
    EXPECT_NE(refusal(words).find("is for Skein's own commands"), std::string::npos);
  }
}

}  // namespace
}  // namespace skein::cli
