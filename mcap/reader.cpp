#include "mcap/reader.hpp"

#include <zstd.h>

#include <algorithm>

#include "core/file_bytes.hpp"
#include "core/types.hpp"

namespace skein::mcap {
namespace {

constexpr std::uintmax_t kLargestFile = 1ULL << 36;

ByteView view(const std::string& bytes) { return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}; }

}  // namespace

std::optional<Bytes> unpack(const Chunk& chunk) {
  Bytes records;
  if (chunk.compression.empty()) {
    records.assign(chunk.records.begin(), chunk.records.end());
  } else if (chunk.compression == "zstd" && chunk.uncompressed_size <= kLargestChunk) {
    records.resize(chunk.uncompressed_size);
    const std::size_t size =
        ZSTD_decompress(records.data(), records.size(), chunk.records.data(), chunk.records.size());
    if (ZSTD_isError(size) != 0 || size != records.size()) return std::nullopt;
  } else {
    return std::nullopt;
  }
  if (chunk.uncompressed_crc != 0 && crc_of(records) != chunk.uncompressed_crc) return std::nullopt;
  return records;
}

Reader::Reader(const std::filesystem::path& file) : bytes_(read_file_bytes(file, kLargestFile)) {
  const ByteView bytes = view(bytes_);
  if (bytes.size() < sizeof(kMagic) || !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin())) {
    throw InputError(file.string() + ": is no MCAP file");
  }
}

Reader Reader::whole(const std::filesystem::path& file) {
  Reader reader(file);
  if (!reader.complete()) throw InputError(file.string() + ": the recording is cut off; only a whole one will do");
  return reader;
}

void Reader::records(const std::function<void(const RawRecord&, std::uint64_t)>& on_record) const {
  ByteView left = view(bytes_).subspan(sizeof(kMagic));
  for (;;) {
    const std::uint64_t offset = bytes_.size() - left.size();
    const auto record = take_record(left);
    if (!record || record->opcode == Opcode::data_end) return;
    on_record(*record, offset);
  }
}

void Reader::summary(const std::function<void(const RawRecord&)>& on_record) const {
  const auto end = footer();
  if (!end || end->summary_start == 0 || end->summary_start > bytes_.size()) return;
  ByteView left = view(bytes_).subspan(end->summary_start);
  while (const auto record = take_record(left)) {
    if (record->opcode == Opcode::footer) return;
    on_record(*record);
  }
}

void Reader::messages(const std::function<void(const Channel&, const Message&)>& on_message) {
  bool sound = true;
  records([&](const RawRecord& record, std::uint64_t) {
    if (!sound) return;
    if (record.opcode != Opcode::chunk) return take(record, on_message);
    const auto chunk = parse_chunk(record.content);
    const auto unpacked = chunk ? unpack(*chunk) : std::nullopt;
    sound = unpacked.has_value();
    if (!sound) return;
    ByteView left(*unpacked);
    while (const auto inner = take_record(left)) take(*inner, on_message);
  });
}

void Reader::take(const RawRecord& record, const std::function<void(const Channel&, const Message&)>& on_message) {
  if (record.opcode == Opcode::schema) {
    if (const auto schema = parse_schema(record.content)) schemas_.emplace(schema->id, *schema);
  } else if (record.opcode == Opcode::channel) {
    if (const auto channel = parse_channel(record.content)) channels_.emplace(channel->id, *channel);
  } else if (record.opcode == Opcode::metadata) {
    if (const auto metadata = parse_metadata(record.content)) metadata_[metadata->name] = metadata->entries;
  } else if (record.opcode == Opcode::message) {
    const auto message = parse_message(record.content);
    const auto channel = message ? channels_.find(message->channel_id) : channels_.end();
    if (channel != channels_.end()) on_message(channel->second, *message);
  }
}

std::optional<Footer> Reader::footer() const {
  constexpr std::size_t kTail = kRecordHead + 20 + sizeof(kMagic);
  if (bytes_.size() < kTail + sizeof(kMagic)) return std::nullopt;
  ByteView tail = view(bytes_).last(kTail);
  const auto record = take_record(tail);
  if (!record || record->opcode != Opcode::footer || !std::equal(tail.begin(), tail.end(), std::begin(kMagic))) {
    return std::nullopt;
  }
  return parse_footer(record->content);
}

}  // namespace skein::mcap
