#include "run/planner_spec.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

const std::vector<std::string> kFleet = {"jurong", "raffles", "sentosa"};

std::vector<std::string> specs(const std::string& text) {
  std::vector<std::string> result;
  const std::vector<UavPlanner> planners = parse_planners(text, kFleet).uavs;
  for (std::size_t i = 0; i < planners.size(); ++i) {
    EXPECT_EQ(planners[i].uav, kFleet[i]);
    result.push_back(planners[i].spec);
  }
  return result;
}

using Specs = std::vector<std::string>;

TEST(PlannerSpec, OneNameIsThePlannerOfAllUavs) { EXPECT_EQ(specs("hover"), (Specs{"hover", "hover", "hover"})); }

TEST(PlannerSpec, NamedUavsDifferAndTheRestGetTheDefault) {
  EXPECT_EQ(specs("raffles=hover"), (Specs{kDefaultPlanner, "hover", kDefaultPlanner}));
  EXPECT_EQ(specs("hover,raffles=waypoints:tour.yaml"), (Specs{"hover", "waypoints:tour.yaml", "hover"}));
  EXPECT_EQ(specs("sentosa=a,jurong=b,raffles=c"), (Specs{"b", "c", "a"}));
}

TEST(PlannerSpec, ParametersContinueAfterACommaUntilAUavIsNamed) {
  EXPECT_EQ(specs("hover:height_m=4,climb_mps=1"),
            (Specs{"hover:height_m=4,climb_mps=1", "hover:height_m=4,climb_mps=1", "hover:height_m=4,climb_mps=1"}));
  EXPECT_EQ(specs("jurong=hover:height_m=4,climb_mps=1,raffles=patrol,sentosa=hover"),
            (Specs{"hover:height_m=4,climb_mps=1", "patrol", "hover"}));
}

TEST(PlannerSpec, ACommandTakesThePlaceOfAPlanner) {
  EXPECT_EQ(specs("exec:./mine"), (Specs{"exec:./mine", "exec:./mine", "exec:./mine"}));
  EXPECT_EQ(specs("jurong=exec:./a --x=1,raffles=exec:B=2 ./b"),
            (Specs{"exec:./a --x=1", "exec:B=2 ./b", kDefaultPlanner}));
  EXPECT_EQ(exec_command("exec:./mine --at 1,2"), "./mine --at 1,2");
  EXPECT_EQ(exec_command("hover:height_m=4"), std::nullopt);
}

TEST(PlannerSpec, ACommandKeepsItsCommas) {
  EXPECT_EQ(specs("hover,sentosa=exec:./mine a,b, c=d,nobody=e,"),
            (Specs{"hover", "hover", "exec:./mine a,b, c=d,nobody=e,"}));
  EXPECT_EQ(specs("exec:./mine a,b,raffles=hover"), (Specs{"exec:./mine a,b", "hover", "exec:./mine a,b"}));
}

TEST(PlannerSpec, TheGroundStationHasAProgramOfItsOwn) {
  EXPECT_FALSE(parse_planners("hover", kFleet).ground);
  EXPECT_EQ(parse_planners("hover,gcs=listen:longest_text=3", kFleet).ground.value().spec, "listen:longest_text=3");
  EXPECT_EQ(parse_planners("gcs=exec:./mine a,b,jurong=hover", kFleet).ground.value().spec, "exec:./mine a,b");
  EXPECT_EQ(parse_planners("gcs=none,jurong=hover", kFleet).fallback.spec, kDefaultPlanner);
  EXPECT_EQ(specs("gcs=none,jurong=hover"), (Specs{"hover", kDefaultPlanner, kDefaultPlanner}));
  EXPECT_THROW(parse_planners("gcs=listen,gcs=none", kFleet), InputError);
}

TEST(PlannerSpec, TheTextAfterTheLastAtIsAnAgentProgram) {
  struct Case {
    std::string spec, name, agent;
  };
  // The program may follow any parameters, and stand at any place of the value.
  for (const auto& [spec, name, agent] : {Case{"kios@a", "kios", "a"},
                                          {"kios@../a=b/c:d", "kios", "../a=b/c:d"},
                                          {"kios:voxel_m=4,lanes=3@a/b", "kios:voxel_m=4,lanes=3", "a/b"},
                                          {"waypoints:a@b.yaml,speed=2@c", "waypoints:a@b.yaml,speed=2", "c"},
                                          {"waypoints:a@b.yaml", "waypoints:a", "b.yaml"},
                                          {"x:a=@b,c=d", "x:a=", "b,c=d"}}) {
    for (const std::string& text : {spec, spec + ",sentosa=hover", "sentosa=hover,jurong=" + spec + ",raffles=" + spec,
                                    "gcs=none,jurong=" + spec + ",raffles=" + spec}) {
      const Planners planners = parse_planners(text, kFleet);
      for (std::size_t i : {0, 1}) {
        EXPECT_EQ(planners.uavs[i].spec, name) << text;
        EXPECT_EQ(planners.uavs[i].agent.value_or(""), agent) << text;
        EXPECT_EQ(written(planners.uavs[i]), spec);
      }
    }
    const Planners planners = parse_planners("hover,gcs=" + spec, kFleet);
    EXPECT_EQ(written(planners.ground.value()), spec);
    EXPECT_FALSE(planners.uavs[0].agent);
  }
}

