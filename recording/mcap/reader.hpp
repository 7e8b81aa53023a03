// Reads an MCAP file, complete or truncated, from its beginning up to the first incomplete record; messages() also
// stops at the first damaged chunk. Needs no summary. damage() finds all damage that checksums reveal. Not thread-safe.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

/// Largest uncompressed size of a chunk [bytes]; a larger one counts as damaged.
inline constexpr std::uint64_t kLargestChunk = 1ULL << 30;

/// The uncompressed records of a chunk. Memory grows with the records, whatever size the chunk states.
/// @returns nullopt if the chunk is damaged or states another size than its records have, or if its compression is
///   neither none nor zstd.
std::optional<Bytes> unpack(const Chunk& chunk);

class Reader {
 public:
  /// Reads the whole file into memory. @throws InputError if it cannot be read or is not an MCAP file.
  explicit Reader(const std::filesystem::path& file);
  /// Opens a file that must be complete and undamaged. @throws InputError also if it is truncated or damaged.
  static Reader whole(const std::filesystem::path& file);

  /// One sentence for each damage: which chunk, where it begins, and the times whose messages are missing.
  /// Empty: the file is undamaged. A truncated file does not count as damaged. Uncompresses every chunk.
  std::vector<std::string> damage() const;

  /// Calls `on_record` for each record of the data section, in order; chunks stay compressed.
  /// @param on_record  receives the record and its offset in the file [bytes].
  void records(const std::function<void(const RawRecord&, std::uint64_t offset)>& on_record) const;
  /// The same for the summary. A truncated file has none.
  void summary(const std::function<void(const RawRecord&)>& on_record) const;
  /// Calls `on_message` for each message, in the order of the file. The channel is valid as long as this reader, the
  /// message only during the call.
  void messages(const std::function<void(const Channel&, const Message&)>& on_message);
  /// The following are known after messages().
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  const std::map<std::string, StringMap>& metadata() const { return metadata_; }
  /// Whether the file is complete: it ends with a footer.
  bool complete() const { return footer().has_value(); }

 private:
  std::optional<Footer> footer() const;
  bool data_is_sound(std::uint64_t end) const;
  bool summary_is_sound() const;
  void take(const RawRecord& record, const std::function<void(const Channel&, const Message&)>& on_message);

  std::filesystem::path file_;
  std::string bytes_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::string, StringMap> metadata_;
};

}  // namespace skein::mcap
