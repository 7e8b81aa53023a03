// Maps over time: computed afterwards for a run that did not keep them, equal to those that it would have kept, and
// shown on the page of its replay.
#include <csignal>
#include <fstream>

#include "view_fixture.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const Arguments kMappedFlight = {"towers", "--planner",     "kios",        "--duration",
                                 "60",     "--one-process", "--no-oracle", "--no-report"};

class MapsInTime : public BrowserTest {
 protected:
  static fs::path maps_of(const fs::path& dir, const std::string& uav) { return dir / ("maps-" + uav + ".mcap"); }
  ChildProcess& replay(const Arguments& arguments, int exit_code = 0) {
    ChildProcess& command = skein(joined({"replay"}, arguments));
    EXPECT_EQ(command.wait().code, exit_code) << command.err() << command.out();
    return command;
  }
};

TEST_F(MapsInTime, AreComputedAfterwardsAsTheRunWouldHaveKeptThem) {
  const SkeinRun& done = run("done", kMappedFlight);
  const SkeinRun& kept = run("kept", joined(kMappedFlight, {"--keep-maps"}));
  EXPECT_EQ(done.digest(), kept.digest());
  EXPECT_FALSE(fs::exists(maps_of(done.dir(), "jurong"))) << "the run kept maps without --keep-maps";

  ChildProcess& page = start_program("page", {program("skein"), "replay", done.dir(), "--maps"});
  ASSERT_TRUE(eventually([&] { return !door_in(page.out()).empty(); })) << page.err();
  for (const std::string& uav : kFleet) {
    EXPECT_FALSE(text_of(maps_of(done.dir(), uav)).empty()) << uav;
    EXPECT_EQ(text_of(maps_of(done.dir(), uav)), text_of(maps_of(kept.dir(), uav))) << uav;
  }
  EXPECT_FALSE(fs::exists(done.dir() / "replay-maps"));
  look("maps", door_in(page.out()), done.dir());
  page.signal(SIGINT);
  EXPECT_EQ(page.wait().code, 0) << page.err();

  const fs::path file = folder() / "flight.html";
  EXPECT_EQ(replay({done.dir(), "--maps", "--export", file}).err().find("flown again"), std::string::npos)
      << "maps that exist already must not be computed again";
  look("maps", file, done.dir());
}

TEST_F(MapsInTime, AreNotShownIfTheyWouldBeThoseOfAnotherRun) {
  const fs::path faults = write("faults.yaml", "faults:\n  - {at_s: 20, until_s: 25, kill: jurong}\n");
  const SkeinRun& done = run("done", {"towers", "--planner", "kios", "--duration", "40", "--one-process", "--no-oracle",
                                      "--no-report", "--faults", faults});
  write("faults.yaml", "faults:\n  - {at_s: 10, until_s: 15, kill: jurong}\n");
  const fs::path file = folder() / "flight.html";
  EXPECT_NE(replay({done.dir(), "--maps", "--export", file}).err().find("maps of another run"), std::string::npos);
  EXPECT_FALSE(fs::exists(maps_of(done.dir(), "raffles")) || fs::exists(done.dir() / "replay-maps"));

  write("faults.yaml", "faults:\n  - {at_s: 20, until_s: 25, kill: jurong}\n");
  replay({done.dir(), "--maps", "--export", file, "--force"});
  EXPECT_TRUE(fs::exists(maps_of(done.dir(), "jurong")));
  EXPECT_TRUE(fs::exists(done.dir() / "maps-jurong.2.mcap")) << "the maps of the restarted program are missing";

  const Arguments again = {"--maps", "--export", file, "--force"};
  std::ofstream(maps_of(done.dir(), "raffles")) << "damaged";
  EXPECT_NE(replay(joined({done.dir()}, again)).err().find("flown again"), std::string::npos);
  EXPECT_GT(fs::file_size(maps_of(done.dir(), "raffles")), 1000U);

  fs::remove(maps_of(done.dir(), "raffles"));
  for (const std::string& uav : kFleet) fs::remove(maps_of(done.dir(), uav));
  fs::remove(done.dir() / "recording.mcap");
  EXPECT_NE(replay(joined({done.dir()}, again), 2).err().find("recording.mcap"), std::string::npos);
}

}  // namespace
}  // namespace skein::test
