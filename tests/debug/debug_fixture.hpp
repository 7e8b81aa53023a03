// Fixture for tests that debug one of two UAVs as a user would.
#pragma once

#include <signal.h>

#include <string>
#include <vector>

#include "core/text/text.hpp"
#include "fleet_fixture.hpp"
#include "small_scene.hpp"

/// First line of a test: skips it where gdb does not work.
#define SKEIN_NEEDS_GDB() \
  if (!skein::test::gdb_works()) GTEST_SKIP() << "gdb is not installed, or may not debug here"

namespace skein::test {

inline bool gdb_works() {
  return std::system("gdb -nx -batch -ex run --args /bin/true 2>/dev/null | grep -q 'exited normally'") == 0;
}

class DebugTest : public FleetTest {
 protected:
  DebugTest() : scenario_(write_small_scene(folder())) {}

  /// Starts the command line `words`, in which "skein" stands for the built one, with `commands` as its stdin.
  ChildProcess& typed(const std::string& name, const Arguments& words, const std::string& commands) {
    const auto file = write(name + ".gdb", commands);
    std::string line = "exec";
    for (const std::string& word : words) line += " " + shell_word(word == "skein" ? program("skein") : word);
    return start_program(name, {"/bin/sh", "-c", line + " <" + shell_word(file)});
  }
  /// Starts a debugged flight of `duration` seconds. Its results are in dir(name).
  ChildProcess& fly(const std::string& name, const Arguments& more, const std::string& commands = {},
                    const std::string& duration = "5") {
    const Arguments words = {"skein",      "run",    scenario_,     "--planner", "patrol",
                             "--duration", duration, "--no-oracle", "--out",     dir(name)};
    return typed(name, joined(words, more), commands);
  }
  std::filesystem::path dir(const std::string& name) const { return folder() / (name + ".dir"); }
  Json result(const std::string& name) const { return Json::parse(text_of(dir(name) / "result.json")); }
  /// Digest of the same flight without a debugger.
  std::string plain_digest() {
    return run("plain", {scenario_, "--planner", "patrol", "--duration", "5", "--no-oracle"}).digest();
  }
  void expect_only_lost(const std::string& name, const std::string& member) const {
    const Json lost = result(name)["lost_members"];
    ASSERT_EQ(lost.size(), 1u) << lost;
    EXPECT_EQ(lost[0]["member"], member);
  }
  static void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in:\n" << text;
  }

  const std::string scenario_;
};

}  // namespace skein::test
