// The fault file that repeats a run in which somebody made things fail.
#include "cli/run/by_hand.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

TEST(RepeatedByHand, AFileThatTheRunWouldRemoveIsRefused) {
  const fs::path dir = fs::temp_directory_path() / ("skein_by_hand_" + std::to_string(::getpid()));
  fs::create_directories(dir / "other");
  std::ofstream(dir / "by-hand.yaml") << "faults: []\n";
  EXPECT_THROW(check_outlasts(dir / "by-hand.yaml", dir), InputError);
  EXPECT_THROW(check_outlasts(dir / "other" / ".." / "by-hand.yaml", dir), InputError);
  EXPECT_NO_THROW(check_outlasts(dir / "by-hand.yaml", dir / "other"));
  EXPECT_NO_THROW(check_outlasts(dir / "my.yaml", dir)) << "no file of a run's: it stays";
  EXPECT_NO_THROW(check_outlasts(dir / "by-hand.yaml", dir / "not_there_yet"));
  EXPECT_NO_THROW(check_outlasts(std::nullopt, dir));
  fs::remove_all(dir);
}

}  // namespace
}  // namespace skein::cli
