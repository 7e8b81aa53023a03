// The commands of pages are in blocks that a test executes (pages_test.cpp), with few exceptions.
#include <regex>

#include "page_test.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

// Only few blocks of commands are not executed, and a note gives the reason. Blocks of other kinds contain no commands.
TEST(PageBlocks, AreExecutedOrSayWhyNot) {
  static const std::regex kCommand(R"((^|\n)\s*(\$ )?(\./)?skein [a-z])");
  constexpr int kMostUntyped = 61;
  int typed = 0, untyped = 0;
  for (const std::string& page : all_pages()) {
    for (const PageBlock& block : blocks_of(source_path(page))) {
      if (block.is_typed()) ++(block.is_run() ? typed : untyped);
      if (block.is_typed() || block.is_file()) continue;
      EXPECT_FALSE(std::regex_search(block.text, kCommand))
          << page << ":" << block.line << ": write ```sh, or ```console";
    }
  }
  EXPECT_GT(typed, 40);
  EXPECT_LE(untyped, kMostUntyped);
}

TEST(PageBlocks, AreComparedExceptWhereTheyShowThreeDots) {
  EXPECT_TRUE(matches("a\nb\n", "a\nb\n"));
  EXPECT_FALSE(matches("a\nb\n", "a\nc\n"));
  EXPECT_FALSE(matches("a\n", "a\nb\n"));
  EXPECT_FALSE(matches("a\nb\n", "a\n"));
  EXPECT_TRUE(matches("x: .../y\nz\n", "x: /p/q/y\nz\n"));
  EXPECT_FALSE(matches("x: .../y\n", "x: /p/q/z\n"));
  EXPECT_TRUE(matches("a\n...\n", "a\nb\nc\n"));
}

}  // namespace
}  // namespace skein::test
