#include "process/status/status_pipe.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <condition_variable>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace skein {
namespace {

/// Both ends of a pipe.
struct Pipe {
  Pipe() { EXPECT_EQ(::pipe2(fd, O_CLOEXEC), 0); }
  ~Pipe() {
    close_reading();
    close_writing();
  }
  void close_reading() { close_end(fd[0]); }
  void close_writing() { close_end(fd[1]); }
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  int reading() const { return fd[0]; }
  int writing() const { return fd[1]; }

  int fd[2] = {-1, -1};
};

std::vector<nlohmann::json> read_all(int fd) {
  std::string text;
  char chunk[4096];
  for (ssize_t size = 0; (size = ::read(fd, chunk, sizeof chunk)) > 0;) {
    text.append(chunk, static_cast<std::size_t>(size));
  }
  std::vector<nlohmann::json> messages;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) messages.push_back(nlohmann::json::parse(line));
  return messages;
}

TEST(StatusPipe, WritesOneObjectALine) {
  Pipe pipe;
  StatusPipe status(pipe.writing());
  status.send({{"step", 1}});
  status.send({{"text", "two\nlines, and a stray byte \xff"}});
  pipe.close_writing();
  const auto messages = read_all(pipe.reading());
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0]["step"], 1);
}

TEST(StatusPipe, WithoutALauncherDoesNothing) {
  StatusPipe status(-1);
  status.send({{"step", 1}});
  status.send_surely({{"step", 2}});
}

TEST(StatusPipe, SurvivesAReaderThatHasGone) {
  Pipe pipe;
  StatusPipe status(pipe.writing());
  pipe.close_reading();
  status.send({{"step", 1}});
  status.send_surely({{"step", 2}});
}

TEST(StatusPipe, DropsWholeLinesWhenTheReaderIsSlowExceptImportantOnes) {
  Pipe pipe;
  StatusPipe status(pipe.writing());
  const std::string filling(3000, 'x');
  constexpr int kMessages = 100;  // far more than a pipe holds
  for (int i = 0; i < kMessages; ++i) status.send({{"number", i}, {"filling", filling}});
  std::vector<nlohmann::json> messages;
  std::thread reader([&] { messages = read_all(pipe.reading()); });
  status.send_surely({{"result", 42}});
  pipe.close_writing();
  reader.join();
  ASSERT_GT(messages.size(), 2u);
  EXPECT_LT(messages.size(), static_cast<std::size_t>(kMessages));
  for (std::size_t i = 0; i + 1 < messages.size(); ++i) EXPECT_EQ(messages[i]["number"], i);
  EXPECT_EQ(messages.back()["result"], 42);
}

TEST(ControlPipe, ReportsLinesAndTheEndOfTheInput) {
  Pipe pipe;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> lines;
  bool ended = false;
  ControlPipe control(
      pipe.reading(),
      [&](const std::string& line) {
        const std::lock_guard lock(mutex);
        lines.push_back(line);
      },
      [&] {
        const std::lock_guard lock(mutex);
        ended = true;
        changed.notify_one();
      });
  const std::string text = "stop\n\n{\"kill\": \"jurong\"}\nno end";
  ASSERT_EQ(::write(pipe.writing(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  pipe.close_writing();
  std::unique_lock lock(mutex);
  changed.wait(lock, [&] { return ended; });
  EXPECT_EQ(lines, (std::vector<std::string>{"stop", "", "{\"kill\": \"jurong\"}"}));
}

// If the destructors waited for the end of the input, this test would hang.
TEST(ControlPipe, EndsWhileTheOtherEndIsOpen) {
  Pipe pipe;
  const ControlPipe control(pipe.reading(), [](const std::string&) {});
  const ControlPipe none(-1, [](const std::string&) {});
}

}  // namespace
}  // namespace skein
