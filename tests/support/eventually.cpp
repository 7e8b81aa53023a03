#include "tests/support/eventually.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Number of threads on this machine that want a core now, this one included: in /proc/loadavg's fourth field, "3/512".
double programs_that_run() {
  std::ifstream file("/proc/loadavg");
  std::string averages, running;
  file >> averages >> averages >> averages >> running;
  return std::max(1.0, std::strtod(running.c_str(), nullptr));
}

/// Time that counts only as far as this process could get a core: with ten busy threads on two cores a second counts as
/// a fifth.
class FairTime {
 public:
  Seconds passed() {
    const Clock::time_point now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(20)) return passed_;
    const double cores = std::max(1U, std::thread::hardware_concurrency());
    passed_ += Seconds(now - last_) * std::min(1.0, cores / programs_that_run());
    last_ = now;
    return passed_;
  }

 private:
  Clock::time_point last_ = Clock::now();
  Seconds passed_{0.0};
};

}  // namespace

bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit) {
  FairTime time;
  while (!condition()) {
    if (time.passed() > limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace skein
