// The options of a replay in a browser, and of the maps that a run keeps for it.
#include "cli/view_options.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cli/command_line.hpp"
#include "cli/compose_options.hpp"
#include "cli/replay_command.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

template <class Options>
Options read(const std::vector<std::string>& arguments) {
  return parse_command_line(arguments).get<Options>();
}

TEST(ViewOptions, ReplayReadsAllItsOptions) {
  const auto served = read<ReplayOptions>({"replay", "a", "b", "--view", "8080"});
  EXPECT_TRUE(served.run == "a" && served.other == "b" && served.at == "8080");
  EXPECT_FALSE(served.exported || served.force || served.maps);
  EXPECT_TRUE(read<ReplayOptions>({"replay", "a", "--maps", "--export", "a.html"}).maps);
  const auto film = read<ReplayOptions>({"replay", "a", "--export", "a.mp4", "--force", "--fps", "10", "--seconds",
                                         "12.5", "--from-address", "#uav=changi"});
  EXPECT_TRUE(film.exported == "a.mp4" && film.force && !film.other && !film.film.speed);
  EXPECT_TRUE(film.film.fps == 10 && film.film.seconds == 12.5);
  EXPECT_EQ(film.film.address, "#uav=changi");
  EXPECT_EQ(read<ReplayOptions>({"replay", "a", "--export", "a.mp4", "--speed", "8"}).film.speed, 8.0);
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--fps", "10"}, std::vector<std::string>{"--force"},
        std::vector<std::string>{"--export", "a.mp4", "--fps", "0"},
        std::vector<std::string>{"--export", "a.mp4", "--seconds", "3", "--speed", "2"},
        std::vector<std::string>{"--export", "a.html", "--view", "1"}, std::vector<std::string>{"b", "--maps"}}) {
    std::vector<std::string> words = {"replay", "a"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_THROW(parse_command_line(words), InputError) << wrong.back();
  }
}

TEST(ViewOptions, APageRefusesTheOptionsOfFilms) {
  using Words = std::vector<std::string>;
  for (const Words& of_film :
       {Words{"--fps", "50"}, Words{"--seconds", "3"}, Words{"--speed", "2"}, Words{"--from-address", "#t=1"}}) {
    Words words = {"replay", "no_run", "--export", "a.html"};
    words.insert(words.end(), of_film.begin(), of_film.end());
    std::ostringstream out, err;
    try {
      replay_run(read<ReplayOptions>(words), {out, err, false});
      ADD_FAILURE() << of_film[0];
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("are for a film"), std::string::npos) << error.what();
    }
  }
}

TEST(ViewOptions, MapsAreKeptOnlyIfTheUserAsksForThem) {
  EXPECT_EQ(read<RunOptions>({"run"}).keep_maps_s, std::nullopt);
  EXPECT_EQ(read<RunOptions>({"run", "--keep-maps", "cranes"}).keep_maps_s, 10.0);
  EXPECT_EQ(read<RunOptions>({"run", "--keep-maps", "cranes"}).scenario, "cranes");
  EXPECT_EQ(read<RunOptions>({"run", "--keep-maps=1"}).keep_maps_s, 1.0);
  EXPECT_EQ(read<RunOptions>({"run", "--keep-maps=2.5"}).keep_maps_s, 2.5);
  EXPECT_EQ(read<ComposeOptions>({"compose", "--keep-maps=3600"}).run.keep_maps_s, 3600.0);
  for (const char* wrong : {"0.5", "3601", "nan", "often", "0x10", "-10"}) {
    EXPECT_THROW(parse_command_line({"run", std::string("--keep-maps=") + wrong}), InputError) << wrong;
  }
}

TEST(ViewOptions, TimesAndSpeedsAreNumbersInTheirRange) {
  EXPECT_EQ(read<RunOptions>({"run", "--view", "--pause-at", "0"}).view.pause_at_s, 0.0);
  for (const char* wrong : {"nan", "-1", "inf", "1e7", "0x10"}) {
    EXPECT_THROW(parse_command_line({"run", "--view", "--pause-at", wrong}), InputError) << wrong;
    EXPECT_THROW(parse_command_line({"replay", "a", "--export", "a.mp4", "--seconds", wrong}), InputError) << wrong;
    EXPECT_THROW(parse_command_line({"replay", "a", "--export", "a.mp4", "--speed", wrong}), InputError) << wrong;
  }
}

}  // namespace
}  // namespace skein::cli
