#include "recording/mcap/writer.hpp"

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"
#include "recording/mcap/testing.hpp"

namespace skein::mcap {
namespace {

WriterOptions small_chunks() { return {.chunk_bytes = 1500}; }

using McapWriter = McapFiles;

TEST_F(McapWriter, WrittenMessagesAreReadInOrder) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto messages = random_messages(seed, "/t", seed * 13);
    {
      Writer writer(folder_ / "a.mcap", small_chunks());
      write_all(writer, messages);
      writer.write_metadata({"run", {{"seed", std::to_string(seed)}}});
      writer.close();
      EXPECT_EQ(writer.write_error(), "");
    }
    EXPECT_EQ(read_all(folder_ / "a.mcap"), messages) << seed;
    Reader reader(folder_ / "a.mcap");
    EXPECT_TRUE(reader.complete());
    reader.messages([](const Channel&, const Message&) {});
    EXPECT_EQ(reader.metadata().at("run").at("seed"), std::to_string(seed));
  }
}

TEST_F(McapWriter, TheSameCallsWriteTheSameBytes) {
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
    const auto chunk = parse<Chunk>(record.content);
    EXPECT_EQ(chunk->start_time / options.chunk_ns, chunk->end_time / options.chunk_ns);
    ++chunks;
  });
  EXPECT_GT(chunks, 10U);
}

// If a process is killed at any byte of its file, the reader returns the first part of the written messages.
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
    ASSERT_GE(read.size(), most) << "a longer part of the file must not hold fewer messages";
    EXPECT_TRUE(std::equal(read.begin(), read.end(), messages.begin()));
    EXPECT_FALSE(Reader(folder_ / "cut").complete());
    most = read.size();
  }
  EXPECT_EQ(most, messages.size());
}

TEST_F(McapWriter, FlushedMessagesSurviveTheProcess) {
  const auto messages = random_messages(4, "/t", 5);
  Writer writer(folder_ / "a");
  write_all(writer, messages);
  EXPECT_TRUE(read_all(folder_ / "a").empty());
  writer.flush();
  EXPECT_EQ(read_all(folder_ / "a"), messages);
}

TEST_F(McapWriter, ADamagedFileYieldsOnlyMessagesThatWereWritten) {
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
      while (j < messages.size() && !(messages[j] == read[i]))
        ++j;  // a chunk may be missing, but no message is changed
      ASSERT_LT(j, messages.size()) << at;
    }
  }
}

TEST_F(McapWriter, AFullDiskEndsTheFileButNotTheProgram) {
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
    EXPECT_NE(writer.write_error().find("cannot write"), std::string::npos);
    EXPECT_NE(writer.write_error().find("full"), std::string::npos);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  const auto read = read_all(folder_ / "full");
  EXPECT_GT(read.size(), 0U);
  EXPECT_LT(read.size(), messages.size());
  EXPECT_TRUE(std::equal(read.begin(), read.end(), messages.begin()));
}

TEST_F(McapWriter, ReportsThatItHasNoMoreIds) {
  Writer writer(folder_ / "a", {.first_id = 10, .last_id = 11});
  EXPECT_EQ(writer.add_channel("/a", "t/msg/T", ""), 10);
  EXPECT_EQ(writer.add_channel("/b", "t/msg/T", ""), 11);
  EXPECT_THROW(writer.add_channel("/c", "t/msg/T", ""), std::length_error);
}

TEST_F(McapWriter, FilesThatAreNotMcapAreRefusedByName) {
  std::ofstream(folder_ / "text") << "no recording at all";
  EXPECT_THROW(Reader(folder_ / "text"), InputError);
  EXPECT_THROW(Reader(folder_ / "missing"), InputError);
}

// ---- damage -----------------------------------------------------------------------------------------------------

std::string refusal_of(const std::filesystem::path& file) try {
  Reader::whole(file);
  return "";
} catch (const InputError& error) {
  return error.what();
}

void write_with_flipped_bit(const std::filesystem::path& file, std::string bytes, std::uint64_t bit) {
  bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(McapWriter, AFlippedBitIsDetectedWhereverItIs) {
  const auto seed = static_cast<std::uint64_t>(::getpid());
  std::mt19937_64 random(seed);
  {
    Writer writer(folder_ / "sound", small_chunks());
    write_all(writer, random_messages(seed, "/t", 120));
    writer.write_metadata({"run", {{"seed", "1"}}});
  }
  ASSERT_EQ(refusal_of(folder_ / "sound"), "");
  const std::string bytes = read_file_bytes(folder_ / "sound", 1 << 20);
  for (int draw = 0; draw < 2000; ++draw) {
    const std::uint64_t bit = random() % (8 * bytes.size());
    write_with_flipped_bit(folder_ / "bad", bytes, bit);
    const std::string refusal = refusal_of(folder_ / "bad");
    ASSERT_NE(refusal.find((folder_ / "bad").string()), std::string::npos) << "seed " << seed << " bit " << bit;
    ASSERT_NE(refusal.find("damaged"), std::string::npos) << refusal;
  }
}

TEST_F(McapWriter, TheReportOfDamageNamesTheChunkAndWhatIsMissing) {
  {
    Writer writer(folder_ / "sound", small_chunks());
    write_all(writer, random_messages(7, "/t", 300));
  }
  struct Place {
    std::uint64_t offset, length;
    Chunk chunk;
  };
  const Reader sound(folder_ / "sound");
  std::vector<Place> places;
  sound.records([&](const RawRecord& record, std::uint64_t offset) {
    if (record.opcode == Opcode::chunk)
      places.push_back({offset, record.content.size(), *parse<Chunk>(record.content)});
  });
  ASSERT_GT(places.size(), 5U);
  const std::string bytes = read_file_bytes(folder_ / "sound", 1 << 20);
  std::mt19937_64 random(11);
  for (int draw = 0; draw < 40; ++draw) {
    const std::size_t number = random() % places.size();
    const Place& place = places[number];
    const std::uint64_t records = place.offset + kRecordHead + place.length - place.chunk.records.size();
    write_with_flipped_bit(folder_ / "bad", bytes, 8 * records + random() % (8 * place.chunk.records.size()));
    const std::string refusal = refusal_of(folder_ / "bad");
    const std::string chunk = "chunk " + std::to_string(number + 1) + ", at byte " + std::to_string(place.offset);
    EXPECT_NE(refusal.find(chunk), std::string::npos) << refusal;
    const double start_s = 1e-9 * static_cast<double>(place.chunk.start_time);
    EXPECT_NE(refusal.find("of " + fixed(start_s, 2) + " s to "), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace skein::mcap
