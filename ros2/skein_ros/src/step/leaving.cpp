#include "leaving.hpp"

#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "say.hpp"

namespace skein_ros {
namespace {

constexpr int kMostWaitsAfterEnd = 2000;

bool is_secured() {
  const char* const enabled = std::getenv("ROS_SECURITY_ENABLE");
  return enabled != nullptr && std::string(enabled) == "true";
}

/// Whether this program runs an interpreter of Python, which exports this function of its API.
bool is_python() {
  const auto initialized = reinterpret_cast<int (*)()>(::dlsym(RTLD_DEFAULT, "Py_IsInitialized"));
  return initialized != nullptr && initialized() != 0;
}

/// 1 is the exit code of a Python program that does not catch an exception, as that of rclpy.spin() at the run's end.
void forgive_exception(int code, void*) {
  if (code == 1) exit_at_once(0);
}

/// In a secured fleet, Fast DDS destroys its last participant together with the static objects. The participant would
/// then encrypt its last messages although OpenSSL is gone, so the process ends before.
void end_before_static_objects(int code, void*) { exit_at_once(code); }

}  // namespace

void exit_at_once(int code) {
  std::fflush(nullptr);
  ::_exit(code);
}

void end_node() {
  struct sigaction action = {};
  ::sigaction(SIGTERM, nullptr, &action);
  if (action.sa_handler == SIG_DFL) exit_at_once(0);
  // The handler that is registered last runs first, before those of the node.
  if (is_secured()) ::on_exit(end_before_static_objects, nullptr);
  if (is_python()) ::on_exit(forgive_exception, nullptr);
  ::raise(SIGTERM);
}

void count_work_after_end() {
  static int waits = 0;
  if (++waits > kMostWaitsAfterEnd) exit_at_once(0);
  sleep_really(std::chrono::milliseconds(1));
}

void start_again() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  constexpr unsigned kCloseOnExec = 1U << 2;
  ::syscall(SYS_close_range, 3U, ~0U, kCloseOnExec);
  ::execv("/proc/self/exe", argv.data());
  fail("cannot start again after a stop");
}

void sleep_really(std::chrono::nanoseconds duration) {
  struct timespec left = {static_cast<time_t>(duration.count() / 1'000'000'000),
                          static_cast<long>(duration.count() % 1'000'000'000)};
  while (::syscall(SYS_clock_nanosleep, CLOCK_MONOTONIC, 0, &left, &left) != 0) {
  }
}

}  // namespace skein_ros
