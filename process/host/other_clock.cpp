#include "process/host/other_clock.hpp"

#include <dlfcn.h>
#include <sys/time.h>

#include <cstdlib>
#include <ctime>

namespace {

std::time_t seconds_to_add() {
  static const std::time_t seconds = [] {
    const char* text = std::getenv(skein::kOtherClockVariable);
    return text == nullptr ? std::time_t{0} : static_cast<std::time_t>(std::strtoll(text, nullptr, 10));
  }();
  return seconds;
}

/// The function of this name in the libraries that the linker searches after this one.
template <class Function>
Function behind(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, struct timespec* time) noexcept {
  static const auto real = behind<int (*)(clockid_t, struct timespec*)>("clock_gettime");
  const int code = real(clock, time);
  if (code == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) time->tv_sec += seconds_to_add();
  return code;
}

__attribute__((visibility("default"))) int gettimeofday(struct timeval* time, void* zone) noexcept {
  static const auto real = behind<int (*)(struct timeval*, void*)>("gettimeofday");
  const int code = real(time, zone);
  if (code == 0) time->tv_sec += seconds_to_add();
  return code;
}

__attribute__((visibility("default"))) std::time_t time(std::time_t* time) noexcept {
  struct timespec now {};
  ::clock_gettime(CLOCK_REALTIME, &now);
  if (time != nullptr) *time = now.tv_sec;
  return now.tv_sec;
}
}
