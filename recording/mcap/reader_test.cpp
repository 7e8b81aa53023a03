// Chunks with correct and wrong headers: the reader returns their contents, and trusts no stated length.
#include "recording/mcap/reader.hpp"

#include <gtest/gtest.h>
#include <zstd.h>

#include <random>

#include "tests/support/counted_memory.hpp"

namespace skein::mcap {
namespace {

Bytes drawn_records(std::mt19937_64& random, std::size_t most) {
  Bytes bytes(random() % most);
  const std::uint64_t kinds = 1 + random() % 255;
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % kinds);
  return bytes;
}

/// A frame of zstd. @param stated  size of the content that its header states; nullopt: none.
/// @param ended  whether the frame is complete; else it has the whole content, but no end.
Bytes frame_of(const Bytes& content, std::optional<std::uint64_t> stated, bool ended = true) {
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setPledgedSrcSize(context, stated.value_or(ZSTD_CONTENTSIZE_UNKNOWN));
  Bytes frame(ZSTD_compressBound(content.size()) + 64);
  ZSTD_inBuffer in{content.data(), content.size(), 0};
  ZSTD_outBuffer out{frame.data(), frame.size(), 0};
  // Compress in two calls: in one call, zstd would know the size and state it.
  std::size_t left = ZSTD_compressStream2(context, &out, &in, ZSTD_e_flush);
  if (ended) left += ZSTD_compressStream2(context, &out, &in, ZSTD_e_end);
  EXPECT_EQ(left, 0U);
  ZSTD_freeCCtx(context);
  frame.resize(out.pos);
  return frame;
}

Chunk chunk_of(const std::string& compression, std::uint64_t size, const Bytes& records, std::uint32_t crc = 0) {
  return {.start_time = 0,
          .end_time = 0,
          .uncompressed_size = size,
          .uncompressed_crc = crc,
          .compression = compression,
          .records = records};
}

TEST(McapUnpack, ReturnsTheRecordsIfTheyHaveTheStatedSize) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 40; ++trial) {
    const Bytes records = drawn_records(random, trial == 0 ? 1 : trial % 4 == 0 ? 5'000'000 : 3'000);
    const std::uint64_t size = records.size();
    const std::uint32_t crc = crc_of(records);
    for (const std::optional<std::uint64_t> stated : {std::optional(size), std::optional<std::uint64_t>()}) {
      const Bytes frame = frame_of(records, stated);
      EXPECT_EQ(unpack(chunk_of("zstd", size, frame, crc)), records);
      for (const std::uint64_t other : {size + 1, size + 2'000'000, size - 1, size / 2}) {
        if (other == size) continue;
        EXPECT_FALSE(unpack(chunk_of("zstd", other, frame))) << size << ' ' << other;
      }
      for (const std::size_t cut : {std::size_t{1}, frame.size() / 2}) {
        EXPECT_FALSE(unpack(chunk_of("zstd", size, Bytes(frame.begin(), frame.end() - static_cast<long>(cut)))))
            << size;
      }
    }
    EXPECT_EQ(unpack(chunk_of("", size, records, crc)), records);
    for (const std::uint64_t other : {size + 1, size - 1, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
      EXPECT_FALSE(unpack(chunk_of("", other, records))) << size << ' ' << other;
    }
    EXPECT_FALSE(unpack(chunk_of("lz4", size, records)));
  }
}

TEST(McapUnpack, DoesNotAllocateTheSizeThatAFileStates) {
  std::mt19937_64 random(2);
  const Bytes records = drawn_records(random, 3'000);
  for (const std::uint64_t size :
       {std::uint64_t{100'000'000}, kLargestChunk, kLargestChunk + 1, ~std::uint64_t{0} / 2}) {
    const Bytes frame = frame_of(records, size, false);
    const test::CountedMemory memory;
    EXPECT_FALSE(unpack(chunk_of("zstd", size, frame)));
    EXPECT_FALSE(unpack(chunk_of("", size, records)));
    EXPECT_LT(memory.peak(), std::size_t{16} << 20) << size;
  }
}

}  // namespace
}  // namespace skein::mcap
