// The records of an MCAP file (https://mcap.dev/spec), version 0: a container of timestamped messages which Foxglove's
// family of viewers and ROS 2 tools open. Numbers are little-endian; strings and maps follow their length in bytes.
// Times are in nanoseconds; here: of simulated time.
// Each record lists its fields once, in the file's order: each_field() passes them to what writes or parses records.
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
  static constexpr Opcode kOpcode = Opcode::header;
  std::string profile, library;
  static void each_field(auto& fields, auto& of) { fields(of.profile, of.library); }
};

/// The last record of a file; only the magic follows.
struct Footer {
  static constexpr Opcode kOpcode = Opcode::footer;
  std::uint64_t summary_start = 0, summary_offset_start = 0;  ///< offsets in the file [bytes]; 0: there is no summary
  std::uint32_t summary_crc = 0;  ///< over the summary and this record up to here; 0: not computed
  static void each_field(auto& fields, auto& of) { fields(of.summary_start, of.summary_offset_start, of.summary_crc); }
};

struct Schema {
  static constexpr Opcode kOpcode = Opcode::schema;
  std::uint16_t id = 0;  ///< never 0
  std::string name;      ///< "nav_msgs/msg/Odometry"
  std::string encoding;  ///< "ros2msg"
  std::string data;
  static void each_field(auto& fields, auto& of) { fields(of.id, of.name, of.encoding, of.data); }
  bool operator==(const Schema&) const = default;
};

struct Channel {
  static constexpr Opcode kOpcode = Opcode::channel;
  std::uint16_t id = 0, schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  StringMap metadata;
  static void each_field(auto& fields, auto& of) {
    fields(of.id, of.schema_id, of.topic, of.message_encoding, of.metadata);
  }
  bool operator==(const Channel&) const = default;
};

struct Message {
  static constexpr Opcode kOpcode = Opcode::message;
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
  ByteView data;  ///< a view of the record from which it was read
  static void each_field(auto& fields, auto& of) {
    fields(of.channel_id, of.sequence, of.log_time, of.publish_time);
    fields.rest(of.data);
  }
};

struct Chunk {
  static constexpr Opcode kOpcode = Opcode::chunk;
  std::uint64_t start_time = 0, end_time = 0;  ///< of its messages
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not computed
  std::string compression;             ///< "zstd", or "" for none
  ByteView records;                    ///< compressed; a view of the record from which it was read
  static void each_field(auto& fields, auto& of) {
    fields(of.start_time, of.end_time, of.uncompressed_size, of.uncompressed_crc, of.compression);
    fields.sized(of.records);
  }
};

/// Where a channel's messages are in the chunk before this record: time, and offset in the uncompressed records.
struct MessageIndex {
  static constexpr Opcode kOpcode = Opcode::message_index;
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> entries;
  static void each_field(auto& fields, auto& of) { fields(of.channel_id, of.entries); }
};

struct ChunkIndex {
  static constexpr Opcode kOpcode = Opcode::chunk_index;
  std::uint64_t start_time = 0, end_time = 0;
  std::uint64_t offset = 0, length = 0;                    ///< of the chunk's record in the file
  std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< by channel: offset of its MessageIndex in the file
  std::uint64_t message_indexes_length = 0;                ///< of all MessageIndex records together [bytes]
  std::string compression;
  std::uint64_t compressed_size = 0, uncompressed_size = 0;  ///< of the chunk's records [bytes]
  static void each_field(auto& fields, auto& of) {
    fields(of.start_time, of.end_time, of.offset, of.length, of.message_indexes, of.message_indexes_length);
    fields(of.compression, of.compressed_size, of.uncompressed_size);
  }
};

struct Statistics {
  static constexpr Opcode kOpcode = Opcode::statistics;
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t start_time = 0, end_time = 0;
  std::map<std::uint16_t, std::uint64_t> messages_by_channel;
  static void each_field(auto& fields, auto& of) {
    fields(of.messages, of.schemas, of.channels, of.attachments, of.metadata, of.chunks);
    fields(of.start_time, of.end_time, of.messages_by_channel);
  }
};

struct Metadata {
  static constexpr Opcode kOpcode = Opcode::metadata;
  std::string name;
  StringMap entries;
  static void each_field(auto& fields, auto& of) { fields(of.name, of.entries); }
};

struct MetadataIndex {
  static constexpr Opcode kOpcode = Opcode::metadata_index;
  std::uint64_t offset = 0, length = 0;
  std::string name;
  static void each_field(auto& fields, auto& of) { fields(of.offset, of.length, of.name); }
};

struct SummaryOffset {
  static constexpr Opcode kOpcode = Opcode::summary_offset;
  Opcode group = Opcode::schema;
  std::uint64_t start = 0, length = 0;
  static void each_field(auto& fields, auto& of) { fields(of.group, of.start, of.length); }
};

struct DataEnd {
  static constexpr Opcode kOpcode = Opcode::data_end;
  std::uint32_t data_section_crc = 0;
  static void each_field(auto& fields, auto& of) { fields(of.data_section_crc); }
};

/// Appends one complete record to `out`.
template <class Record>
void append(Bytes& out, const Record& record);

/// A record with unparsed content.
struct RawRecord {
  Opcode opcode = Opcode::header;
  ByteView content;
};

/// Removes the first record from `bytes`. @returns nullopt if there is no complete record; `bytes` is then unchanged.
std::optional<RawRecord> take_record(ByteView& bytes);

/// Parses the content of a record, of a type for which a reader asks (records.cpp lists them).
/// @returns nullopt if the content is not that of such a record.
template <class Record>
std::optional<Record> parse(ByteView content);

/// CRC-32 (as in zlib) of the earlier bytes and `bytes`. @param so_far  CRC-32 of the earlier bytes; 0: there are none.
std::uint32_t crc_of(ByteView bytes, std::uint32_t so_far = 0);

}  // namespace skein::mcap
