#include "mcap/writer.hpp"

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/file_bytes.hpp"
#include "core/types.hpp"
#include "mcap/testing.hpp"

namespace skein::mcap {
namespace {

WriterOptions small_chunks() { return {.chunk_bytes = 1500}; }

using McapWriter = McapFiles;

TEST_F(McapWriter, WhatWasWrittenIsReadInOrder) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto messages = random_messages(seed, "/t", seed * 13);
    {
      Writer writer(folder_ / "a.mcap", small_chunks());
      write_all(writer, messages);
      writer.write_metadata({"run", {{"seed", std::to_string(seed)}}});
      writer.close();
      EXPECT_EQ(writer.trouble(), "");
    }
    EXPECT_EQ(read_all(folder_ / "a.mcap"), messages) << seed;
    Reader reader(folder_ / "a.mcap");
    EXPECT_TRUE(reader.complete());
    reader.messages([](const Channel&, const Message&) {});
    EXPECT_EQ(reader.metadata().at("run").at("seed"), std::to_string(seed));
  }
}

TEST_F(McapWriter, TheSameCallsMakeTheSameBytes) {
  const auto messages = random_messages(5, "/t", 200);
  for (const char* name : {"a", "b"}) {
    Writer writer(folder_ / name, small_chunks());
    write_all(writer, messages);
  }
  EXPECT_EQ(read_file_bytes(folder_ / "a", 1 << 20), read_file_bytes(folder_ / "b", 1 << 20));
}

TEST_F(McapWriter, NoChunkSpansTwoWindowsOfTime) {
  const WriterOptions options{.chunk_ns = 2'000'000'000};
  {
    Writer writer(folder_ / "a", options);
    write_all(writer, random_messages(9, "/t", 300));
  }
  std::size_t chunks = 0;
  Reader(folder_ / "a").records([&](const RawRecord& record, std::uint64_t) {
    if (record.opcode != Opcode::chunk) return;
    const auto chunk = parse_chunk(record.content);
    EXPECT_EQ(chunk->start_time / options.chunk_ns, chunk->end_time / options.chunk_ns);
    ++chunks;
  });
  EXPECT_GT(chunks, 10U);
}

// A process that is killed, at any byte: what stands before is read, as a beginning of what was written.
TEST_F(McapWriter, ACutOffFileIsReadAsFarAsItGoes) {
  const auto messages = random_messages(3, "/t", 60);
  {
    Writer writer(folder_ / "whole", small_chunks());
    write_all(writer, messages);
  }
  const std::string whole = read_file_bytes(folder_ / "whole", 1 << 20);
  std::size_t most = 0;
  for (std::size_t length = sizeof(kMagic); length < whole.size(); length += 7) {
    std::ofstream(folder_ / "cut", std::ios::binary) << whole.substr(0, length);
    const auto read = read_all(folder_ / "cut");
    ASSERT_LE(read.size(), messages.size());
    ASSERT_GE(read.size(), most) << "a longer file holds no less";
    EXPECT_TRUE(std::equal(read.begin(), read.end(), messages.begin()));
    EXPECT_FALSE(Reader(folder_ / "cut").complete());
    most = read.size();
  }
  EXPECT_EQ(most, messages.size());
}

TEST_F(McapWriter, WhatIsFlushedSurvivesTheProcess) {
  const auto messages = random_messages(4, "/t", 5);
  Writer writer(folder_ / "a");
  write_all(writer, messages);
  EXPECT_TRUE(read_all(folder_ / "a").empty());
  writer.flush();
  EXPECT_EQ(read_all(folder_ / "a"), messages);
}

TEST_F(McapWriter, DamageEndsTheReadingWithoutALie) {
  const auto messages = random_messages(6, "/t", 80);
  {
    Writer writer(folder_ / "whole", small_chunks());
    write_all(writer, messages);
  }
  const std::string whole = read_file_bytes(folder_ / "whole", 1 << 20);
  for (std::size_t at = sizeof(kMagic) + 40; at < whole.size(); at += 43) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
    std::ofstream(folder_ / "damaged", std::ios::binary) << damaged;
    const auto read = read_all(folder_ / "damaged");
    ASSERT_LE(read.size(), messages.size());
    for (std::size_t i = 0, j = 0; i < read.size(); ++i, ++j) {
      while (j < messages.size() && !(messages[j] == read[i])) ++j;  // a chunk may be missing, none is changed
      ASSERT_LT(j, messages.size()) << at;
    }
  }
}

TEST_F(McapWriter, AFullDiskEndsTheFileAndNotTheProgram) {
  const auto messages = random_messages(8, "/t", 400);
  const rlimit before = [] {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    return limit;
  }();
  std::signal(SIGXFSZ, SIG_IGN);
  {
    Writer writer(folder_ / "full", {.chunk_bytes = 400});
    rlimit limit = before;
    limit.rlim_cur = 6000;
    setrlimit(RLIMIT_FSIZE, &limit);
    write_all(writer, messages);
    writer.close();
    EXPECT_NE(writer.trouble().find("cannot write"), std::string::npos);
    EXPECT_NE(writer.trouble().find("full"), std::string::npos);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  const auto read = read_all(folder_ / "full");
  EXPECT_GT(read.size(), 0U);
  EXPECT_LT(read.size(), messages.size());
  EXPECT_TRUE(std::equal(read.begin(), read.end(), messages.begin()));
}

TEST_F(McapWriter, TellsWhenItHasNoMoreIds) {
  Writer writer(folder_ / "a", {.first_id = 10, .last_id = 11});
  EXPECT_EQ(writer.add_channel("/a", "t/msg/T", ""), 10);
  EXPECT_EQ(writer.add_channel("/b", "t/msg/T", ""), 11);
  EXPECT_THROW(writer.add_channel("/c", "t/msg/T", ""), std::length_error);
}

TEST_F(McapWriter, WhatIsNoMcapFileIsRefusedByName) {
  std::ofstream(folder_ / "text") << "no recording at all";
  EXPECT_THROW(Reader(folder_ / "text"), InputError);
  EXPECT_THROW(Reader(folder_ / "missing"), InputError);
}

}  // namespace
}  // namespace skein::mcap
