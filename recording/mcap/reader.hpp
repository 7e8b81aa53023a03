// Reads an MCAP file from its beginning, whole or cut off: as far as its records are whole, and no further than to a
// chunk whose checksum is wrong. Needs no summary. damage() finds what a checksum can tell. Not thread-safe.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

/// Largest chunk that is read, uncompressed: more is taken for damage.
inline constexpr std::uint64_t kLargestChunk = 1ULL << 30;

/// The records of a chunk. @returns nullopt when it is damaged or compressed in another way than by zstd.
std::optional<Bytes> unpack(const Chunk& chunk);

class Reader {
 public:
  /// @throws InputError when it cannot be read or is no MCAP file.
  explicit Reader(const std::filesystem::path& file);
  /// @throws InputError when it is cut off or damaged, too.
  static Reader whole(const std::filesystem::path& file);

  /// What is damaged, a sentence each: which chunk, where it begins, and the times whose messages are missing.
  /// Empty: nothing. A file that is cut off is not damaged. Unpacks every chunk.
  std::vector<std::string> damage() const;

  /// Calls `on_record` for each record of the data section, in order, chunks packed as they are.
  /// @param on_record  gets the record and where it stands in the file.
  void records(const std::function<void(const RawRecord&, std::uint64_t offset)>& on_record) const;
  /// The same for the summary, of which files that are cut off have none.
  void summary(const std::function<void(const RawRecord&)>& on_record) const;
  /// Calls `on_message` for each message, in the order of the file. The channel is valid as long as this.
  void messages(const std::function<void(const Channel&, const Message&)>& on_message);
  /// Known after messages().
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  const std::map<std::string, StringMap>& metadata() const { return metadata_; }
  /// Whether the file ends as it should: with a footer.
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
