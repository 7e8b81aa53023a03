#include "cli/film/film.hpp"

#include <gtest/gtest.h>

#include "core/types.hpp"

namespace skein::cli {
namespace {

TEST(FilmTimes, AreSpreadOverTheFlightAndEndWithIt) {
  FilmOptions options;
  options.fps = 10;
  options.seconds = 4.0;
  const FilmTimes times(options, 100.0, 300.0);
  ASSERT_EQ(times.size(), 41U);
  EXPECT_EQ(times[0], 100.0);
  EXPECT_DOUBLE_EQ(times[1], 105.0);
  EXPECT_DOUBLE_EQ(times[20], 200.0);
  EXPECT_EQ(times[40], 300.0);
}

TEST(FilmTimes, FollowTheRequestedSpeed) {
  FilmOptions options;
  options.fps = 25;
  options.speed = 8.0;
  const FilmTimes times(options, 0.0, 60.1);
  EXPECT_DOUBLE_EQ(times[25], 8.0);
  EXPECT_EQ(times[times.size() - 1], 60.1);
  EXPECT_LT(times[times.size() - 2], 60.1);
}

TEST(FilmTimes, TakeHalfAMinuteByDefault) {
  EXPECT_EQ(FilmTimes({}, 0.0, 600.0).size(), static_cast<std::size_t>(30 * 25 + 1));
}

TEST(FilmTimes, RefuseValuesThatMakeNoFilm) {
  EXPECT_THROW(FilmTimes({}, 60.0, 60.0), InputError);
  EXPECT_THROW(FilmTimes({}, 0.0, 0.0), InputError);
  FilmOptions endless;
  endless.speed = 0.01;
  EXPECT_THROW(FilmTimes(endless, 0.0, 600.0), InputError);
}

TEST(FileUrl, PercentEncodesCharactersWithAMeaningInAUrl) {
  EXPECT_EQ(file_url("/tmp/a-b_c.html"), "file:///tmp/a-b_c.html");
  EXPECT_EQ(file_url("/tmp/50 %#?.html"), "file:///tmp/50%20%25%23%3F.html");
}

}  // namespace
}  // namespace skein::cli