TEST(PlannerSpec, APlannerInPythonHasItsParametersBehindAnotherColon) {
  EXPECT_EQ(specs("py:a.py,jurong=py:a.py:B:x=1,y=2,raffles=hover"), (Specs{"py:a.py:B:x=1,y=2", "hover", "py:a.py"}));
  EXPECT_EQ(specs("py:a.py:x=1,y=2"), (Specs{"py:a.py:x=1,y=2", "py:a.py:x=1,y=2", "py:a.py:x=1,y=2"}));
  const Planners planners = parse_planners("py:a.py:B@team/agent", kFleet);
  EXPECT_EQ(planners.uavs[0].spec, "py:a.py:B");
  EXPECT_EQ(planners.uavs[0].agent, "team/agent");
  for (const char* text : {"py:a.py,x=1", "py:a.py:B,x=1", "py:a.py,juron=hover", "py:a.py@team/agent,x=1"}) {
    EXPECT_THROW(parse_planners(text, kFleet), InputError) << text;
  }
}

TEST(PlannerSpec, AColonWithoutParametersIsRefused) {
  for (const std::string spec : {"hover:", "kios:@a", "py:a.py:", "py:a.py:B:"}) {
    for (const std::string& text : {spec, "jurong=" + spec, "hover,gcs=" + spec}) {
      try {
        parse_planners(text, kFleet);
        ADD_FAILURE() << "accepted: " << text;
      } catch (const InputError& error) {
        const std::string said = error.what(), named = spec.substr(0, spec.find('@'));
        EXPECT_EQ(said.find("--planner " + text + ": parameters must follow '" + named + "'"), 0U) << said;
        EXPECT_NE(said.find("write " + named.substr(0, named.size() - 1)), std::string::npos) << said;
      }
    }
  }
  EXPECT_EQ(specs("exec:./mine --at:").front(), "exec:./mine --at:") << "a command may end with a colon";
  EXPECT_EQ(specs("hover:label=a:").front(), "hover:label=a:") << "the value of a parameter may end with a colon";
}

TEST(PlannerSpec, ACommandKeepsItsAtSigns) {
  const Planners planners = parse_planners("jurong=exec:./mine me@home,a=b@c,raffles=hover@a", kFleet);
  EXPECT_EQ(written(planners.uavs[0]), "exec:./mine me@home,a=b@c");
  EXPECT_FALSE(planners.uavs[0].agent);
  EXPECT_EQ(planners.uavs[1].agent, "a");
  EXPECT_FALSE(planners.uavs[2].agent) << "this UAV flies in the fleet's agent program";
}

TEST(PlannerSpec, TheNamesOfAgentProgramsMayBeReplaced) {
  const auto short_of = [](const std::string& text) {
    return with_agents_named(text, [](const std::filesystem::path& agent) { return agent.filename().string(); });
  };
  EXPECT_EQ(short_of("kios@a/b/c"), "kios@c");
  EXPECT_EQ(short_of("kios:x=1,y=2@a/b,jurong=hover@c/../d"), "kios:x=1,y=2@b,jurong=hover@d");
  EXPECT_EQ(short_of("hover@a/b,jurong=exec:x @a/b,c@d/e"), "hover@b,jurong=exec:x @a/b,c@d/e");
  for (const char* text : {"kios", "kios:x=1,y=2,jurong=hover", "exec:a@b/c,,d", "kios@", ""}) {
    EXPECT_EQ(short_of(text), text);
  }
  const auto whole = [](const std::filesystem::path& agent) { return agent.string(); };
  EXPECT_EQ(with_agents_named("kios@./a", whole), "kios@" + (std::filesystem::current_path() / "a").string());
}

TEST(PlannerSpec, InvalidTextIsRefused) {
  for (const char* text : {"",
                           "jurong=",
                           "nobody=hover",
                           "hover,nobody=patrol",
                           "jurong=a,jurong=b",
                           "hover,patrol",
                           ",hover",
                           "hover,,jurong=a",
                           "hover,",
                           "exec:",
                           "jurong=exec: ",
                           "nobody=exec:./mine",
                           "hover@",
                           "@a",
                           "jurong=@a",
                           "jurong=hover@,raffles=hover",
                           "hover:x=1@",
                           "gcs=none@a",
                           "hover@a,hover@b",
                           "hover@a,x=1"}) {
    EXPECT_THROW(parse_planners(text, kFleet), InputError) << text;
  }
}

TEST(PlannerSpec, AnUnknownUavIsAnsweredWithTheNearestName) {
  try {
    parse_planners("juron=hover", kFleet);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("jurong"), std::string::npos) << error.what();
  }
}

TEST(PlannerSpec, ALabelIsAValidNameOfAFolder) {
  EXPECT_EQ(planner_label("patrol"), "patrol");
  EXPECT_EQ(planner_label("kios@a/b"), "kios@a_b");
  EXPECT_EQ(planner_label("jurong=waypoints:a/../b.yaml"), "jurong_waypoints_a_.._b.yaml");
  EXPECT_EQ(planner_label("exec:" + std::string(5000, 'x')).size(), 100u);
}

}  // namespace
}  // namespace skein::cli
