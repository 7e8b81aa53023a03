// What a launcher and the processes that start programs for it on other hosts say to each other, over whatever carries
// a stream of bytes each way (ssh, srun). A frame is a line of JSON, then as many bytes as its "bytes" says, then an
// end of line. A host begins with a line of its own: what a login shell prints before that is skipped.
// Pure; one thread each.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "process/json_text.hpp"

namespace skein::cli {

/// The first line of a host.
inline constexpr std::string_view kHostGreeting = "skein-host 1";
/// Of silence at the other end, after which it counts as gone. Each end says something every kSpeak.
inline constexpr std::chrono::milliseconds kSilence{10000}, kSpeak{1000};
/// One that is sent, or read for a digest [bytes].
inline constexpr std::uintmax_t kLargestPlacedFile = 1'000'000'000;

struct Frame {
  Json head;         ///< an object
  std::string body;  ///< bytes of a file or a log
  /// head[key] as text; empty: there is none.
  std::string text(const char* key) const { return value_or(head, key, "").get<std::string>(); }
};

std::string bytes_of(const Json& head, std::string_view body = {});

/// Puts a stream together again.
class FrameReader {
 public:
  /// @param greeted  the stream begins with frames; else all before kHostGreeting is skipped.
  explicit FrameReader(bool greeted) : greeted_(greeted) {}

  void add(std::string_view bytes) { bytes_ += bytes; }
  /// The next whole frame; nullopt: it is not here yet. @throws std::runtime_error for what is no frame.
  std::optional<Frame> next();
  /// What came before the greeting, its end if it is long.
  const std::string& before_greeting() const { return before_; }

 private:
  bool skip_to_greeting();

  bool greeted_;
  std::string bytes_, before_;
};

}  // namespace skein::cli
