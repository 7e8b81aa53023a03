// Values that no option may have, whatever the command.
#include "cli/option_checks.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "cli/command_line.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "run/run_options.hpp"

namespace skein::cli {
namespace {

using Arguments = std::vector<std::string>;

std::string said_of(const Arguments& arguments) {
  try {
    parse_command_line(arguments);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OptionChecks, WholeNumbersAreDecimal) {
  for (const Arguments& numbered :
       {Arguments{"run", "--seed"}, Arguments{"run", "--scene-seed"}, Arguments{"run", "--uavs"},
        Arguments{"run", "--lease"}, Arguments{"run", "--domain"}, Arguments{"run", "--one-process", "--threads"},
        Arguments{"compare", "--uavs"}, Arguments{"compare", "--jobs"}, Arguments{"contest", "--tests"},
        Arguments{"hunt", "--jobs"}, Arguments{"hunt", "--shrink"}, Arguments{"bench", "--sizes"}}) {
    for (const char* wrong : {"010", "0x10", "09", "00"}) {
      Arguments arguments = numbered;
      arguments.emplace_back(wrong);
      const std::string said = said_of(arguments);
      EXPECT_NE(said.find(numbered.back() + ": '" + wrong + "' must be a whole number in decimal"), std::string::npos)
          << numbered[0] << ": " << said;
    }
    Arguments arguments = numbered;
    arguments.emplace_back("10");
    EXPECT_EQ(said_of(arguments), "accepted") << numbered[0] << numbered.back();
  }
  for (const Arguments& list : {Arguments{"compare", "--uavs", "2,010"}, Arguments{"bench", "--sizes", "1,010,20"}}) {
    EXPECT_NE(said_of(list).find("'010' must be a whole number in decimal"), std::string::npos) << said_of(list);
  }
  EXPECT_EQ(parse_command_line({"run", "--seed", "0"}).get<RunOptions>().seed, 0U);
  EXPECT_EQ(parse_command_line({"run", "--duration", "010"}).get<RunOptions>().duration_s, 10.0);
}

TEST(OptionChecks, AFleetWithoutUavsIsRefusedWithAShortMessage) {
  for (const std::string command : {"run", "compare", "hunt", "check-planner"}) {
    Arguments arguments = {command, "--uavs", "0"};
    if (command == "check-planner") arguments.insert(arguments.begin() + 1, "hover");
    const std::string said = said_of(arguments);
    EXPECT_NE(said.find("--uavs: '0' must be a number above 0"), std::string::npos) << command << ": " << said;
    EXPECT_LT(said.size(), 200U) << command << ": " << said;
  }
}

TEST(OptionChecks, ListsWithEmptyItemsAreRefused) {
  for (const Arguments& arguments :
       {Arguments{"compare", "--uavs", "1,,2"}, Arguments{"compare", "--uavs=1,"}, Arguments{"compare", "--uavs", ",1"},
        Arguments{"oracle", "towers", "--clearance", "0.5,,1"}, Arguments{"bench", "--sizes", "1", ",2"},
        Arguments{"hunt", "--without", "a,,b"}, Arguments{"compare", "--scenarios", "towers,", "--uavs", "1"}}) {
    EXPECT_NE(said_of(arguments).find("is empty; write one comma"), std::string::npos) << said_of(arguments);
  }
  for (const Arguments& arguments :
       {Arguments{"compare", "--uavs", "1,2", "--scenarios", "towers"}, Arguments{"bench", "--sizes", "1,2", "5"},
        Arguments{"oracle", "--clearance=0.5,1", "towers"}}) {
    EXPECT_EQ(said_of(arguments), "accepted");
  }
}

TEST(OptionChecks, EmptyValuesOfOptionsAreRefused) {
  for (const Arguments& arguments :
       {Arguments{"run", "--keep-maps="}, Arguments{"run", "--keep-maps=", "towers"}, Arguments{"run", "--record="},
        Arguments{"run", "--view="}, Arguments{"run", "--network="}, Arguments{"run", "--force="},
        Arguments{"run", "--out=", "towers"}, Arguments{"run", "--seed=", "towers"}, Arguments{"run", "--out", ""},
        Arguments{"compose", "--up="}, Arguments{"hunt", "--junit=", "towers"}, Arguments{"bench", "--json="},
        Arguments{"doctor", "--json="}, Arguments{"replay", "a", "--maps="}}) {
    EXPECT_NE(said_of(arguments).find(": must not be empty"), std::string::npos)
        << arguments[0] << ' ' << arguments[1] << ": " << said_of(arguments);
  }
  EXPECT_EQ(said_of({"run", "--keep-maps", "towers"}), "accepted");
  EXPECT_EQ(said_of({"run", "--planner", "exec:fly --height="}), "accepted")
      << "the empty value belongs to the command of the user's program";
}

TEST(OptionChecks, OnlyARegularFileIsWrittenTo) {
  const ScratchDir scratch;
  const std::string file = scratch.path() / "file", pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(check_file_to_write(file), "");
  std::ofstream(file) << "x";
  EXPECT_EQ(check_file_to_write(file), "");
  for (const std::string& wrong : {pipe, scratch.path().string(), std::string("/dev/null")}) {
    EXPECT_NE(check_file_to_write(wrong).find("'" + wrong + "' is not a regular file"), std::string::npos);
    for (const Arguments& arguments : {Arguments{"bench", "--json", wrong}, Arguments{"hunt", "--junit", wrong}}) {
      EXPECT_NE(said_of(arguments).find("is not a regular file"), std::string::npos) << said_of(arguments);
    }
  }
}

TEST(OptionChecks, UnitMinutesMustBePositiveAndNeedAnExecutor) {
  for (const char* wrong : {"nan", "0", "inf"}) {
    EXPECT_NE(said_of({"compare", "--executor", "local", "--unit-minutes", wrong}), "accepted") << wrong;
  }
  EXPECT_NE(said_of({"compare", "--unit-minutes", "3"}).find("--unit-minutes requires --executor"), std::string::npos);
}

TEST(OptionChecks, AMistypedCommandIsNamed) {
  EXPECT_NE(said_of({"rnu", "towers"}).find("there is no command 'rnu'; did you mean 'run'?"), std::string::npos);
  EXPECT_NE(said_of({"frobnicate"}).find("there is no command 'frobnicate'; known are: "), std::string::npos);
}

TEST(OptionChecks, PathsThatAreNotInUtf8AreRefused) {
  const auto said = [](const Arguments& arguments) -> std::string {
    try {
      check_paths(arguments);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(said({"run", "--out", "caf\xc3\xa9 'x'\n"}), "");
  EXPECT_NE(said({"run", "--out=caf\xe9"}).find("--out=caf\xe9"), std::string::npos)
      << "the message quotes the path, which is in Latin-1";
}

TEST(OptionChecks, AMissingCurrentFolderIsReported) {
  const ScratchDir scratch;
  const std::filesystem::path before = std::filesystem::current_path(), gone = scratch.path() / "gone";
  std::filesystem::create_directory(gone);
  std::filesystem::current_path(gone);
  std::filesystem::remove(gone);
  EXPECT_THROW(check_paths({"run"}), InputError);
  std::filesystem::current_path(before);
  EXPECT_NO_THROW(check_paths({"run"}));
}

}  // namespace
}  // namespace skein::cli
