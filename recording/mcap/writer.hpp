// Writes an MCAP file: messages in compressed chunks, with message indexes and checksums, and a summary at the end. All
// complete chunks of a truncated file can be read; flush() ends a chunk early. The same calls give the same bytes.
// Not thread-safe. A write error ends the file, never the program (output.hpp).
#pragma once

#include <filesystem>
#include <map>
#include <set>

#include "recording/mcap/output.hpp"
#include "recording/mcap/records.hpp"

namespace skein::mcap {

struct WriterOptions {
  std::size_t chunk_bytes = 1 << 20;        ///< uncompressed size from which on a chunk ends
  std::uint64_t chunk_ns = 10'000'000'000;  ///< length of time windows; all messages of a chunk are in one window
  int zstd_level = 1;                       ///< [1, 19]
  std::uint16_t first_id = 1;               ///< of schemas and of channels; parts to be joined need different ids
  std::uint16_t last_id = 65'535;
};

/// Collects what the summary of a file contains about its data section.
class Summary {
 public:
  void add(const Schema& schema) { schemas_.emplace(schema.id, schema); }
  void add(const Channel& channel) { channels_.emplace(channel.id, channel); }
  /// Adds a chunk. @param index  with the chunk's offset in the file. @param messages  its message indexes.
  void add(ChunkIndex index, const std::vector<MessageIndex>& messages);
  void add(const MetadataIndex& metadata) { metadata_.push_back(metadata); }
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  /// Writes everything after the data section: DataEnd, the summary, the footer and the magic.
  void write(Output& out) const;

 private:
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  Statistics statistics_;
};

/// Writes the magic and Skein's header, with the profile "ros2".
void write_head(Output& out);
/// Writes a Metadata record, and adds it to the summary.
void write_metadata(Output& out, Summary& summary, const Metadata& metadata);

class Writer {
 public:
  /// @throws std::system_error, with the file's name, if it cannot be opened.
  explicit Writer(const std::filesystem::path& file, const WriterOptions& options = {});
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Adds a channel for a topic; each call adds another one. @returns its id.
  /// @param schema_name  message type; empty: unknown. @param metadata  of the channel, for other tools.
  /// @throws std::length_error if all ids are used up.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name, const std::string& definition,
                            const StringMap& metadata = {});
  /// Adds a message. @param time  of the message [ns]; need not be ascending. @param sequence  number at its source.
  void write(std::uint16_t channel, std::uint64_t time, ByteView data, std::uint32_t sequence = 0);
  void write_metadata(const Metadata& metadata);
  /// Ends the chunk: all messages so far survive a crash of this process.
  void flush();
  /// Writes the summary; no other call may follow. The destructor does it, too.
  void close();
  const std::string& write_error() const { return out_.write_error(); }

 private:
  const WriterOptions options_;
  Output out_;
  Summary summary_;
  std::map<std::string, std::uint16_t> schema_ids_;       ///< by name
  std::set<std::uint16_t> told_schemas_, told_channels_;  ///< ids whose records are in the file or in `chunk_`
  Bytes chunk_;                                           ///< uncompressed records of the chunk
  std::map<std::uint16_t, MessageIndex> chunk_messages_;
  std::uint64_t start_time_ = 0, end_time_ = 0;  ///< of the chunk's messages
  bool closed_ = false;
};

}  // namespace skein::mcap
