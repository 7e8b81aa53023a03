// --debug with tools other than gdb, with a tool that is not installed, and without a tool.
#include <regex>

#include "core/files/command_file.hpp"
#include "debug_fixture.hpp"
#include "tests/free_port.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

class Tools : public DebugTest {
 protected:
  /// Starts a flight whose changi waits in gdbserver, and waits until the launcher says how to connect.
  ChildProcess& fly_in_gdbserver(const FreePort& port) {
    ChildProcess& skein = fly("server", {"--debug", "changi=gdbserver:" + port.text()});
    EXPECT_TRUE(eventually([&] { return skein.err().find("target remote") != std::string::npos || skein.ended(); }));
    return skein;
  }
};

TEST_F(Tools, AnyToolCanStartTheProgram) {
  const auto note = folder() / "a note";
  const std::string tool = write("tool.sh", "echo \"$2\" >\"$1\"; shift 2; exec \"$@\"\n");
  ChildProcess& skein = fly("tool", {"--debug", "changi=/bin/sh " + tool + " '" + note.string() + "' \"two words\""});
  EXPECT_EQ(skein.wait().code, 0) << skein.out() << skein.err();
  EXPECT_EQ(text_of(note), "two words\n");
  EXPECT_EQ(result("tool")["digest"], plain_digest());
}

TEST_F(Tools, AProgramThatEndsWithItsToolIsReported) {
  ChildProcess& skein = fly("tool", {"--debug", "changi=/bin/sh -c 'exit 7'"});
  EXPECT_EQ(skein.wait().code, 3) << skein.out() << skein.err();
  expect_part(skein.err() + text_of(dir("tool") / "fleet.log"), "debugged program of changi has ended");
}

TEST_F(Tools, AMissingToolOrAWrongOptionStartsNothing) {
  for (const auto& [value, part] :
       std::vector<std::pair<std::string, std::string>>{{"changi=no_such_tool -x", "apt-get install no_such_tool"},
                                                        {"changi=gdbserver:0", "gdbserver:PORT"},
                                                        {"changi=", "gdb, gdbserver:PORT, wait or a command"},
                                                        {"chang=wait", "changi"},
                                                        {"gcs=wait", "changi"}}) {
    ChildProcess& skein = fly("wrong", {"--debug", value});
    EXPECT_EQ(skein.wait().code, 2) << value;
    expect_part(skein.err(), part);
    EXPECT_FALSE(std::filesystem::exists(dir("wrong"))) << value;
  }
  EXPECT_EQ(fly("wrong", {"--debug", "changi=wait", "--one-process"}).wait().code, 2);
}

TEST_F(Tools, GdbserverLetsAnotherGdbDebugTheProgram) {
  SKEIN_NEEDS_GDB();
  if (command_file("gdbserver").empty()) GTEST_SKIP() << "there is no gdbserver here";
  const FreePort port;
  ChildProcess& skein = fly_in_gdbserver(port);
  std::smatch command;
  const std::string text = skein.err();
  ASSERT_TRUE(std::regex_search(text, command, std::regex("changi waits in gdbserver.*:\n\n  (.*)\n"))) << text;
  const std::string commands = write("elsewhere.gdb",
                                     "break skein::agent::PatrolPlanner::plan\ncontinue\nprint in.k\n"
                                     "print in.state.p_WB\ndelete\ncontinue\nquit\n");
  ChildProcess& gdb =
      start_program("elsewhere", {"/bin/sh", "-c", "exec " + command[1].str() + " <" + shell_word(commands)});
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  ASSERT_NE(gdb.out().find("exited normally"), std::string::npos) << gdb.out() << gdb.err();
  expect_part(gdb.out(), "hit Breakpoint 1, skein::agent::PatrolPlanner::plan");
  expect_part(gdb.out(), "$2 = (");
  EXPECT_EQ(skein.wait().code, 0) << skein.err();
  EXPECT_EQ(result("server")["digest"], plain_digest());
  EXPECT_FALSE(text_of(dir("server") / "uav_agent-changi.report.json").empty());
}

/// The launch file that docs/how-to-debug.md shows for VS Code, of this build and with another port.
Json launch_configuration(const std::string& port, const std::filesystem::path& programs) {
  const std::string page = text_of(source_path("docs/how-to-debug.md"));
  const auto begin = page.find("```json\n", page.find("*VS Code*")), end = page.find("\n```", begin);
  std::string text = page.substr(begin + 8, end - begin - 8);
  text = std::regex_replace(text, std::regex(R"(\$\{workspaceFolder\}/build/release/bin)"), programs.string());
  text = std::regex_replace(text, std::regex(R"(\$\{workspaceFolder\})"), source_path());
  text = std::regex_replace(text, std::regex(":2345"), ":" + port);
  return Json::parse(text)["configurations"].at(0);
}

