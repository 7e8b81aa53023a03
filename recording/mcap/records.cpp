#include "recording/mcap/records.hpp"

#include <zlib.h>

#include <concepts>
#include <type_traits>
#include <utility>

namespace skein::mcap {
namespace {

void set(Bytes& out, std::size_t at, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) out[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// Appends a length field, and then the bytes that `body` appends.
template <class Length, class Body>
void put_sized(Bytes& out, Body body) {
  const std::size_t at = out.size();
  out.resize(at + sizeof(Length));
  body();
  set(out, at, out.size() - at - sizeof(Length), sizeof(Length));
}

/// Appends the fields of a record.
class FieldWriter {
 public:
  explicit FieldWriter(Bytes& out) : out_(out) {}

  void operator()(const auto&... fields) { (put(fields), ...); }
  void rest(ByteView bytes) { out_.insert(out_.end(), bytes.begin(), bytes.end()); }
  void sized(ByteView bytes) {
    put_sized<std::uint64_t>(out_, [&] { rest(bytes); });
  }

 private:
  template <std::unsigned_integral T>
  void put(const T& value) {
    out_.resize(out_.size() + sizeof(T));
    set(out_, out_.size() - sizeof(T), value, sizeof(T));
  }
  void put(Opcode opcode) { put(static_cast<std::uint8_t>(opcode)); }
  void put(const std::string& text) {
    put_sized<std::uint32_t>(out_, [&] { out_.insert(out_.end(), text.begin(), text.end()); });
  }
  /// A map or a list of pairs.
  void put(const auto& entries) {
    put_sized<std::uint32_t>(out_, [&] {
      for (const auto& [key, value] : entries) (*this)(key, value);
    });
  }

  Bytes& out_;
};

/// Reads values from the front of the bytes. After an incomplete value, good() is false and all values are empty.
class FieldParser {
 public:
  explicit FieldParser(ByteView bytes) : left_(bytes) {}

  void operator()(auto&... fields) { (get(fields), ...); }
  void rest(ByteView& bytes) { bytes = std::exchange(left_, {}); }
  void sized(ByteView& bytes) { bytes = take(number<std::uint64_t>()); }

  template <std::unsigned_integral T>
  T number() {
    const ByteView bytes = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value = static_cast<T>(value | static_cast<T>(T{bytes[i]} << (8 * i)));
    return value;
  }
  bool good() const { return good_; }

 private:
  template <std::unsigned_integral T>
  void get(T& value) {
    value = number<T>();
  }
  void get(std::string& text) {
    const ByteView bytes = take(number<std::uint32_t>());
    text.assign(bytes.begin(), bytes.end());
  }
  /// A map or a list of pairs. Of entries with the same key, a map keeps the last.
  template <class Entries>
  void get(Entries& entries) {
    FieldParser parser(take(number<std::uint32_t>()));
    while (parser.good_ && !parser.left_.empty()) {
      std::pair<std::remove_const_t<typename Entries::value_type::first_type>,
                typename Entries::value_type::second_type>
          entry;
      parser(entry.first, entry.second);
      if constexpr (requires { entries.insert_or_assign(entry.first, entry.second); }) {
        entries.insert_or_assign(std::move(entry.first), std::move(entry.second));
      } else {
        entries.push_back(std::move(entry));
      }
    }
    good_ = good_ && parser.good_;
  }
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

}  // namespace

template <class Record>
void append(Bytes& out, const Record& record) {
  FieldWriter writer(out);
  writer(Record::kOpcode);
  put_sized<std::uint64_t>(out, [&] { Record::each_field(writer, record); });
}

template <class Record>
std::optional<Record> parse(ByteView content) {
  FieldParser parser(content);
  Record record;
  Record::each_field(parser, record);
  return parser.good() ? std::optional(std::move(record)) : std::nullopt;
}

template void append(Bytes&, const Header&);
template void append(Bytes&, const Footer&);
template void append(Bytes&, const Schema&);
template void append(Bytes&, const Channel&);
template void append(Bytes&, const Message&);
template void append(Bytes&, const Chunk&);
template void append(Bytes&, const MessageIndex&);
template void append(Bytes&, const ChunkIndex&);
template void append(Bytes&, const Statistics&);
template void append(Bytes&, const Metadata&);
template void append(Bytes&, const MetadataIndex&);
template void append(Bytes&, const SummaryOffset&);
template void append(Bytes&, const DataEnd&);
template std::optional<Footer> parse(ByteView);
template std::optional<Schema> parse(ByteView);
template std::optional<Channel> parse(ByteView);
template std::optional<Message> parse(ByteView);
template std::optional<Chunk> parse(ByteView);
template std::optional<MessageIndex> parse(ByteView);
template std::optional<Metadata> parse(ByteView);
template std::optional<DataEnd> parse(ByteView);

std::optional<RawRecord> take_record(ByteView& bytes) {
  FieldParser parser(bytes);
  RawRecord record{static_cast<Opcode>(parser.number<std::uint8_t>()), {}};
  parser.sized(record.content);
  if (!parser.good()) return std::nullopt;
  parser.rest(bytes);
  return record;
}

std::uint32_t crc_of(ByteView bytes, std::uint32_t so_far) {
  return static_cast<std::uint32_t>(crc32_z(so_far, bytes.data(), bytes.size()));
}

}  // namespace skein::mcap
