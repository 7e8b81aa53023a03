#include "recording/mcap/records.hpp"

#include <zlib.h>

#include <concepts>
#include <utility>

namespace skein::mcap {
namespace {

template <std::unsigned_integral T>
void put(Bytes& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void put(Bytes& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.insert(out.end(), text.begin(), text.end());
}

void put(Bytes& out, ByteView bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

void set(Bytes& out, std::size_t at, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) out[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// Appends a length field, and then the bytes that `body` appends.
template <class Length, class Body>
void put_sized(Bytes& out, Body body) {
  const std::size_t at = out.size();
  put(out, Length{0});
  body();
  set(out, at, out.size() - at - sizeof(Length), sizeof(Length));
}

template <class Body>
void put_record(Bytes& out, Opcode opcode, Body body) {
  out.push_back(static_cast<std::uint8_t>(opcode));
  put_sized<std::uint64_t>(out, body);
}

void put(Bytes& out, const StringMap& map) {
  put_sized<std::uint32_t>(out, [&] {
    for (const auto& [key, value] : map) {
      put(out, key);
      put(out, value);
    }
  });
}

void put(Bytes& out, const std::map<std::uint16_t, std::uint64_t>& map) {
  put_sized<std::uint32_t>(out, [&] {
    for (const auto& [key, value] : map) {
      put(out, key);
      put(out, value);
    }
  });
}

/// Reads values from the front of the bytes. After an incomplete value, good() is false and all values are empty.
class Parser {
 public:
  explicit Parser(ByteView bytes) : left_(bytes) {}

  template <std::unsigned_integral T>
  T number() {
    const ByteView bytes = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value = static_cast<T>(value | static_cast<T>(T{bytes[i]} << (8 * i)));
    return value;
  }
  ByteView sized(std::uint64_t length) { return take(length); }
  std::string text() {
    const ByteView bytes = take(number<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }
  StringMap map() {
    Parser entries(take(number<std::uint32_t>()));
    StringMap result;
    while (entries.good_ && !entries.left_.empty()) {
      std::string key = entries.text();
      result[std::move(key)] = entries.text();
    }
    good_ = good_ && entries.good_;
    return result;
  }
  ByteView rest() { return std::exchange(left_, {}); }
  bool good() const { return good_; }
  bool empty() const { return left_.empty(); }

 private:
  ByteView take(std::uint64_t length) {
    good_ = good_ && length <= left_.size();
    if (!good_) return {};
    const ByteView taken = left_.first(length);
    left_ = left_.subspan(length);
    return taken;
  }

  ByteView left_;
  bool good_ = true;
};

template <class T>
std::optional<T> if_good(const Parser& parser, T value) {
  return parser.good() ? std::optional<T>(std::move(value)) : std::nullopt;
}

}  // namespace

void append(Bytes& out, const Header& record) {
  put_record(out, Opcode::header, [&] {
    put(out, record.profile);
    put(out, record.library);
  });
}

void append(Bytes& out, const Footer& record) {
  put_record(out, Opcode::footer, [&] {
    put(out, record.summary_start);
    put(out, record.summary_offset_start);
    put(out, record.summary_crc);
  });
}

void append(Bytes& out, const Schema& record) {
  put_record(out, Opcode::schema, [&] {
    put(out, record.id);
    put(out, record.name);
    put(out, record.encoding);
    put(out, record.data);
  });
}

void append(Bytes& out, const Channel& record) {
  put_record(out, Opcode::channel, [&] {
    put(out, record.id);
    put(out, record.schema_id);
    put(out, record.topic);
    put(out, record.message_encoding);
    put(out, record.metadata);
  });
}

void append(Bytes& out, const Message& record) {
  put_record(out, Opcode::message, [&] {
    put(out, record.channel_id);
    put(out, record.sequence);
    put(out, record.log_time);
    put(out, record.publish_time);
    put(out, record.data);
  });
}

void append(Bytes& out, const Chunk& record) {
  put_record(out, Opcode::chunk, [&] {
    put(out, record.start_time);
    put(out, record.end_time);
    put(out, record.uncompressed_size);
    put(out, record.uncompressed_crc);
    put(out, record.compression);
    put(out, static_cast<std::uint64_t>(record.records.size()));
    put(out, record.records);
  });
}

void append(Bytes& out, const MessageIndex& record) {
  put_record(out, Opcode::message_index, [&] {
    put(out, record.channel_id);
    put_sized<std::uint32_t>(out, [&] {
      for (const auto& [time, offset] : record.entries) {
        put(out, time);
        put(out, offset);
      }
    });
  });
}

void append(Bytes& out, const ChunkIndex& record) {
  put_record(out, Opcode::chunk_index, [&] {
    put(out, record.start_time);
    put(out, record.end_time);
    put(out, record.offset);
    put(out, record.length);
    put(out, record.message_indexes);
    put(out, record.message_indexes_length);
    put(out, record.compression);
    put(out, record.compressed_size);
    put(out, record.uncompressed_size);
  });
}

void append(Bytes& out, const Statistics& record) {
  put_record(out, Opcode::statistics, [&] {
    put(out, record.messages);
    put(out, record.schemas);
    put(out, record.channels);
    put(out, record.attachments);
    put(out, record.metadata);
    put(out, record.chunks);
    put(out, record.start_time);
    put(out, record.end_time);
    put(out, record.messages_by_channel);
  });
}

void append(Bytes& out, const Metadata& record) {
  put_record(out, Opcode::metadata, [&] {
    put(out, record.name);
    put(out, record.entries);
  });
}

void append(Bytes& out, const MetadataIndex& record) {
  put_record(out, Opcode::metadata_index, [&] {
    put(out, record.offset);
    put(out, record.length);
    put(out, record.name);
  });
}

void append(Bytes& out, const SummaryOffset& record) {
  put_record(out, Opcode::summary_offset, [&] {
    put(out, static_cast<std::uint8_t>(record.group));
    put(out, record.start);
    put(out, record.length);
  });
}

void append_data_end(Bytes& out, std::uint32_t data_section_crc) {
  put_record(out, Opcode::data_end, [&] { put(out, data_section_crc); });
}

std::optional<RawRecord> take_record(ByteView& bytes) {
  Parser parser(bytes);
  const auto opcode = static_cast<Opcode>(parser.number<std::uint8_t>());
  const ByteView content = parser.sized(parser.number<std::uint64_t>());
  if (!parser.good()) return std::nullopt;
  bytes = parser.rest();
  return RawRecord{opcode, content};
}

std::optional<Footer> parse_footer(ByteView content) {
  Parser parser(content);
  Footer footer;
  footer.summary_start = parser.number<std::uint64_t>();
  footer.summary_offset_start = parser.number<std::uint64_t>();
  footer.summary_crc = parser.number<std::uint32_t>();
  return if_good(parser, footer);
}

std::optional<Schema> parse_schema(ByteView content) {
  Parser parser(content);
  Schema schema;
  schema.id = parser.number<std::uint16_t>();
  schema.name = parser.text();
  schema.encoding = parser.text();
  schema.data = parser.text();
  return if_good(parser, std::move(schema));
}

std::optional<Channel> parse_channel(ByteView content) {
  Parser parser(content);
  Channel channel;
  channel.id = parser.number<std::uint16_t>();
  channel.schema_id = parser.number<std::uint16_t>();
  channel.topic = parser.text();
  channel.message_encoding = parser.text();
  channel.metadata = parser.map();
  return if_good(parser, std::move(channel));
}

std::optional<Message> parse_message(ByteView content) {
  Parser parser(content);
  Message message;
  message.channel_id = parser.number<std::uint16_t>();
  message.sequence = parser.number<std::uint32_t>();
  message.log_time = parser.number<std::uint64_t>();
  message.publish_time = parser.number<std::uint64_t>();
  if (parser.good()) message.data = parser.rest();
  return if_good(parser, message);
}

std::optional<Chunk> parse_chunk(ByteView content) {
  Parser parser(content);
  Chunk chunk;
  chunk.start_time = parser.number<std::uint64_t>();
  chunk.end_time = parser.number<std::uint64_t>();
  chunk.uncompressed_size = parser.number<std::uint64_t>();
  chunk.uncompressed_crc = parser.number<std::uint32_t>();
  chunk.compression = parser.text();
  chunk.records = parser.sized(parser.number<std::uint64_t>());
  return if_good(parser, std::move(chunk));
}

std::optional<MessageIndex> parse_message_index(ByteView content) {
  Parser parser(content);
  MessageIndex index;
  index.channel_id = parser.number<std::uint16_t>();
  Parser entries(parser.sized(parser.number<std::uint32_t>()));
  while (parser.good() && entries.good() && !entries.empty()) {
    const auto time = entries.number<std::uint64_t>();
    index.entries.emplace_back(time, entries.number<std::uint64_t>());
  }
  return entries.good() ? if_good(parser, std::move(index)) : std::nullopt;
}

std::optional<Metadata> parse_metadata(ByteView content) {
  Parser parser(content);
  Metadata metadata;
  metadata.name = parser.text();
  metadata.entries = parser.map();
  return if_good(parser, std::move(metadata));
}

std::uint32_t crc_of(ByteView bytes, std::uint32_t so_far) {
  return static_cast<std::uint32_t>(crc32_z(so_far, bytes.data(), bytes.size()));
}

}  // namespace skein::mcap
