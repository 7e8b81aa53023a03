#include "mcap/join.hpp"

#include <algorithm>
#include <memory>

#include "core/types.hpp"
#include "mcap/output.hpp"
#include "mcap/reader.hpp"
#include "mcap/writer.hpp"

namespace skein::mcap {
namespace {

/// A chunk of a part, with the indexes that follow it.
struct Packed {
  Chunk chunk;
  ByteView content;
  std::vector<MessageIndex> messages;
};

std::vector<Packed> packed_of(const Reader& part) {
  std::vector<Packed> chunks;
  part.records([&](const RawRecord& record, std::uint64_t) {
    if (record.opcode == Opcode::chunk) {
      if (auto chunk = parse_chunk(record.content)) chunks.push_back({std::move(*chunk), record.content, {}});
    } else if (record.opcode == Opcode::message_index && !chunks.empty()) {
      if (auto index = parse_message_index(record.content)) chunks.back().messages.push_back(std::move(*index));
    }
  });
  return chunks;
}

/// Schemas and channels stand where they are first used.
void learn_names(const Packed& packed, Summary& summary) {
  const auto records = unpack(packed.chunk);
  if (!records) return;
  ByteView left(*records);
  while (const auto record = take_record(left)) {
    if (record->opcode == Opcode::schema) {
      if (const auto schema = parse_schema(record->content)) summary.add(*schema);
    } else if (record->opcode == Opcode::channel) {
      if (const auto channel = parse_channel(record->content)) summary.add(*channel);
    }
  }
}

void copy(const Packed& packed, Output& out, Summary& summary) {
  Bytes bytes;
  append(bytes, packed.chunk);
  ChunkIndex index{.start_time = packed.chunk.start_time,
                   .end_time = packed.chunk.end_time,
                   .offset = out.size(),
                   .length = bytes.size(),
                   .message_indexes = {},
                   .message_indexes_length = 0,
                   .compression = packed.chunk.compression,
                   .compressed_size = packed.chunk.records.size(),
                   .uncompressed_size = packed.chunk.uncompressed_size};
  for (const MessageIndex& one : packed.messages) {
    index.message_indexes[one.channel_id] = out.size() + bytes.size();
    append(bytes, one);
  }
  index.message_indexes_length = bytes.size() - index.length;
  out.write(bytes);
  summary.add(std::move(index), packed.messages);
}

}  // namespace

std::string join(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& file,
                 const std::vector<Metadata>& metadata) {
  std::string trouble;
  std::vector<std::unique_ptr<Reader>> readers;
  std::vector<Packed> chunks;
  for (const std::filesystem::path& part : parts) {
    try {
      readers.push_back(std::make_unique<Reader>(part));
      std::ranges::move(packed_of(*readers.back()), std::back_inserter(chunks));
    } catch (const InputError& error) {
      trouble = error.what();
    }
  }
  std::ranges::stable_sort(chunks, {}, [](const Packed& packed) { return packed.chunk.start_time; });
  Output out(file);
  Summary summary;
  write_head(out);
  for (const Packed& packed : chunks) {
    learn_names(packed, summary);
    copy(packed, out, summary);
  }
  for (const Metadata& one : metadata) write_metadata(out, summary, one);
  summary.write(out);
  return out.trouble().empty() ? trouble : out.trouble();
}

}  // namespace skein::mcap
