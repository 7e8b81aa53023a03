#include "recording/mcap/reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"
#include "core/types.hpp"

namespace skein::mcap {
namespace {

constexpr std::uintmax_t kLargestFile = 1ULL << 36;

/// The values that the header of a chunk and the indexes after it must have, computed from the chunk's messages.
struct ChunkFacts {
  std::uint64_t start_time = 0, end_time = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;
};

/// @returns nullopt if the chunk or a record in it is damaged, or the times in its header are wrong.
std::optional<ChunkFacts> facts_of(const std::optional<Chunk>& chunk) {
  const auto records = chunk ? unpack(*chunk) : std::nullopt;
  if (!records) return std::nullopt;
  ChunkFacts facts;
  bool first = true;
  ByteView left(*records);
  while (!left.empty()) {
    const std::uint64_t offset = records->size() - left.size();
    const auto record = take_record(left);
    if (!record) return std::nullopt;
    if (record->opcode != Opcode::message) continue;
    const auto message = parse<Message>(record->content);
    if (!message) return std::nullopt;
    facts.index[message->channel_id].emplace_back(message->log_time, offset);
    facts.start_time = first ? message->log_time : std::min(facts.start_time, message->log_time);
    facts.end_time = first ? message->log_time : std::max(facts.end_time, message->log_time);
    first = false;
  }
  const bool header_holds = first || (facts.start_time == chunk->start_time && facts.end_time == chunk->end_time);
  return header_holds ? std::optional(std::move(facts)) : std::nullopt;
}

std::string time_text(std::uint64_t time_ns) { return fixed(1e-9 * static_cast<double>(time_ns), 2) + " s"; }

/// Collects the damage of a data section, record by record.
class DamageSearch {
 public:
  void look_at(const RawRecord& record, std::uint64_t offset) {
    if (record.opcode == Opcode::chunk) return look_at_chunk(record, offset);
    if (record.opcode != Opcode::message_index || !chunk_) return;
    const auto index = parse<MessageIndex>(record.content);
    const auto found = index ? chunk_->index.find(index->channel_id) : chunk_->index.end();
    if (found != chunk_->index.end() && found->second == index->entries) return;
    damage_.push_back("the index of chunk " + std::to_string(number_) + ", at byte " + std::to_string(offset) +
                      ", is damaged; the chunk's messages are all there");
  }
  /// The time from which on messages may be missing: after the last undamaged chunk. For people.
  std::string sound_until() const { return last_sound_ ? "after " + time_text(*last_sound_) : "from the start on"; }
  std::vector<std::string> damage() && { return std::move(damage_); }

 private:
  void look_at_chunk(const RawRecord& record, std::uint64_t offset) {
    ++number_;
    const auto chunk = parse<Chunk>(record.content);
    chunk_ = facts_of(chunk);
    if (chunk_) {
      last_sound_ = chunk_->end_time;
      return;
    }
    damage_.push_back(
        "chunk " + std::to_string(number_) + ", at byte " + std::to_string(offset) +
        ", is damaged: its messages are missing" +
        (chunk ? " (by its head, of " + time_text(chunk->start_time) + " to " + time_text(chunk->end_time) + ")"
               : std::string()));
  }

  int number_ = 0;
  std::optional<ChunkFacts> chunk_;  ///< the latest chunk; nullopt if it is damaged
  std::optional<std::uint64_t> last_sound_;
  std::vector<std::string> damage_;
};

/// Decompresses as much as the frames really have. A damaged size may have any value, so memory grows with what comes
/// out, and is not allocated for the size that the file states.
/// @param size  stated size. @returns false if the frames are damaged, or have another size.
bool decompress(ByteView packed, std::uint64_t size, Bytes& bytes) {
  constexpr std::uint64_t kFirst = 1 << 20;  // as much as the chunks of our own recordings have
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  bytes.resize(std::min(size, kFirst));
  ZSTD_outBuffer out{bytes.data(), bytes.size(), 0};
  for (std::size_t left = 0; in.pos < in.size || left > 0;) {
    const std::size_t read = in.pos, written = out.pos;
    left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left) != 0) return false;
    if (out.pos == out.size && out.size < size) {
      bytes.resize(std::min<std::uint64_t>(size, 2 * out.size));
      out.dst = bytes.data();
      out.size = bytes.size();
    } else if (in.pos == read && out.pos == written) {
      return false;  // cut off, or more comes out than is stated
    }
  }
  return out.pos == size;
}

ByteView view(const std::string& bytes) { return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}; }

}  // namespace

std::optional<Bytes> unpack(const Chunk& chunk) {
  if (chunk.uncompressed_size > kLargestChunk) return std::nullopt;
  Bytes records;
  if (chunk.compression.empty()) {
    if (chunk.records.size() != chunk.uncompressed_size) return std::nullopt;
    records.assign(chunk.records.begin(), chunk.records.end());
  } else if (chunk.compression != "zstd" || !decompress(chunk.records, chunk.uncompressed_size, records)) {
    return std::nullopt;
  }
  if (chunk.uncompressed_crc != 0 && crc_of(records) != chunk.uncompressed_crc) return std::nullopt;
  return records;
}

