// Samples that could not be sent: all are counted, and the log has one line for each topic.
#include "bus/unsent.hpp"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <sstream>

namespace skein::bus {
namespace {

/// The messages that are logged during its lifetime.
class LogText {
 public:
  LogText() : former_(spdlog::default_logger()) {
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_)));
    spdlog::set_pattern("%v");
  }
  ~LogText() { spdlog::set_default_logger(former_); }
  std::string text() const { return text_.str(); }
  std::ptrdiff_t lines() const {
    const std::string all = text_.str();
    return std::count(all.begin(), all.end(), '\n');
  }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> former_;
};

TEST(Unsent, CountsEachSampleAndLogsOneLinePerTopic) {
  const LogText log;
  Unsent unsent;
  EXPECT_EQ(unsent.count(), 0U);
  for (int i = 0; i < 10; ++i) {
    for (const char* topic : {"rt/x", "rt/y", "rt/z"}) unsent.note(topic, "its readers are too slow");
  }
  EXPECT_EQ(unsent.count(), 30U);
  EXPECT_EQ(log.lines(), 3);
  for (const char* topic : {"rt/x", "rt/y", "rt/z"}) EXPECT_NE(log.text().find(topic), std::string::npos) << log.text();
}

}  // namespace
}  // namespace skein::bus
