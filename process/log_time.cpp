#include "process/log_time.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <limits>

#include "process/log_lines.hpp"

namespace skein {
namespace {

std::atomic<double> time_s = std::numeric_limits<double>::quiet_NaN();

class TimeFlag final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg&, const std::tm&, spdlog::memory_buf_t& text) override {
    const double now_s = time_s;
    if (now_s == now_s) spdlog::fmt_lib::format_to(std::back_inserter(text), " {:.2f}", now_s);
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<TimeFlag>(); }
};

}  // namespace

void set_log_time(double simulated_s) { time_s = simulated_s; }

void show_log_time(spdlog::logger& log) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<TimeFlag>('*').set_pattern(log_lines::kTimedPattern);
  log.set_formatter(std::move(formatter));
}

}  // namespace skein