Reader::Reader(const std::filesystem::path& file) : file_(file), bytes_(read_file_bytes(file, kLargestFile)) {
  const ByteView bytes = view(bytes_);
  if (bytes.size() < sizeof(kMagic) || !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin())) {
    throw InputError(file.string() + ": is not an MCAP file, or its first bytes are damaged");
  }
}

Reader Reader::whole(const std::filesystem::path& file) {
  Reader reader(file);
  if (!reader.complete()) {
    throw InputError(
        file.string() +
        ": the recording is cut off, or its end is damaged; only a complete, undamaged recording can be used");
  }
  if (const auto damage = reader.damage(); !damage.empty()) {
    std::string text = file.string() + ": the recording is damaged; only a complete, undamaged recording can be used";
    for (const std::string& one : damage) text += "\n  " + one;
    throw InputError(text);
  }
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

std::vector<std::string> Reader::damage() const {
  DamageSearch search;
  std::uint64_t end = sizeof(kMagic);
  records([&](const RawRecord& record, std::uint64_t offset) {
    search.look_at(record, offset);
    end = offset + kRecordHead + record.content.size();
  });
  const std::string sound_until = search.sound_until();
  std::vector<std::string> damage = std::move(search).damage();
  if (!complete()) return damage;
  ByteView rest = view(bytes_).subspan(end);
  const auto data_end = take_record(rest);
  if (!data_end || data_end->opcode != Opcode::data_end) {
    damage.push_back("from byte " + std::to_string(end) + " on it cannot be read: what was recorded " + sound_until +
                     " is missing");
  } else if (damage.empty() && !data_is_sound(end)) {
    damage.push_back("the checksum over its data is wrong, though every chunk is sound");
  }
  if (damage.empty() && !summary_is_sound()) damage.push_back("the checksum over its summary is wrong");
  return damage;
}

/// Whether the checksum over the data section is right, and the summary begins after the DataEnd record.
/// @param end  offset of the end of the data section, where its DataEnd record begins [bytes].
bool Reader::data_is_sound(std::uint64_t end) const {
  const ByteView all = view(bytes_);
  ByteView rest = all.subspan(end);
  const auto record = take_record(rest);
  const auto data_end = record ? parse<DataEnd>(record->content) : std::nullopt;
  const auto at_end = footer();
  if (!data_end || !at_end) return false;
  const std::uint64_t after = all.size() - rest.size();
  const std::uint32_t crc = data_end->data_section_crc;
  return (at_end->summary_start == 0 || at_end->summary_start == after) && (crc == 0 || crc == crc_of(all.first(end)));
}

bool Reader::summary_is_sound() const {
  const auto end = footer();
  if (!end) return false;
  if (end->summary_crc == 0) return true;
  const std::uint64_t covered = bytes_.size() - sizeof(kMagic) - sizeof(std::uint32_t);
  if (end->summary_start > covered) return false;
  return crc_of(view(bytes_).subspan(end->summary_start, covered - end->summary_start)) == end->summary_crc;
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
    const auto chunk = parse<Chunk>(record.content);
    const auto unpacked = chunk ? unpack(*chunk) : std::nullopt;
    sound = unpacked.has_value();
    if (!sound) return;
    ByteView left(*unpacked);
    while (const auto inner = take_record(left)) take(*inner, on_message);
  });
}

void Reader::take(const RawRecord& record, const std::function<void(const Channel&, const Message&)>& on_message) {
  if (record.opcode == Opcode::schema) {
    if (const auto schema = parse<Schema>(record.content)) schemas_.emplace(schema->id, *schema);
  } else if (record.opcode == Opcode::channel) {
    if (const auto channel = parse<Channel>(record.content)) channels_.emplace(channel->id, *channel);
  } else if (record.opcode == Opcode::metadata) {
    if (const auto metadata = parse<Metadata>(record.content)) metadata_[metadata->name] = metadata->entries;
  } else if (record.opcode == Opcode::message) {
    const auto message = parse<Message>(record.content);
    const auto channel = message ? channels_.find(message->channel_id) : channels_.end();
    if (channel != channels_.end()) on_message(channel->second, *message);
  }
}

std::optional<Footer> Reader::footer() const {
  Bytes any;  // all footers have the same length
  append(any, Footer{});
  const std::size_t length = any.size() + sizeof(kMagic);
  if (bytes_.size() < length + sizeof(kMagic)) return std::nullopt;
  ByteView tail = view(bytes_).last(length);
  const auto record = take_record(tail);
  if (!record || record->opcode != Opcode::footer || !std::equal(tail.begin(), tail.end(), std::begin(kMagic))) {
    return std::nullopt;
  }
  return parse<Footer>(record->content);
}

}  // namespace skein::mcap
