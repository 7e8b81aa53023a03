#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "skein_ros/planner.hpp"
#include "skein_ros/step.h"
#include "step_library.hpp"

namespace skein_ros {
namespace {

constexpr const char* kEntered = "SKEIN_STEP_ENTERED";

/// The path of libskein_step.so, which lies beside this library.
std::filesystem::path step_library() {
  Dl_info info = {};
  ::dladdr(reinterpret_cast<const void*>(&enter_step), &info);
  return std::filesystem::absolute(info.dli_fname).parent_path() / "libskein_step.so";
}

}  // namespace

bool is_member() {
  const auto answer = step_function<decltype(&skein_ros_is_member)>("skein_ros_is_member");
  return answer != nullptr && answer();
}

void fail(const std::string& why) {
  std::cerr << "[skein_ros] " + why + "\n";
  std::fflush(nullptr);
  ::_exit(3);
}

std::string uav_of_environment() {
  const char* const uav = std::getenv("SKEIN_UAV");
  if (uav == nullptr || *uav == '\0') {
    throw std::runtime_error(
        "SKEIN_UAV is not set: start this planner with skein run --planner UAV=ros:PACKAGE/EXECUTABLE");
  }
  return uav;
}

void enter_step() {
  if (step_function<void*>("skein_ros_is_member") != nullptr || std::getenv("SKEIN_UAV") == nullptr) return;
  if (std::getenv(kEntered) != nullptr) fail("cannot load " + step_library().string() + " by LD_PRELOAD");
  const char* const loaded = std::getenv("LD_PRELOAD");
  const std::string libraries = step_library().string() + (loaded == nullptr ? "" : " " + std::string(loaded));
  ::setenv("LD_PRELOAD", libraries.c_str(), 1);
  ::setenv(kEntered, "1", 1);
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv("/proc/self/exe", argv.data());
  fail("cannot start this program again with " + step_library().string());
}

int run(int argc, char** argv, const std::function<std::shared_ptr<rclcpp::Node>()>& make) {
  enter_step();
  rclcpp::init(argc, argv);
  try {
    rclcpp::spin(make());
  } catch (const std::exception& error) {
    fail(error.what());
  }
  rclcpp::shutdown();
  return 0;
}

}  // namespace skein_ros
