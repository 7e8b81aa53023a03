// --debug with other tools than gdb, with none that is installed, and without any.
#include "debug_fixture.hpp"

namespace skein::test {
namespace {

class Tools : public DebugTest {};

TEST_F(Tools, AnyToolTakesTheCommandLine) {
  const auto note = folder() / "a note";
  const std::string tool = write("tool.sh", "echo \"$2\" >\"$1\"; shift 2; exec \"$@\"\n");
  ChildProcess& skein = fly("tool", {"--debug", "changi=/bin/sh " + tool + " '" + note.string() + "' \"two words\""});
  EXPECT_EQ(skein.wait().code, 0) << skein.out() << skein.err();
  EXPECT_EQ(text_of(note), "two words\n");
  EXPECT_EQ(result("tool")["digest"], plain_digest());
}

TEST_F(Tools, AToolThatEndsItsProgramIsNoticed) {
  ChildProcess& skein = fly("tool", {"--debug", "changi=/bin/sh -c 'exit 7'"});
  EXPECT_EQ(skein.wait().code, 3) << skein.out() << skein.err();
  expect_part(skein.err() + text_of(dir("tool") / "fleet.log"), "debugged program of changi has ended");
}

TEST_F(Tools, WhatIsMissingOrWrongStartsNothing) {
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

TEST_F(Tools, WhoWaitsIsToldAndGoesOn) {
  const std::string digest = plain_digest();
  for (const std::string member : {"changi", "comm_router"}) {
    const std::string name = "wait_" + member;
    ChildProcess& skein = fly(name, {"--debug", member + "=wait"});
    const std::string words = "kill -CONT ";
    ASSERT_TRUE(eventually([&] { return skein.err().find(words) != std::string::npos || skein.ended(); }))
        << skein.err();
    const std::string text = skein.err();
    expect_part(text, member + " stands before its first step");
    const auto log = dir(name) / (member == "changi" ? "uav_agent-changi.log" : "comm_router.log");
    EXPECT_TRUE(eventually([&] { return text_of(log).find("stands until") != std::string::npos; }));
    ::kill(std::stoi(text.substr(text.find(words) + words.size())), SIGCONT);
    EXPECT_EQ(skein.wait().code, 0) << skein.err();
    EXPECT_EQ(result(name)["digest"], digest);
  }
}

TEST_F(Tools, WhoWaitsGoesOnWhenItsDebuggerHasOnlyLooked) {
  SKEIN_NEEDS_GDB();
  ChildProcess& skein = fly("looked", {"--debug", "changi=wait"});
  const auto log = dir("looked") / "uav_agent-changi.log";
  const std::string words = "kill -CONT ";
  ASSERT_TRUE(eventually([&] {
    return skein.err().find(words) != std::string::npos && text_of(log).find("stands until") != std::string::npos;
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
