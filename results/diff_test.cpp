#include "results/diff.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"
#include "results/testing/scratch.hpp"

namespace skein::results {
namespace {

class RunDiff : public ::testing::Test {
 protected:
  RunDiff() {
    std::filesystem::create_directory(a_);
    std::filesystem::create_directory(b_);
    write_text(a_ / "digests.csv", kRun);
  }

  std::optional<RunDifference> difference_to(const std::string& b) {
    write_text(b_ / "digests.csv", b);
    return first_difference(a_, b_);
  }

  static constexpr const char* kHeader = "k,digest,alpha.position,alpha.alive,radio\n";
  const std::string kRun = std::string(kHeader) + "0,aa,1,2,3\n1,bb,4,5,6\n2,cc,7,8,9\n";
  Scratch scratch_;
  std::filesystem::path a_ = scratch_.path() / "a", b_ = scratch_.path() / "b";
};

TEST_F(RunDiff, EqualRunsHaveNoDifference) { EXPECT_FALSE(difference_to(kRun)); }

TEST_F(RunDiff, NamesStepTimeEntityAndFields) {
  const auto difference = difference_to(std::string(kHeader) + "0,aa,1,2,3\n1,xx,0,5,0\n2,yy,0,0,0\n");
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->step, 1);
  EXPECT_DOUBLE_EQ(difference->time_s, 0.05);
  EXPECT_EQ(difference->fields, (std::vector<std::string>{"alpha position", "radio"}));
}

TEST_F(RunDiff, TimeFollowsTheRunsExchangePeriod) {
  write_text(a_ / "result.json", R"({"exchange_period_s": 0.1})");
  EXPECT_DOUBLE_EQ(difference_to(std::string(kHeader) + "0,aa,1,2,3\n1,xx,0,5,0\n")->time_s, 0.1);
}

TEST_F(RunDiff, ADifferenceOfOnlyTheRunningDigestIsReported) {
  EXPECT_EQ(difference_to(std::string(kHeader) + "0,zz,1,2,3\n")->fields, std::vector<std::string>{"digest"});
}

TEST_F(RunDiff, ADifferenceOfLengthsIsReported) {
  const auto shorter = difference_to(std::string(kHeader) + "0,aa,1,2,3\n1,bb,4,5,6\n");
  ASSERT_TRUE(shorter);
  EXPECT_EQ(shorter->step, 2);
  EXPECT_EQ(shorter->fields, std::vector<std::string>{"end: the second run stops before"});
  const auto longer = difference_to(kRun + "3,dd,1,1,1\n");
  ASSERT_TRUE(longer);
  EXPECT_EQ(longer->step, 3);
  EXPECT_EQ(longer->fields, std::vector<std::string>{"end: the first run stops before"});
}

TEST_F(RunDiff, ALineThatAnAbortCutOffEndsTheRun) {
  EXPECT_FALSE(difference_to(kRun + "3,dd,1"));
  EXPECT_FALSE(difference_to(kRun + "3,dd,1,1,1"));
}

TEST_F(RunDiff, ALastLineThatEndsWithANewlineMustBeComplete) {
  EXPECT_THROW(difference_to(kRun + "3,dd,1\n"), InputError);
  EXPECT_THROW(difference_to(std::string(kHeader) + "0,aa,1,2,3\n1,bb,4,5,6\n2,cc,7,8\n"), InputError);
}

TEST_F(RunDiff, DifferentColumnsAreADifference) {
  const auto difference = difference_to("k,digest,beta.position,radio\n0,aa,1,3\n");
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->fields,
            (std::vector<std::string>{"alpha position (only in the first run)", "alpha alive (only in the first run)",
                                      "beta position (only in the second run)"}));
}

TEST_F(RunDiff, AMissingOrMalformedDigestFileIsRefused) {
  EXPECT_THROW(first_difference(a_, b_), InputError);
  EXPECT_THROW(difference_to("something,else\n"), InputError);
  EXPECT_THROW(difference_to(""), InputError);
  EXPECT_THROW(difference_to(std::string(kHeader) + "0,aa,1,2\n1,bb,4,5,6\n2,cc,7,8,9\n"), InputError);
}

TEST_F(RunDiff, TheReasonWhyARunCannotBeReadIsReported) {
  const auto complaint = [&](const std::filesystem::path& b) -> std::string {
    try {
      first_difference(a_, b);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const std::filesystem::path circle = scratch_.path() / "circle";
  std::filesystem::create_symlink(circle, circle);
  EXPECT_EQ(complaint(circle),
            (circle / "digests.csv").string() + ": cannot be read (Too many levels of symbolic links)");
  EXPECT_EQ(complaint(scratch_.path() / "none"), (scratch_.path() / "none").string() + ": there is no such folder");
  EXPECT_NE(complaint(b_).find("no digests.csv there"), std::string::npos) << complaint(b_);
}

}  // namespace
}  // namespace skein::results
