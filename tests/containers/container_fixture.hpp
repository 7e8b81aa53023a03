// The fixture of the tests of fleets in containers, with a real Docker engine and the images on this machine. If the
// images hold the programs of this build (.ci/containers makes such images), the fixture uses these; otherwise it
// mounts the programs of the build folder over them. Without an engine, a test is skipped with a message that names
// what was not tested; with REQUIRE_ENGINE=1, it fails.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fleet_fixture.hpp"

namespace skein::test {

/// Output of a shell command (stdout and stderr) and its exit code; -1 if a signal ended it.
struct Answer {
  int code = -1;
  std::string text;
};
Answer shell(const std::string& command);

/// Whether a test that cannot run here fails instead of being skipped.
bool engine_is_required();

/// The parts of a text between white space.
std::vector<std::string> words(const std::string& text);

/// After each test, checks that the test's fleets have left no container, network or volume, and removes what is left.
class Containers : public FleetTest {
 protected:
  /// The part of a result that must be the same in and out of containers: digest and score.
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
  /// Options that make a fleet fly the programs of this build; empty if the images hold these programs.
  static Arguments programs_of_this_build();
  /// `skein compose ... --up`, with the programs of this build.
  SkeinRun& start_up(const std::string& name, Arguments arguments, const Environment& environment = {});
  /// start_up(), then waits for the end; the exit code must be 0.
  SkeinRun& up(const std::string& name, const Arguments& arguments);
  /// The flight that the same arguments give without containers.
  Flight alone(const Arguments& arguments);
  static Flight flight_of(const SkeinRun& run);
  static void expect_whole(const SkeinRun& run);

  /// Name of the fleet's Docker Compose project; empty while compose.log does not name it yet.
  static std::string project(const SkeinRun& run);
  /// Waits until the container of `program` runs. @returns its id; empty after a timeout
  static std::string container(const SkeinRun& run, const std::string& program);
  /// Ids of the containers, networks and volumes that a project has left.
  static std::string left_of(const std::string& project);
  /// Registers a project that the test itself has created; TearDown() removes it.
  void adopt(const std::string& project) { adopted_.push_back(project); }
  /// Waits until the fleet has flown for some simulated seconds. @returns the container of `program`
  static std::string flying(SkeinRun& run, const std::string& program);
  static std::string log_of(const SkeinRun& run, const std::string& program);

 private:
  std::vector<SkeinRun*> fleets_;
  std::vector<std::string> adopted_;
};

}  // namespace skein::test
