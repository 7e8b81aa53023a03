#include "recording/mcap/writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace skein::mcap {
namespace {

constexpr const char* kZstd = "zstd";

Bytes compressed(ByteView bytes, int level) {
  Bytes result(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  result.resize(size);
  return result;
}

}  // namespace

// ---- summary ----------------------------------------------------------------------------------------------------

void Summary::add(ChunkIndex index, const std::vector<MessageIndex>& messages) {
  std::uint64_t count = 0;
  for (const MessageIndex& one : messages) {
    statistics_.messages_by_channel[one.channel_id] += one.entries.size();
    count += one.entries.size();
  }
  if (count > 0) {
    const bool first = statistics_.messages == 0;
    statistics_.start_time = first ? index.start_time : std::min(statistics_.start_time, index.start_time);
    statistics_.end_time = std::max(statistics_.end_time, index.end_time);
  }
  statistics_.messages += count;
  chunks_.push_back(std::move(index));
}

void Summary::write(Output& out) const {
  Bytes bytes;
  append(bytes, DataEnd{out.crc()});
  const std::size_t data_end = bytes.size();
  std::vector<SummaryOffset> groups;
  const auto add_group = [&](Opcode opcode, const auto& append_all) {
    const std::size_t start = bytes.size();
    append_all();
    if (bytes.size() > start) groups.push_back({opcode, out.size() + start, bytes.size() - start});
  };
  add_group(Opcode::schema, [&] {
    for (const auto& [id, schema] : schemas_) append(bytes, schema);
  });
  add_group(Opcode::channel, [&] {
    for (const auto& [id, channel] : channels_) append(bytes, channel);
  });
  add_group(Opcode::statistics, [&] {
    Statistics statistics = statistics_;
    statistics.schemas = static_cast<std::uint16_t>(schemas_.size());
    statistics.channels = static_cast<std::uint32_t>(channels_.size());
    statistics.chunks = static_cast<std::uint32_t>(chunks_.size());
    statistics.metadata = static_cast<std::uint32_t>(metadata_.size());
    append(bytes, statistics);
  });
  add_group(Opcode::chunk_index, [&] {
    for (const ChunkIndex& chunk : chunks_) append(bytes, chunk);
  });
  add_group(Opcode::metadata_index, [&] {
    for (const MetadataIndex& metadata : metadata_) append(bytes, metadata);
  });
  Footer footer{.summary_start = out.size() + data_end, .summary_offset_start = out.size() + bytes.size()};
  for (const SummaryOffset& group : groups) append(bytes, group);
  const std::size_t before_footer = bytes.size();
  append(bytes, footer);
  // The checksum is over everything before it; it is the last four bytes of the footer.
  footer.summary_crc = crc_of(ByteView(bytes).subspan(data_end, bytes.size() - data_end - sizeof(std::uint32_t)));
  bytes.resize(before_footer);
  append(bytes, footer);
  bytes.insert(bytes.end(), std::begin(kMagic), std::end(kMagic));
  out.write(bytes);
}

void write_head(Output& out) {
  Bytes bytes(std::begin(kMagic), std::end(kMagic));
  append(bytes, Header{.profile = "ros2", .library = "skein"});
  out.write(bytes);
}

void write_metadata(Output& out, Summary& summary, const Metadata& metadata) {
  Bytes bytes;
  append(bytes, metadata);
  const std::uint64_t offset = out.size();
  out.write(bytes);
  summary.add(MetadataIndex{offset, bytes.size(), metadata.name});
}

// ---- writer -----------------------------------------------------------------------------------------------------

Writer::Writer(const std::filesystem::path& file, const WriterOptions& options) : options_(options), out_(file) {
  write_head(out_);
}

std::uint16_t Writer::add_channel(const std::string& topic, const std::string& schema_name,
                                  const std::string& definition, const StringMap& metadata) {
  const auto next_id = [&](std::size_t used) {
    if (used + options_.first_id > options_.last_id) throw std::length_error("a recording has no room for " + topic);
    return static_cast<std::uint16_t>(options_.first_id + used);
  };
  const std::uint16_t channel = next_id(summary_.channels().size());
  std::uint16_t schema = 0;
  if (!schema_name.empty()) {
    const auto [entry, fresh] = schema_ids_.try_emplace(schema_name, next_id(schema_ids_.size()));
    if (fresh) summary_.add(Schema{entry->second, schema_name, "ros2msg", definition});
    schema = entry->second;
  }
  summary_.add(Channel{channel, schema, topic, "cdr", metadata});
  return channel;
}

void Writer::write(std::uint16_t channel, std::uint64_t time, ByteView data, std::uint32_t sequence) {
  const bool other_window = !chunk_messages_.empty() && time / options_.chunk_ns != start_time_ / options_.chunk_ns;
  if (other_window || chunk_.size() >= options_.chunk_bytes) flush();
  if (told_channels_.insert(channel).second) {
    const Channel& record = summary_.channels().at(channel);
    const bool has_schema = record.schema_id != 0;
    if (has_schema && told_schemas_.insert(record.schema_id).second)
      append(chunk_, summary_.schemas().at(record.schema_id));
    append(chunk_, record);
  }
  const bool first = chunk_messages_.empty();
  start_time_ = first ? time : std::min(start_time_, time);
  end_time_ = first ? time : std::max(end_time_, time);
  MessageIndex& index = chunk_messages_[channel];
  index.channel_id = channel;
  index.entries.emplace_back(time, chunk_.size());
  append(chunk_, Message{channel, sequence, time, time, data});
}

void Writer::write_metadata(const Metadata& metadata) {
  flush();
  mcap::write_metadata(out_, summary_, metadata);
}

void Writer::flush() {
  if (chunk_messages_.empty()) return;
  const Bytes packed = compressed(chunk_, options_.zstd_level);
  Bytes bytes;
  append(bytes, Chunk{start_time_, end_time_, chunk_.size(), crc_of(chunk_), kZstd, packed});
  ChunkIndex index{.start_time = start_time_,
                   .end_time = end_time_,
                   .offset = out_.size(),
                   .length = bytes.size(),
                   .message_indexes = {},
                   .message_indexes_length = 0,
                   .compression = kZstd,
                   .compressed_size = packed.size(),
                   .uncompressed_size = chunk_.size()};
  std::vector<MessageIndex> messages;
  for (auto& [channel, entries] : chunk_messages_) {
    index.message_indexes[channel] = out_.size() + bytes.size();
    append(bytes, entries);
    messages.push_back(std::move(entries));
  }
  index.message_indexes_length = bytes.size() - index.length;
  out_.write(bytes);
  if (write_error().empty()) summary_.add(std::move(index), messages);
  chunk_.clear();
  chunk_messages_.clear();
}

void Writer::close() {
  if (closed_) return;
  closed_ = true;
  flush();
  summary_.write(out_);
}

}  // namespace skein::mcap
