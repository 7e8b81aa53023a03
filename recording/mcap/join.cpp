#include "recording/mcap/join.hpp"

#include <algorithm>
#include <memory>

#include "core/types.hpp"
#include "recording/mcap/output.hpp"
#include "recording/mcap/reader.hpp"
#include "recording/mcap/writer.hpp"

namespace skein::mcap {
namespace {

/// A chunk of a part, with the message indexes that follow it.
struct Packed {
  Chunk chunk;
  std::vector<MessageIndex> messages;
};

std::vector<Packed> packed_of(const Reader& part) {
  std::vector<Packed> chunks;
  part.records([&](const RawRecord& record, std::uint64_t) {
    if (record.opcode == Opcode::chunk) {
      if (auto chunk = parse<Chunk>(record.content)) chunks.push_back({std::move(*chunk), {}});
    } else if (record.opcode == Opcode::message_index && !chunks.empty()) {
      if (auto index = parse<MessageIndex>(record.content)) chunks.back().messages.push_back(std::move(*index));
    }
  });
  return chunks;
}

void learn_name(const RawRecord& record, Summary& summary) {
  if (record.opcode == Opcode::schema) {
    if (const auto schema = parse<Schema>(record.content)) summary.add(*schema);
  } else if (record.opcode == Opcode::channel) {
    if (const auto channel = parse<Channel>(record.content)) summary.add(*channel);
  }
}

/// Adds the part's schemas and channels to the summary of the joined file. They are in the part's own summary. A
/// truncated part has none, but its chunks contain them, too.
void learn_names(const Reader& part, Summary& summary) {
  if (part.complete()) return part.summary([&](const RawRecord& record) { learn_name(record, summary); });
  for (const Packed& packed : packed_of(part)) {
    const auto records = unpack(packed.chunk);
    if (!records) continue;
    ByteView left(*records);
    while (const auto record = take_record(left)) learn_name(*record, summary);
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
  Summary summary;
  for (const std::filesystem::path& part : parts) {
    try {
      readers.push_back(std::make_unique<Reader>(part));
      for (const std::string& damage : readers.back()->damage()) {
        trouble += (trouble.empty() ? "" : "; ") + part.filename().string() + ": " + damage;
      }
      learn_names(*readers.back(), summary);
      std::ranges::move(packed_of(*readers.back()), std::back_inserter(chunks));
    } catch (const InputError& error) {
      trouble += (trouble.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  std::ranges::stable_sort(chunks, {}, [](const Packed& packed) { return packed.chunk.start_time; });
  Output out(file);
  write_head(out);
  for (const Packed& packed : chunks) copy(packed, out, summary);
  for (const Metadata& one : metadata) write_metadata(out, summary, one);
  summary.write(out);
  return out.write_error().empty() ? trouble : out.write_error();
}

}  // namespace skein::mcap
