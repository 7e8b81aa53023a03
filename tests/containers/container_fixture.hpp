// What the tests of fleets in containers share: a real engine and the images that are there. Their own programs fly
// where they are those of this build (.ci/containers makes such images); else those of the build folder are mounted
// over them. Without an engine a test is skipped and says what it has not tested; REQUIRE_ENGINE=1 makes it fail.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fleet_fixture.hpp"

namespace skein::test {

/// What a shell's command said, on both outputs, and how it ended.
struct Answer {
  int code = -1;
  std::string text;
};
Answer shell(const std::string& command);

/// Whether what has not been tested is a failure.
bool engine_is_required();

/// The parts of a text between white space.
std::vector<std::string> words(const std::string& text);

/// At the end of each test no container, network or volume of its fleets may be left.
class Containers : public FleetTest {
 protected:
  /// What a fleet flies that is compared with another: digest and score.
  struct Flight {
    std::string digest;
    Json score;
    bool operator==(const Flight&) const = default;
  };
  friend void PrintTo(const Flight& flight, std::ostream* out) { *out << flight.digest << ", score " << flight.score; }

  void SetUp() override;
  void TearDown() override;

  static Arguments arguments(const std::string& planner = "patrol", const std::string& duration_s = "60",
                             const Arguments& more = {});
  /// What makes a fleet fly the programs of this build: nothing where the images have them.
  static Arguments programs_of_this_build();
  /// `skein compose ... --up`, with the programs of this build.
  SkeinRun& start_up(const std::string& name, Arguments arguments, const Environment& environment = {});
  /// The same to its end, which must be a good one.
  SkeinRun& up(const std::string& name, const Arguments& arguments);
  /// What the same arguments give without containers.
  Flight alone(const Arguments& arguments);
  static Flight flight_of(const SkeinRun& run);
  static void expect_whole(const SkeinRun& run);

  /// The fleet's name in the engine; empty before there is a container.
  static std::string project(const SkeinRun& run);
  /// Waits until there is such a container. @returns its id
  static std::string container(const SkeinRun& run, const std::string& program);
  /// What lies about of a project: containers, networks and volumes.
  static std::string left_of(const std::string& project);
  /// A project that the test has made by itself, which is taken down at its end.
  void adopt(const std::string& project) { adopted_.push_back(project); }
  /// Waits until the fleet has flown for some simulated seconds. @returns the container of `program`
  static std::string flying(SkeinRun& run, const std::string& program);
  static std::string log_of(const SkeinRun& run, const std::string& program);

 private:
  std::vector<SkeinRun*> fleets_;
  std::vector<std::string> adopted_;
};

}  // namespace skein::test
