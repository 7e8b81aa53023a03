#include "debug/debuggee.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

using How = Debuggee::How;

std::string program_of(const std::string& name) {
  if (name == "jurong" || name == "changi") return programs::agent_program(name);
  if (name == "station") return name;
  throw InputError("no program is called " + name);
}

std::vector<Debuggee> parse(const std::vector<std::string>& values) { return parse_debug(values, program_of); }

TEST(Debuggee, ParseDebugReadsEachWayToDebug) {
  EXPECT_EQ(parse({"jurong"})[0].how, How::by_hand);
  EXPECT_EQ(parse({"station"})[0].how, How::wait)
      << "the station needs its pipe to the launcher, so the user cannot start it by hand";
  EXPECT_EQ(parse({"jurong=wait"})[0].how, How::wait);
  const Debuggee command = parse({"jurong=/bin/sh -c 'a b' \"c d\""})[0];
  EXPECT_EQ(command.how, How::command);
  EXPECT_EQ(command.tool, (std::vector<std::string>{"/bin/sh", "-c", "a b", "c d"}));
  EXPECT_EQ(command.program, "uav_agent-jurong");
}

TEST(Debuggee, OnlyOneToolHasTheTerminal) {
  const auto both = parse({"jurong=wait", "changi=/bin/sh", "station=/bin/sh"});
  EXPECT_FALSE(both[0].here);
  EXPECT_TRUE(both[1].here);
  EXPECT_FALSE(both[2].here);
  EXPECT_TRUE(parse({"changi=/bin/sh", "jurong=pdb"})[1].here);
}

TEST(Debuggee, AnInvalidOptionIsRefused) {
  for (const char* value : {"nobody=wait", "jurong=", "jurong=no_such_tool", "jurong=/no/such/tool", "jurong=gdbserver",
                            "jurong=gdbserver:", "jurong=gdbserver:0", "jurong=gdbserver:65536", "jurong=gdbserver:1x",
                            "jurong=sh 'open", "jurong=sh; rm x", "jurong=$(sh)", "jurong=/tmp"}) {
    EXPECT_THROW(parse({value}), InputError) << value;
  }
  EXPECT_THROW(parse({"jurong=wait", "jurong=/bin/sh"}), InputError);
}

TEST(Debuggee, TheToolPrecedesTheProgramsCommandLine) {
  ProgramSpec program{"uav_agent-jurong", {"/bin/agent", "--uav", "jurong"}, {}, "a.log"};
  put_under_tool(program, parse({"jurong=/bin/sh -e"})[0]);
  EXPECT_EQ(program.argv, (std::vector<std::string>{"/bin/sh", "-e", "/bin/agent", "--uav", "jurong"}));
  EXPECT_TRUE(program.minded && program.here);
  ProgramSpec in_pdb{"uav_agent-jurong", {"/bin/agent", "--pdb", "0"}, {}, "a b.log"};
  put_under_tool(in_pdb, parse({"jurong=pdb"})[0]);
  EXPECT_EQ(in_pdb.argv,
            (std::vector<std::string>{"/bin/sh", "-c", "exec \"$@\" 2>>'a b.log'", "sh", "/bin/agent", "--pdb", "0"}));
  EXPECT_TRUE(in_pdb.minded && in_pdb.here);
  ProgramSpec waiting{"uav_agent-jurong", {"/bin/agent"}, {}, "a.log"};
  put_under_tool(waiting, parse({"jurong=wait"})[0]);
  EXPECT_EQ(waiting.argv, (std::vector<std::string>{"/bin/agent", "--wait-for-debugger"}));
  EXPECT_FALSE(waiting.minded || waiting.here);
}

}  // namespace
}  // namespace skein::cli
