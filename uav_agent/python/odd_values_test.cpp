// Planners in Python that return objects of their own classes, or texts that UTF-8 cannot encode.
#include "uav_agent/testing/python_planner_fixture.hpp"

namespace skein::agent {
namespace {

/// A list whose class is the user's own may fail, or yield another number of items than its length.
TEST_F(PythonPlannerTest, ListsOfTheUsersOwnClassAreReadLikeOthers) {
  const auto at = [this](const std::string& items) {
    return make(file("class Own(list):\n    def __iter__(self): " + items +
                     "\nclass Mine(Planner):\n    def plan(self, inputs):\n"
                     "        return PlannerOutput(motion=Setpoint(Own([1, 2, 3])))\n"));
  };
  expect_has(refusal(*at("raise ValueError('odd')")), {"ValueError: odd", "at step 7"});
  expect_has(refusal(*at("return iter([1, 2])")), {"motion.p_WB: must be three finite numbers"});
  EXPECT_EQ(std::get<Setpoint>(ask(*at("return iter((4, 5, 6))")).motion).p_WB, Vector3d(4, 5, 6));
}

TEST_F(PythonPlannerTest, TextsThatUtf8CannotEncodeAreNamed) {
  expect_has(refusal(*planning("raise ValueError('half \\ud800')")),
             {"ValueError: half \\ud800", "at step 7 (0.35 s)"});
  const std::string code =
      "class Mine(Planner):\n    def plan(self, inputs): pass\n    def debug_names(self): return ['a\\ud800']\n";
  expect_has(input_error(file(code)), {"debug_names(): must be a text that UTF-8 can encode"});
}

}  // namespace
}  // namespace skein::agent
