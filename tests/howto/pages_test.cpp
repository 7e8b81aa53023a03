// Executes the commands of every page, in order, as a new user would: in an empty folder, and then all of them again in
// the same folder. page_test.hpp explains how pages mark blocks that are not executed.
#include <algorithm>
#include <iterator>
#include <regex>

#include "page_test.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// A part of a page that can be followed by itself; most pages have one.
struct Chapter {
  std::string page = {}, name = {};
  std::vector<PageBlock> blocks = {};
  std::string problem = {};  ///< why the page cannot be read

  friend std::ostream& operator<<(std::ostream& out, const Chapter& chapter) { return out << chapter.page; }
};

/// The chapters of a page that have commands. @param stem  the page's name, with characters that a test's name may have
std::vector<Chapter> chapters_of(const std::string& page, const std::string& stem) try {
  std::vector<Chapter> all = {{page, stem, {}, {}}};
  for (PageBlock& block : blocks_of(source_path(page))) {
    if (!block.note("chapter").empty()) all.push_back({page, stem + "_" + std::to_string(all.size() + 1), {}, {}});
    all.back().blocks.push_back(std::move(block));
  }
  std::erase_if(all, [](const Chapter& chapter) { return std::ranges::none_of(chapter.blocks, &PageBlock::is_run); });
  return all;
} catch (const std::runtime_error& error) {
  return {{page, stem, {}, error.what()}};
}

/// The chapters of all pages that have commands.
std::vector<Chapter> all_chapters() {
  std::vector<Chapter> all;
  for (const std::string& page : all_pages()) {
    const std::string stem = std::regex_replace(fs::path(page).stem().string(), std::regex("[^A-Za-z0-9]"), "_");
    std::ranges::move(chapters_of(page, stem), std::back_inserter(all));
  }
  return all;
}

/// Whether another test executes the block: fault_page_test.cpp does so with the consoles of one page.
bool is_typed_elsewhere(const std::string& page, const PageBlock& block) {
  return page == "docs/how-to-test-faults.md" && block.language == "console";
}

class Pages : public PageTest, public testing::WithParamInterface<Chapter> {};

TEST_P(Pages, HaveCommandsThatWorkTwice) {
  const auto& [page, name, blocks, problem] = GetParam();
  ASSERT_EQ(problem, "");
  for (const char* round : {"the first time", "again"}) {
    for (const PageBlock& block : blocks) {
      SCOPED_TRACE(page + ":" + std::to_string(block.line) + ", " + round);
      if (!is_typed_elsewhere(page, block)) follow(block);
    }
    SCOPED_TRACE(page + ", at its end, " + round);
    run_python();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Pages, testing::ValuesIn(all_chapters()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace skein::test