// VS Code's extension speaks gdb's machine interface. The test sends what the extension sends for this launch file.
TEST_F(Tools, TheLaunchFileForVsCodeStopsAtABreakpoint) {
  SKEIN_NEEDS_GDB();
  if (command_file("gdbserver").empty()) GTEST_SKIP() << "there is no gdbserver here";
  const FreePort port;
  ChildProcess& skein = fly_in_gdbserver(port);
  const Json launch = launch_configuration(port.text(), std::filesystem::path(program("uav_agent")).parent_path());
  EXPECT_EQ(launch["MIMode"], "gdb");
  std::string commands = "-environment-cd " + Json(launch["cwd"]).dump() + "\n-gdb-set mi-async off\n";
  for (const Json& setup : launch["setupCommands"]) {
    commands += "-interpreter-exec console " + setup["text"].dump() + "\n";
  }
  commands += "-file-exec-and-symbols " + launch["program"].dump() + "\n-target-select remote " +
              launch["miDebuggerServerAddress"].get<std::string>() +
              "\n-break-insert skein::agent::PatrolPlanner::plan\n-exec-continue\n-stack-list-frames\n"
              "-data-evaluate-expression in.state.p_WB\n-break-delete\n-exec-continue\n-gdb-exit\n";
  const std::string file = write("launch.mi", commands);
  ChildProcess& gdb = start_program("code", {"/bin/sh", "-c", "exec gdb --interpreter=mi -nx <" + shell_word(file)});
  EXPECT_EQ(gdb.wait().code, 0) << gdb.out() << gdb.err();
  EXPECT_EQ(gdb.out().find("^error"), std::string::npos) << gdb.out();
  expect_part(gdb.out(), "reason=\"breakpoint-hit\"");
  expect_part(gdb.out(), "value=\"(");  // skein_printers.py writes a vector in one line
  expect_part(gdb.out(), "reason=\"exited-normally\"");
  EXPECT_EQ(skein.wait().code, 0) << skein.err();
  EXPECT_EQ(result("server")["digest"], plain_digest());
}

TEST_F(Tools, AProgramThatWaitsForADebuggerIsReportedAndContinues) {
  const std::string digest = plain_digest();
  for (const std::string member : {"changi", "comm_router"}) {
    const std::string name = "wait_" + member;
    ChildProcess& skein = fly(name, {"--debug", member + "=wait"});
    const std::string words = "kill -CONT ";
    ASSERT_TRUE(eventually([&] { return skein.err().find(words) != std::string::npos || skein.ended(); }))
        << skein.err();
    const std::string text = skein.err();
    expect_part(text, member + " waits before its first step");
    const auto log = dir(name) / (member == "changi" ? "uav_agent-changi.log" : "comm_router.log");
    EXPECT_TRUE(eventually([&] { return text_of(log).find("waits for a debugger") != std::string::npos; }));
    ::kill(std::stoi(text.substr(text.find(words) + words.size())), SIGCONT);
    EXPECT_EQ(skein.wait().code, 0) << skein.err();
    EXPECT_EQ(result(name)["digest"], digest);
  }
}

TEST_F(Tools, AProgramThatWaitsContinuesWhenItsDebuggerDetaches) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("looked", {"--debug", "changi=wait"});
  const auto log = dir("looked") / "uav_agent-changi.log";
  const std::string words = "kill -CONT ";
  ASSERT_TRUE(eventually([&] {
    return skein.err().find(words) != std::string::npos &&
           text_of(log).find("waits for a debugger") != std::string::npos;
  })) << skein.err();
  const std::string text = skein.err();
  const std::string pid = std::to_string(std::stoi(text.substr(text.find(words) + words.size())));
  ChildProcess& gdb = start_program("gdb", {"/usr/bin/env", "gdb", "-nx", "-batch", "-p", pid});
  EXPECT_EQ(gdb.wait().code, 0) << gdb.err();
  EXPECT_EQ(skein.wait().code, 0) << skein.err();
  EXPECT_EQ(result("looked")["digest"], plain_digest());
}

}  // namespace
}  // namespace skein::test
