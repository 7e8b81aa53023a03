// Follows docs/how-to-test-faults.md literally: writes the files that the page shows, runs its commands, and compares
// their output with the page.
#include "page_test.hpp"
#include "report/testing/xml_check.hpp"
#include "results_page.hpp"
#include "tests/support/places.hpp"
#include "tests/support/test_program.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

class FaultPage : public PageTest {
 protected:
  /// Provides the agent of how-to-add-a-planner.md, which the page uses.
  FaultPage() { give_agent(checkout() / "build" / "my_agent"); }
};

TEST_F(FaultPage, ItsCommandsPrintWhatItShows) {
  const std::vector<PageBlock> blocks = blocks_of(source_path("docs/how-to-test-faults.md"));
  int followed = 0;
  for (const PageBlock& block : blocks) {
    if (block.language == "sh" && !block.is_file()) continue;  // pages_test.cpp types it
    followed += static_cast<int>(follow(block) && block.language == "console");
  }
  EXPECT_GE(followed, 6);
  for (const auto& run : fs::directory_iterator(checkout() / "runs" / "faults")) expect_documented_columns(run.path());
  const std::string report = text_of(checkout() / "faults.xml");  // written by the commands of the page's CI job
  ASSERT_FALSE(report.empty());
  const auto elements = report::xml_elements(report);
  EXPECT_EQ(elements.front().name, "testsuites");
  EXPECT_EQ(elements.front().attributes.at("failures"), "0");
  EXPECT_EQ(std::count_if(elements.begin(), elements.end(), [](const auto& e) { return e.name == "testcase"; }), 4);

  // Repeats a third of the commands in the same folder, as a reader may do, with the files that the page has left.
  int number = 0;
  for (const PageBlock& block : blocks) {
    if (block.is_file()) follow(block);
    if (block.language != "console") continue;
    follow_console(block, [&](int) { return has_turn(static_cast<std::size_t>(number++), 3); });
  }
}

TEST_F(FaultPage, AFolderOrOptionThatIsWrongIsRefusedWithoutOutput) {
  fs::create_directories(checkout() / "empty");
  for (const auto& [arguments, words] : std::vector<std::pair<std::string, std::string>>{
           {"--faults empty", "there is no fault test"},
           {"--faults none.yaml", "there is no such file or folder"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --seeds 5-1"), "seed"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --junit none/faults.xml"), "--junit"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --agent none"), "--agent"}}) {
    EXPECT_EQ(typed("./skein test " + arguments, 2), "") << arguments;
    EXPECT_NE(errors().find(words), std::string::npos) << arguments << "\n" << errors();
  }
}

}  // namespace
}  // namespace skein::test
