// The rule on names of tests in documents, on a small tree. The rule on names of files is tested in rules_test.cpp.
#include <gtest/gtest.h>

#include "tests/layers/rules.hpp"

namespace skein::layers {
namespace {

TEST(NamedTests, ANameOfNoTestIsFoundUnlessThePageSaysThatItIsAFormerOne) {
  SourceFile code, good, bad;
  code.path = "core/map_test.cpp";
  code.code = {"TEST(Map, HearsAll) {}", "TEST_F(Map,", "       TellsAll) {", "}", "TEST_P(Steps, AreCounted) {}"};
  good.path = "docs/good.md";
  good.lines = {"`Map.HearsAll`, `Map.Tells...` and `Steps.AreCounted`; `Other.Test`, `map.at`",
                "`Map.WasHere` (gone), `Map.Was...` (now two tests) and Map.WithoutQuotes"};
  EXPECT_EQ(check_named_tests({code, good}), Violations{});

  bad.path = "docs/folder/bad.md";
  bad.lines = {"", "`Map.HearsAl` and `Map.Sees...`", "`Map.AreCounted` (really)"};
  EXPECT_EQ(check_named_tests({code, bad}), (Violations{"docs/folder/bad.md:2: there is no test `Map.HearsAl`",
                                                        "docs/folder/bad.md:2: there is no test `Map.Sees...`",
                                                        "docs/folder/bad.md:3: there is no test `Map.AreCounted`"}));
}

}  // namespace
}  // namespace skein::layers
