// `skein convert`: the text that it prints or writes. If it refuses one file, it changes none.
#include "cli/convert_command.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/testing/fake_programs.hpp"
#include "process/program.hpp"

namespace skein::cli {
namespace {

class ConvertCommand : public testing::Test {
 protected:
  ConvertCommand() { write_text(old_, kOld); }

  int convert(std::vector<std::filesystem::path> files, bool in_place) {
    return convert_files({std::move(files), in_place}, {out_, err_});
  }

  static constexpr const char* kOld = "faults: []\nexpect: {score: 3}\n";
  static constexpr const char* kNew = "faults: []\nproperties:\n  score: always result(score) == 3\n";
  const ScratchDir scratch_;
  const std::filesystem::path old_ = scratch_.path() / "a.yaml", other_ = scratch_.path() / "b.yaml";
  std::ostringstream out_, err_;
};

TEST_F(ConvertCommand, PrintsOrRewritesFaultTestsOfEarlierVersions) {
  EXPECT_EQ(convert({old_}, false), kExitDone);
  EXPECT_EQ(out_.str(), kNew);
  EXPECT_EQ(read_text(old_), kOld);
  out_.str("");
  EXPECT_EQ(convert({scratch_.path()}, true), kExitDone);
  EXPECT_EQ(convert({old_}, true), kExitDone);
  EXPECT_EQ(out_.str(), old_.string() + ": converted\n" + old_.string() + ": nothing to convert\n");
  EXPECT_EQ(read_text(old_), kNew);
}

TEST_F(ConvertCommand, RefusesFilesThatAreNotFaultTestsAndChangesNothing) {
  write_text(other_, "name: towers\nfleet: []\n");
  const std::vector<std::vector<std::filesystem::path>> given = {{other_}, {scratch_.path()}, {old_, other_}};
  for (const bool in_place : {false, true}) {
    for (const auto& files : given) {
      try {
        convert(files, in_place);
        ADD_FAILURE() << "the file was accepted";
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(other_.string() + ":1: faults: is missing"), std::string::npos)
            << error.what();
      }
      EXPECT_EQ(out_.str(), "");
      EXPECT_EQ(read_text(old_), kOld);
    }
  }
}

}  // namespace
}  // namespace skein::cli
