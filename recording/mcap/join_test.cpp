#include "recording/mcap/join.hpp"

#include <algorithm>
#include <fstream>

#include "core/files/file_bytes.hpp"
#include "recording/mcap/testing.hpp"

namespace skein::mcap {
namespace {

class McapJoin : public McapFiles {
 protected:
  std::vector<Said> write_part(const std::string& name, std::uint16_t first_id, std::uint64_t seed) {
    const auto messages = random_messages(seed, "/" + name + "/", 100 + 20 * seed);
    Writer writer(folder_ / name, {.chunk_bytes = 2000, .first_id = first_id});
    write_all(writer, messages);
    return messages;
  }
};

std::vector<Said> of_part(const std::vector<Said>& all, const std::string& name) {
  std::vector<Said> result;
  std::ranges::copy_if(all, std::back_inserter(result),
                       [&](const Said& said) { return said.topic.starts_with("/" + name + "/"); });
  return result;
}

TEST_F(McapJoin, HoldsEveryMessageOfEachPartInTheOrderOfThePart) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto a = write_part("a", 1, seed), b = write_part("b", 1000, seed + 1), c = write_part("c", 2000, seed + 2);
    EXPECT_EQ(join({folder_ / "a", folder_ / "b", folder_ / "c"}, folder_ / "whole", {{"run", {{"k", "v"}}}}), "");
    const auto whole = read_all(folder_ / "whole");
    EXPECT_EQ(whole.size(), a.size() + b.size() + c.size());
    EXPECT_EQ(of_part(whole, "a"), a);
    EXPECT_EQ(of_part(whole, "b"), b);
    EXPECT_EQ(of_part(whole, "c"), c);
    EXPECT_TRUE(Reader(folder_ / "whole").complete());
  }
}

// A viewer that sorts messages keeps chunks that overlap in time in memory, so chunks must follow each other in time.
TEST_F(McapJoin, ChunksAreInTheOrderOfTime) {
  write_part("a", 1, 3);
  write_part("b", 1000, 5);
  join({folder_ / "b", folder_ / "a"}, folder_ / "whole", {});
  std::uint64_t last = 0;
  Reader(folder_ / "whole").records([&](const RawRecord& record, std::uint64_t) {
    if (record.opcode != Opcode::chunk) return;
    const std::uint64_t start = parse<Chunk>(record.content)->start_time;
    EXPECT_GE(start, last);
    last = start;
  });
  EXPECT_GT(last, 0U);
}

TEST_F(McapJoin, PartsThatAreCutOffAreJoinedAsFarAsTheyGo) {
  const auto a = write_part("a", 1, 2), b = write_part("b", 1000, 4);
  const std::string bytes = read_file_bytes(folder_ / "b", 1 << 20);
  std::ofstream(folder_ / "b", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  const auto kept = read_all(folder_ / "b");
  ASSERT_GT(kept.size(), 0U);
  ASSERT_LT(kept.size(), b.size());
  EXPECT_EQ(join({folder_ / "a", folder_ / "b"}, folder_ / "whole", {}), "");
  const auto whole = read_all(folder_ / "whole");
  EXPECT_EQ(of_part(whole, "a"), a);
  EXPECT_EQ(of_part(whole, "b"), kept);
}

TEST_F(McapJoin, APartThatIsNotARecordingIsReportedAndLeftOut) {
  const auto a = write_part("a", 1, 2);
  std::ofstream(folder_ / "b") << "nonsense";
  EXPECT_NE(join({folder_ / "a", folder_ / "b"}, folder_ / "whole", {}).find("not an MCAP file"), std::string::npos);
  EXPECT_EQ(read_all(folder_ / "whole"), a);
}

TEST_F(McapJoin, ADamagedPartIsReportedByNameAndChunk) {
  const auto a = write_part("a", 1, 2), b = write_part("b", 1000, 4);
  std::string bytes = read_file_bytes(folder_ / "b", 1 << 20);
  std::uint64_t last_chunk = 0;
  Reader(folder_ / "b").records([&](const RawRecord& record, std::uint64_t offset) {
    if (record.opcode == Opcode::chunk) last_chunk = offset + kRecordHead + record.content.size() - 1;
  });
  bytes[last_chunk] = static_cast<char>(bytes[last_chunk] ^ 1);
  for (const std::size_t size : {bytes.size(), static_cast<std::size_t>(last_chunk + 1)}) {  // whole, and cut off
    std::ofstream(folder_ / "b", std::ios::binary) << bytes.substr(0, size);
    const std::string trouble = join({folder_ / "a", folder_ / "b"}, folder_ / "whole", {});
    EXPECT_NE(trouble.find("b: chunk "), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("messages are missing"), std::string::npos) << trouble;
  }
}

}  // namespace
}  // namespace skein::mcap
