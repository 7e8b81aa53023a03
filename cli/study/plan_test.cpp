#include "cli/study/plan.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class PlanOfAStudy : public testing::Test {
 protected:
  PlanOfAStudy() {
    fs::create_directories(dir_ / "other");
    fs::create_symlink(small_, dir_ / "link.yaml");
    write_text(dir_ / "mine.py", "");
  }

  /// The message with which plan_study() refuses this study, or "accepted".
  std::string answer_to(const std::vector<std::string>& planners, const std::vector<std::string>& scenarios) const {
    StudyOptions options;
    options.planners = planners;
    options.scenarios = scenarios;
    options.seeds = "0";
    options.uavs = {1, 2};
    try {
      plan_study(options, AskPrograms::no);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const FakePrograms programs_;
  const fs::path dir_ = programs_.dir();
  const std::string small_ = programs_.scenario();
};

TEST_F(PlanOfAStudy, RefusesAScenarioThatIsNamedTwiceByDifferentPaths) {
  for (const fs::path& other : {dir_ / "." / "small.yaml", dir_ / "other/../small.yaml", dir_ / "link.yaml"}) {
    EXPECT_EQ(answer_to({"hover"}, {small_, other}),
              "scenario '" + other.string() + "' is named twice: '" + small_ + "' is the same file");
  }
  const std::string towers = source_path("config/scenarios/towers.yaml");
  EXPECT_NE(answer_to({"hover"}, {"towers", towers}).find("'towers' is the same file"), std::string::npos);
  write_text(dir_ / "copy.yaml", kSmallScenario);
  EXPECT_EQ(answer_to({"hover"}, {small_, dir_ / "copy.yaml"}), "accepted")
      << "a copy is another file, and two fleet sizes do not name a scenario twice";
}

TEST_F(PlanOfAStudy, RefusesAPlannerInPythonThatIsNamedTwiceByDifferentPaths) {
  const std::string mine = "py:" + (dir_ / "mine.py").string();
  for (const char* class_name : {"", ":Mine"}) {
    const std::string other = "py:" + (dir_ / "other/../mine.py").string() + class_name;
    EXPECT_EQ(answer_to({mine + class_name, other}, {small_}), "planner '" + mine + class_name + "' is named twice");
  }
}

}  // namespace
}  // namespace skein::cli
