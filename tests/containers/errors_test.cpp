// Messages of `skein compose --up` if a fleet cannot fly in containers, and if the user interrupts it.
#include <signal.h>

#include "container_fixture.hpp"

namespace skein::test {
namespace {

class ComposeErrors : public Containers {
 protected:
  /// Expects a message that tells the user how to solve the problem.
  void expect_refusal(const std::string& reason, const Arguments& more, const Environment& environment = {}) {
    SkeinRun& run = start_up("run" + std::to_string(++number_), more, environment);
    EXPECT_EQ(run.exit_code(), 2) << run.err();
    EXPECT_NE(run.err().find(reason), std::string::npos) << run.err();
    EXPECT_FALSE(std::filesystem::exists(run.dir())) << "the run has created its folder";
  }

 private:
  int number_ = 0;
};

TEST_F(ComposeErrors, NameARemedy) {
  expect_refusal("no Docker engine answers (`skein doctor` looks closer)", arguments(),
                 {{"DOCKER_HOST", "unix://" + (folder() / "no.sock").string()}});
  expect_refusal("the engine has no image 'skein-of-nobody'; docs/", arguments(), {{"SKEIN_IMAGE", "skein-of-nobody"}});
  expect_refusal("the engine has no image 'agent-of-nobody'; docs/",
                 arguments("patrol", "60", {"--image", "jurong=agent-of-nobody"}));
  expect_refusal("the fleet needs 7 networks of 16 addresses; a /25 would do",
                 arguments("patrol", "60", {"--subnet", "10.99.0.0/26"}));
  expect_refusal("--debug jurong: the image 'skein-agent' has no gdb; skein-agent-debug of docker/Dockerfile has it",
                 arguments("patrol", "60", {"--debug", "jurong=gdb"}));
  expect_refusal("name an image that has this one with --image jurong=IMAGE", arguments("patrol,jurong=exec:./mine"));
}

TEST_F(ComposeErrors, CtrlCEndsTheRunInGoodOrder) {
  SkeinRun& run = start_up("up", arguments("patrol", "3600"));
  ASSERT_TRUE(run.wait_until_flying()) << run.err();
  run.skein().signal(SIGINT);
  EXPECT_EQ(run.exit_code(), 130) << run.err();
  const Json result = run.result();
  EXPECT_EQ(result["status"], "interrupted");
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_TRUE(result["digest"].is_null());
  expect_complete_result(run);
  for (const std::string& name : kPrograms) {
    EXPECT_TRUE(std::filesystem::exists(run.dir() / (name + ".report.json"))) << name;
  }
}

}  // namespace
}  // namespace skein::test
