// The records of an MCAP file (https://mcap.dev/spec), version 0: a container of timestamped messages which Foxglove's
// family of viewers and ROS 2 tools open. Numbers are little-endian; strings and maps follow their length in bytes.
// Times are in nanoseconds; here: of simulated time.
// All functions are pure. Parsing trusts no input: it rejects data that are too short or inconsistent.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skein::mcap {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;
using StringMap = std::map<std::string, std::string>;

/// First and last bytes of a file.
inline constexpr std::uint8_t kMagic[8] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Bytes before the content of each record: the opcode and the content's length.
inline constexpr std::size_t kRecordHead = 9;

struct Header {
  std::string profile, library;
};

/// The last record of a file; only the magic follows.
struct Footer {
  std::uint64_t summary_start = 0, summary_offset_start = 0;  ///< offsets in the file [bytes]; 0: there is no summary
  std::uint32_t summary_crc = 0;  ///< over the summary and this record up to here; 0: not computed
};

struct Schema {
  std::uint16_t id = 0;  ///< never 0
  std::string name;      ///< "nav_msgs/msg/Odometry"
  std::string encoding;  ///< "ros2msg"
  std::string data;
  bool operator==(const Schema&) const = default;
};

struct Channel {
  std::uint16_t id = 0, schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  StringMap metadata;
  bool operator==(const Channel&) const = default;
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
  ByteView data;  ///< a view of the record from which it was read
};

struct Chunk {
  std::uint64_t start_time = 0, end_time = 0;  ///< of its messages
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not computed
  std::string compression;             ///< "zstd", or "" for none
  ByteView records;                    ///< compressed; a view of the record from which it was read
};

/// Where a channel's messages are in the chunk before this record: time, and offset in the uncompressed records.
struct MessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;
};

struct ChunkIndex {
  std::uint64_t start_time = 0, end_time = 0;
  std::uint64_t offset = 0, length = 0;                    ///< of the chunk's record in the file
  std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< by channel: offset of its MessageIndex in the file
  std::uint64_t message_indexes_length = 0;                ///< of all MessageIndex records together [bytes]
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;  ///< of the chunk's records [bytes]
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t start_time = 0, end_time = 0;
  std::map<std::uint16_t, std::uint64_t> messages_by_channel;
};

struct Metadata {
  std::string name;
  StringMap entries;
};

struct MetadataIndex {
  std::uint64_t offset = 0, length = 0;
  std::string name;
};

struct SummaryOffset {
  Opcode group = Opcode::schema;
  std::uint64_t start = 0, length = 0;
};

/// Each append() appends one complete record to `out`.
void append(Bytes& out, const Header& record);
void append(Bytes& out, const Footer& record);
void append(Bytes& out, const Schema& record);
void append(Bytes& out, const Channel& record);
void append(Bytes& out, const Message& record);
void append(Bytes& out, const Chunk& record);
void append(Bytes& out, const MessageIndex& record);
void append(Bytes& out, const ChunkIndex& record);
void append(Bytes& out, const Statistics& record);
void append(Bytes& out, const Metadata& record);
void append(Bytes& out, const MetadataIndex& record);
void append(Bytes& out, const SummaryOffset& record);
void append_data_end(Bytes& out, std::uint32_t data_section_crc);

/// A record with unparsed content.
struct RawRecord {
  Opcode opcode = Opcode::header;
  ByteView content;
};

/// Removes the first record from `bytes`. @returns nullopt if there is no complete record; `bytes` is then unchanged.
std::optional<RawRecord> take_record(ByteView& bytes);

/// Each parse function returns nullopt if the content is not that of such a record.
std::optional<Footer> parse_footer(ByteView content);
std::optional<Schema> parse_schema(ByteView content);
std::optional<Channel> parse_channel(ByteView content);
std::optional<Message> parse_message(ByteView content);
std::optional<Chunk> parse_chunk(ByteView content);
std::optional<MessageIndex> parse_message_index(ByteView content);
std::optional<Metadata> parse_metadata(ByteView content);

/// CRC-32 (as in zlib) of the earlier bytes and `bytes`. @param so_far  CRC-32 of the earlier bytes; 0: there are none.
std::uint32_t crc_of(ByteView bytes, std::uint32_t so_far = 0);

}  // namespace skein::mcap
