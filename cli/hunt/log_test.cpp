// What a hunt has flown is taken up again whole, or refused: no line is lost without a word.
#include "cli/hunt/log.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "cli/run/preflight.hpp"
#include "cli/testing/fake_programs.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

const Json kHuntSettings = {{"seed", 1}, {"scenario", "towers"}};

TrialOutcome some_outcome(double score) {
  TrialOutcome outcome;
  outcome.digest = "d";
  outcome.score = score;
  outcome.began_s = {std::nullopt, 2.0};
  outcome.states = {1, 2, 3};
  return outcome;
}

class HuntLogFile : public testing::Test {
 protected:
  HuntLogFile() {
    HuntLog log(dir_, kHuntSettings, false);
    for (std::size_t i = 0; i < kCases; ++i) log.add(i, "flight " + std::to_string(i), some_outcome(double(i)));
    text_ = read_text(file_);
  }
  /// The cases that are there when it goes on.
  std::size_t cases() const {
    const HuntLog log(dir_, kHuntSettings, false);
    return log.outcomes().size();
  }
  std::string refusal() const {
    try {
      HuntLog(dir_, kHuntSettings, false);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  static constexpr std::size_t kCases = 6;
  const ScratchDir scratch_;
  const fs::path dir_ = scratch_.path() / "hunt", file_ = dir_ / "log.jsonl";
  std::string text_;
};

TEST_F(HuntLogFile, WhatWasFlownIsTakenUp) {
  EXPECT_EQ(cases(), kCases);
  EXPECT_EQ(read_text(file_), text_);
}

TEST_F(HuntLogFile, WhatAKillCutOffAtTheEndGoesAndTheRestStays) {
  const std::size_t begin_of_last = text_.rfind('\n', text_.size() - 2) + 1;
  for (std::size_t size = begin_of_last; size < text_.size(); ++size) {
    write_text(file_, text_.substr(0, size));
    ASSERT_EQ(cases(), kCases - 1) << size;
    ASSERT_EQ(read_text(file_), text_.substr(0, begin_of_last));
  }
  HuntLog(dir_, kHuntSettings, false).add(kCases - 1, "again", some_outcome(1.0));
  EXPECT_EQ(cases(), kCases);
}

TEST_F(HuntLogFile, ADamagedLineIsRefusedAndNamed) {
  std::mt19937_64 random(1);
  for (std::size_t line = 1; line <= kCases; ++line) {
    std::size_t begin = 0;
    for (std::size_t i = 1; i < line; ++i) begin = text_.find('\n', begin) + 1;
    const std::size_t length = text_.find('\n', begin) - begin;
    for (const std::string& instead :
         {std::string("{}"), text_.substr(begin, 1 + random() % (length - 1)), std::string(length, '\0'),
          std::string("{\"case\": -1, \"flown\": \"x\", \"outcome\": {}}")}) {
      std::string damaged = text_;
      write_text(file_, damaged.replace(begin, length, instead));
      const std::string said = refusal();
      EXPECT_NE(said.find(file_.string() + ":" + std::to_string(line) + ": damaged"), std::string::npos) << said;
      EXPECT_EQ(read_text(file_), damaged) << "it stays as it is";
    }
  }
  write_text(file_, text_);
  write_text(dir_ / "hunt.json", "{\"seed\": 1,");
  EXPECT_NE(refusal().find("hunt.json: damaged"), std::string::npos) << refusal();
  EXPECT_EQ(HuntLog(dir_, kHuntSettings, true).outcomes().size(), 0U) << "begun anew, as it was asked to";
}

}  // namespace
}  // namespace skein::cli
