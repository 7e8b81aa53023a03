// Writes an MCAP file: messages in compressed chunks with an index and checksums, a summary at the end. A file that is
// cut off has all chunks that it holds whole; flush() ends one early. Of the same calls come the same bytes.
// Not thread-safe. A disk that refuses ends the file, never the program (output.hpp).
#pragma once

#include <filesystem>
#include <map>
#include <set>

#include "recording/mcap/output.hpp"
#include "recording/mcap/records.hpp"

namespace skein::mcap {

struct WriterOptions {
  std::size_t chunk_bytes = 1 << 20;        ///< before compression, at least; a single message may be larger
  std::uint64_t chunk_ns = 10'000'000'000;  ///< no chunk has messages of two such windows of time
  int zstd_level = 1;                       ///< [1, 19]
  std::uint16_t first_id = 1;               ///< of schemas and of channels: parts that are joined have different ones
  std::uint16_t last_id = 65'535;
};

/// What the data section of a file says about itself, for its summary.
class Summary {
 public:
  void add(const Schema& schema) { schemas_.emplace(schema.id, schema); }
  void add(const Channel& channel) { channels_.emplace(channel.id, channel); }
  /// A chunk that stands at `index.offset`, with the indexes of its messages.
  void add(ChunkIndex index, const std::vector<MessageIndex>& messages);
  void add(const MetadataIndex& metadata) { metadata_.push_back(metadata); }
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  /// All that follows the data section: DataEnd, the summary, the footer and the magic.
  void write(Output& out) const;

 private:
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;
};

/// The magic and the header of a file of Skein's: profile "ros2".
void write_head(Output& out);
/// A Metadata record, and its entry in the summary.
void write_metadata(Output& out, Summary& summary, const Metadata& metadata);

class Writer {
 public:
  /// @throws std::system_error, with the file's name, when it cannot be opened.
  explicit Writer(const std::filesystem::path& file, const WriterOptions& options = {});
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// @returns the channel of this topic: a new one for each call. @throws std::length_error when all ids are used up.
  /// @param schema_name  empty: nobody knows what its messages are. @param metadata  of the channel, for other tools.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name, const std::string& definition,
                            const StringMap& metadata = {});
  /// @param time  of the message [ns]. Times need not rise. @param sequence  its number at its source.
  void write(std::uint16_t channel, std::uint64_t time, ByteView data, std::uint32_t sequence = 0);
  void write_metadata(const Metadata& metadata);
  /// Ends the chunk: what has been written is safe from the death of this process.
  void flush();
  /// Writes the summary; nothing may follow. The destructor does it, too.
  void close();
  const std::string& trouble() const { return out_.trouble(); }

 private:
  const WriterOptions options_;
  Output out_;
  Summary summary_;
  std::map<std::string, std::uint16_t> schema_ids_;       ///< by name
  std::set<std::uint16_t> told_schemas_, told_channels_;  ///< whose records stand in the file
  Bytes chunk_;                                           ///< records, not compressed yet
  std::map<std::uint16_t, MessageIndex> chunk_messages_;
  std::uint64_t start_time_ = 0, end_time_ = 0;  ///< of the chunk's messages
  bool closed_ = false;
};

}  // namespace skein::mcap
