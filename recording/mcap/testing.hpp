// For tests: random messages, and files with such messages.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "recording/mcap/reader.hpp"
#include "recording/mcap/writer.hpp"

namespace skein::mcap {

struct Said {
  std::string topic;
  std::uint64_t time = 0;
  Bytes data;
  bool operator==(const Said&) const = default;
};

inline std::vector<Said> random_messages(std::uint64_t seed, const std::string& prefix, std::size_t count) {
  std::mt19937_64 random(seed);
  std::vector<Said> messages;
  std::uint64_t time = 0;
  for (std::size_t i = 0; i < count; ++i) {
    time += random() % 500'000'000;
    Bytes data(random() % 3 == 0 ? 0 : random() % 400);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random() % 5);
    messages.push_back({prefix + std::to_string(random() % 4), time, std::move(data)});
  }
  return messages;
}

inline void write_all(Writer& writer, const std::vector<Said>& messages) {
  std::map<std::string, std::uint16_t> channels;
  for (const Said& said : messages) {
    if (!channels.contains(said.topic)) {
      channels[said.topic] = writer.add_channel(said.topic, "test_msgs/msg/T", "float64 x\n");
    }
    writer.write(channels.at(said.topic), said.time, said.data);
  }
}

inline std::vector<Said> read_all(const std::filesystem::path& file) {
  std::vector<Said> messages;
  Reader reader(file);
  reader.messages([&](const Channel& channel, const Message& message) {
    messages.push_back({channel.topic, message.log_time, Bytes(message.data.begin(), message.data.end())});
  });
  return messages;
}

/// Provides a temporary folder, which is removed after the test.
class McapFiles : public testing::Test {
 protected:
  McapFiles() {
    std::string name = (std::filesystem::temp_directory_path() / "skein-mcap-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~McapFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

}  // namespace skein::mcap
