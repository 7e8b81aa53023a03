#include "container_fixture.hpp"
#include "tests/support/places.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

namespace skein::test {
namespace {

namespace fs = std::filesystem;

/// Why fleets cannot fly in containers on this machine; empty: they can.
const std::string& obstacle() {
  static const std::string kObstacle = [] {
    if (shell("docker version").code != 0) return std::string("no Docker engine answers");
    if (shell("docker compose version").code != 0 && shell("docker-compose version").code != 0) {
      return std::string("there is no docker-compose");
    }
    for (const char* image : {"skein", "skein-agent"}) {
      if (shell(std::string("docker image inspect ") + image).code != 0) {
        return std::string("the engine has no image '") + image + "' (docker/Dockerfile)";
      }
    }
    return std::string();
  }();
  return kObstacle;
}

/// Build id that the linker gave a program; empty if the file is not a program.
std::string build_id(const std::string& file) {
  return shell("readelf --notes " + file + " | sed -n 's/.*Build ID: //p'").text;
}

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr && std::string(value) == "1";
}

/// Whether both images hold the programs of this build, installed from its packages. With IMAGES_OF_THE_SOURCES=1, the
/// caller states that the images' programs were compiled from the same sources, so the images may be used, too.
bool images_are_of_this_build() {
  if (is_set("IMAGES_OF_THE_SOURCES")) return true;
  static const bool kAre = [] {
    for (const auto& [image, program] : {std::pair("skein", "sim_server"), {"skein-agent", "uav_agent"}}) {
      const std::string copy = fs::temp_directory_path() / ("skein-image-" + std::to_string(::getpid()));
      const Answer copied = shell(std::string("id=$(docker create ") + image + ") && docker cp $id:/usr/bin/" +
                                  program + " " + copy + "; code=$?; docker rm $id; exit $code");
      const std::string theirs = copied.code == 0 ? build_id(copy) : "";
      fs::remove(copy);
      if (theirs.empty() || theirs != build_id(build_path("bin/") + program)) return false;
    }
    return true;
  }();
  return kAre;
}

std::string labelled(const std::string& project) {
  return " --filter label=com.docker.compose.project=" + project + " --quiet";
}

void remove_project(const std::string& project) {
  for (const auto& [list, remove] : {std::pair("docker ps --all", "docker rm --force"),
                                     {"docker network ls", "docker network rm"},
                                     {"docker volume ls", "docker volume rm"}}) {
    shell(list + labelled(project) + " | xargs --no-run-if-empty " + remove);
  }
}

}  // namespace

bool engine_is_required() { return is_set("REQUIRE_ENGINE"); }

Answer shell(const std::string& command) {
  Answer answer;
  FILE* pipe = ::popen(("{ " + command + "\n} 2>&1").c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    answer.text.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) answer.code = WEXITSTATUS(status);
  while (!answer.text.empty() && answer.text.back() == '\n') answer.text.pop_back();
  return answer;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

void Containers::SetUp() {
  // The programs in the containers, under another user, read the scenario and write beside it.
  fs::permissions(folder(), fs::perms(0755));
  if (obstacle().empty()) return;
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string untested = obstacle() + ": not tested is that " + test->name() + " (fleets in containers)";
  if (engine_is_required()) FAIL() << untested;
  GTEST_SKIP() << untested;
}

void Containers::TearDown() {
  std::vector<std::string> projects = adopted_;
  for (SkeinRun* run : fleets_) {
    if (run->skein().ended()) {
      if (const std::string name = project(*run); !name.empty()) {
        EXPECT_EQ(left_of(name), "") << run->err();
        projects.push_back(name);
      }
    } else {  // the test failed half-way
      run->skein().signal(SIGINT);
      run->skein().wait();
      projects.push_back(project(*run));
    }
  }
  for (const std::string& name : projects) {
    if (!name.empty() && !left_of(name).empty()) remove_project(name);
  }
  expect_nothing_left();
}

Arguments Containers::arguments(const std::string& planner, const std::string& duration_s, const Arguments& more) {
  Arguments all = {"towers", "--planner", planner, "--duration", duration_s, "--no-oracle"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Arguments Containers::programs_of_this_build() {
  return images_are_of_this_build() ? Arguments{} : Arguments{"--build-folder", build_path()};
}

SkeinRun& Containers::start_up(const std::string& name, Arguments arguments, const Environment& environment) {
  const bool named = std::ranges::find(arguments, "--build-folder") != arguments.end();
  const Arguments more = named ? Arguments{} : programs_of_this_build();
  arguments.push_back("--up");
  arguments.insert(arguments.end(), more.begin(), more.end());
  SkeinRun& run = start(name, arguments, environment, "compose");
  fleets_.push_back(&run);
  return run;
}

SkeinRun& Containers::up(const std::string& name, const Arguments& arguments) {
  SkeinRun& run = start_up(name, arguments);
  EXPECT_EQ(run.exit_code(), 0) << run.err();
  return run;
}

Containers::Flight Containers::alone(const Arguments& arguments) {
  static std::map<Arguments, Flight> known;
  const auto found = known.find(arguments);
  if (found != known.end()) return found->second;
  static int number = 0;
  const Flight flight = flight_of(run("alone" + std::to_string(++number), arguments));
  EXPECT_NE(flight.digest, "none");
  return known[arguments] = flight;
}

Containers::Flight Containers::flight_of(const SkeinRun& run) { return {run.digest(), run.result()["score"]}; }

void Containers::expect_whole(const SkeinRun& run) {
  const Json result = run.result();
  EXPECT_EQ(result["status"], "completed");
  EXPECT_TRUE(result["lost_members"].empty()) << result["lost_members"];
  EXPECT_TRUE(result["deterministic"]);
  EXPECT_TRUE(result["warnings"].empty()) << result["warnings"];
  expect_complete_result(run);
}

std::string Containers::project(const SkeinRun& run) {
  std::smatch match;
  const std::string log = text_of(run.dir() / "compose.log");
  return std::regex_search(log, match, std::regex("skein-[0-9a-f]{8}")) ? match[0].str() : "";
}

std::string Containers::container(const SkeinRun& run, const std::string& program) {
  std::string id;
  eventually([&] {
    const std::string name = project(run);
    if (name.empty()) return false;
    const Answer answer = shell("docker ps" + labelled(name) + " --filter label=com.docker.compose.service=" + program);
    if (answer.code == 0) id = answer.text;
    return !id.empty();
  });
  return id;
}

std::string Containers::left_of(const std::string& project) {
  return shell("docker ps --all" + labelled(project) + "; docker network ls" + labelled(project) +
               "; docker volume ls" + labelled(project))
      .text;
}

std::string Containers::flying(SkeinRun& run, const std::string& program) {
  const std::string id = container(run, program);
  EXPECT_TRUE(run.wait_until_flying()) << run.err();
  return id;
}

std::string Containers::log_of(const SkeinRun& run, const std::string& program) {
  return text_of(run.dir() / (program + ".log"));
}

}  // namespace skein::test
