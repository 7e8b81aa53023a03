// A fleet that docker-compose starts without Skein's launcher, from a file that `skein compose` has written.
#include <unistd.h>

#include "container_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// The command of docker-compose: version 2 is a plugin of Docker's client.
std::string compose() { return shell("docker compose version").code == 0 ? "docker compose" : "docker-compose"; }

class PlainCompose : public Containers {};

TEST_F(PlainCompose, FliesTheSameAndMergeJoinsItsResults) {
  const std::string file = folder() / "compose.yaml", project = "skein-plain-" + std::to_string(::getpid());
  const Arguments flown = arguments();
  Arguments wanted = {"compose", "towers", "--planner", "patrol", "--duration", "60", "--file", file};
  for (const std::string& word : programs_of_this_build()) wanted.push_back(word);
  ASSERT_EQ(skein(wanted).wait().code, 0);
  const std::string command = compose() + " --project-name " + project + " --file " + file + " ";
  ASSERT_EQ(shell(command + "config --quiet").code, 0) << shell(command + "config").text;
  adopt(project);
  const Answer up = shell(command + "up --detach");
  ASSERT_EQ(up.code, 0) << up.text;

  const fs::path dir = folder() / "results";
  fs::create_directories(dir);
  for (const std::string& program : kPrograms) {
    const std::string id = shell(command + "ps --quiet " + program).text;
    EXPECT_EQ(shell("timeout 120 docker wait " + id).text, "0") << program << ": " << shell("docker logs " + id).text;
    // Volumes exist as long as their container, whether it runs or not.
    const Answer copied = shell("docker cp " + id + ":/results/. " + dir.string());
    EXPECT_EQ(copied.code, 0) << copied.text;
  }
  // The server's report names the scenario by its path in the container, so merge gets its path on this host.
  const ChildProcess& merged = skein({"merge", dir, "--scenario", "towers"});
  ASSERT_TRUE(fs::exists(dir / "result.json")) << merged.err();
  const Json result = Json::parse(text_of(dir / "result.json"));
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_EQ((Flight{result["digest"], result["score"]}), alone(flown));

  const Answer down = shell(command + "down --volumes");
  EXPECT_EQ(down.code, 0) << down.text;
  EXPECT_EQ(left_of(project), "");
}

}  // namespace
}  // namespace skein::test
