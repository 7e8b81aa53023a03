// Clocks and sleeps of a node in the lock-step. Every clock of ROS shows simulated time (also steady ones: a wall timer
// fires at the same step in each run), and so do C++ clocks and sleeps in the node's own code.
#include <dlfcn.h>
#include <rcl/timer.h>
#include <rcutils/time.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <map>
#include <string>

#include "leaving.hpp"
#include "real_rmw.hpp"
#include "turns.hpp"

namespace {

using skein_ros::in_node_code;
using skein_ros::simulated_now;
using skein_ros::sleep_until_simulated;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::int64_t real_now(clockid_t clock) {
  struct timespec now = {};
  ::clock_gettime(clock, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

std::int64_t now_of(clockid_t clock) {
  std::int64_t now_ns = 0;
  return simulated_now(&now_ns) ? now_ns : real_now(clock);
}

/// Calls from the middleware and from the standard library use the wall clock, also when the node has called these.
bool is_of_middleware(const void* address) {
  static std::map<const void*, bool> known;  // by library; only the node's thread calls this
  Dl_info info = {};
  if (::dladdr(address, &info) == 0 || info.dli_fname == nullptr) return true;
  const auto [entry, is_new] = known.try_emplace(info.dli_fbase, false);
  if (!is_new) return entry->second;
  const std::string path = info.dli_fname, name = path.substr(path.rfind('/') + 1);
  constexpr std::array kMiddleware = {"libddsc",   "libcycl",       "libfast",     "librmw",     "libstdc++", "libc.",
                                      "libpython", "libskein_step", "libicehoofs", "libiceoryx", "libcrypto", "libssl",
                                      "ld-"};
  for (const char* prefix : kMiddleware) entry->second = entry->second || name.rfind(prefix, 0) == 0;
  return entry->second;
}

bool of_node(const void* caller) { return in_node_code() && !is_of_middleware(caller); }

std::int64_t cpp_now(clockid_t clock, const void* caller) { return of_node(caller) ? now_of(clock) : real_now(clock); }

/// @returns false if there is no simulated time, or if the sleep ended early
bool sleep_for_simulated(std::int64_t duration_ns) {
  std::int64_t now_ns = 0;
  if (!simulated_now(&now_ns)) return false;
  return sleep_until_simulated(now_ns + duration_ns);
}

/// @param left  gets the remaining time if a signal ends the sleep; may be nullptr
int sleep_of_node(const struct timespec* duration, struct timespec* left, const void* caller) {
  if (of_node(caller) && sleep_for_simulated(duration->tv_sec * kSecond_ns + duration->tv_nsec)) return 0;
  return static_cast<int>(::syscall(SYS_clock_nanosleep, CLOCK_MONOTONIC, 0, duration, left));
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

rcutils_ret_t rcutils_system_time_now(rcutils_time_point_value_t* now) {
  *now = now_of(CLOCK_REALTIME);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_steady_time_now(rcutils_time_point_value_t* now) {
  *now = now_of(CLOCK_MONOTONIC);
  return RCUTILS_RET_OK;
}

rcl_ret_t rcl_timer_call(rcl_timer_t* timer) {
  if (in_node_code()) skein_ros::note_timer();
  return SKEIN_REAL(rcl_timer_call)(timer);
}

// Functions of the C library, by their symbols.

int nanosleep_of_node(const struct timespec* duration, struct timespec* left) __asm__("nanosleep");
int nanosleep_of_node(const struct timespec* duration, struct timespec* left) {
  return sleep_of_node(duration, left, __builtin_return_address(0)) == 0 ? 0 : -1;
}

int usleep_of_node(useconds_t duration) __asm__("usleep");
int usleep_of_node(useconds_t duration) {
  const struct timespec time = {duration / 1'000'000, static_cast<long>(duration % 1'000'000) * 1000};
  return sleep_of_node(&time, nullptr, __builtin_return_address(0)) == 0 ? 0 : -1;
}

/// The C library's own sleep() would not call the functions above.
unsigned sleep_s_of_node(unsigned seconds) __asm__("sleep");
unsigned sleep_s_of_node(unsigned seconds) {
  const struct timespec time = {seconds, 0};
  struct timespec left = {};
  if (sleep_of_node(&time, &left, __builtin_return_address(0)) == 0) return 0;
  return static_cast<unsigned>(left.tv_sec) + (left.tv_nsec > 0 ? 1 : 0);
}

int clock_nanosleep_of_node(clockid_t clock, int flags, const struct timespec* time,
                            struct timespec* left) __asm__("clock_nanosleep");
int clock_nanosleep_of_node(clockid_t clock, int flags, const struct timespec* time, struct timespec* left) {
  if (of_node(__builtin_return_address(0))) {
    const std::int64_t ns = time->tv_sec * kSecond_ns + time->tv_nsec;
    if (flags == 0 ? sleep_for_simulated(ns) : sleep_until_simulated(ns)) return 0;
  }
  return ::syscall(SYS_clock_nanosleep, clock, flags, time, left) == 0 ? 0 : errno;
}

// Functions of the C++ library, by their symbols: std::chrono::steady_clock::now() and system_clock::now().
std::int64_t _ZNSt6chrono3_V212steady_clock3nowEv() { return cpp_now(CLOCK_MONOTONIC, __builtin_return_address(0)); }
std::int64_t _ZNSt6chrono3_V212system_clock3nowEv() { return cpp_now(CLOCK_REALTIME, __builtin_return_address(0)); }

// Functions of rclcpp, by their symbols, so that this library needs no rclcpp.

/// NodeOptions::use_clock_thread(): false in the lock-step, so that the node's own thread reads /clock.
bool _ZNK6rclcpp11NodeOptions16use_clock_threadEv(const void* options) {
  if (skein_ros::member() != nullptr) return false;
  using Function = bool (*)(const void*);
  static const auto real =
      reinterpret_cast<Function>(skein_ros::real_symbol("_ZNK6rclcpp11NodeOptions16use_clock_threadEv"));
  return real(options);
}

/// rclcpp::sleep_for(), which Rate and WallRate call.
bool _ZN6rclcpp9sleep_forERKNSt6chrono8durationIlSt5ratioILl1ELl1000000000EEEESt10shared_ptrINS_7ContextEE(
    const std::int64_t* duration_ns, void* context) {
  if (skein_ros::member() != nullptr && skein_ros::member()->is_open()) return sleep_for_simulated(*duration_ns);
  using Function = bool (*)(const std::int64_t*, void*);
  static const auto real = reinterpret_cast<Function>(skein_ros::real_symbol(
      "_ZN6rclcpp9sleep_forERKNSt6chrono8durationIlSt5ratioILl1ELl1000000000EEEESt10shared_ptrINS_7ContextEE"));
  return real(duration_ns, context);
}

/// The layout of rclcpp::Time: the pointer to its virtual functions, then the time.
struct RclcppTime {
  const void* functions;
  std::int64_t ns;
};

/// Clock::sleep_until(); Clock::sleep_for() calls it.
bool _ZN6rclcpp5Clock11sleep_untilENS_4TimeESt10shared_ptrINS_7ContextEE(void* clock, const RclcppTime* until,
                                                                         void* context) {
  if (skein_ros::member() != nullptr && skein_ros::member()->is_open()) return sleep_until_simulated(until->ns);
  using Function = bool (*)(void*, const RclcppTime*, void*);
  static const auto real = reinterpret_cast<Function>(
      skein_ros::real_symbol("_ZN6rclcpp5Clock11sleep_untilENS_4TimeESt10shared_ptrINS_7ContextEE"));
  return real(clock, until, context);
}

}  // extern "C"
#pragma GCC visibility pop
