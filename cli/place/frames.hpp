// The protocol between the launcher and the processes that start programs for it on other hosts, over any pair of byte
// streams (ssh, srun). A frame is a line of JSON; if that has a positive "bytes", as many bytes and an end of line
// follow. A host begins with the line kHostGreeting; the launcher skips the lines that a login shell prints before it.
// Pure; an object belongs to one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "process/json_text.hpp"

namespace skein::cli {

/// The first line that a host sends.
inline constexpr std::string_view kHostGreeting = "skein-host 1";
/// An end that has been silent for kSilence counts as gone. Each end sends something every kSpeak.
inline constexpr std::chrono::milliseconds kSilence{10000}, kSpeak{1000};
/// Largest file that is sent, or read for a digest [bytes].
inline constexpr std::uintmax_t kLargestPlacedFile = 1'000'000'000;

struct Frame {
  Json head;         ///< an object
  std::string body;  ///< bytes of a file or a log
  /// head[key] as text; empty: there is none.
  std::string text(const char* key) const { return text_in(head, key); }
};

/// A frame as bytes; sets "bytes". Invalid UTF-8 in `head` is replaced.
std::string bytes_of(const Json& head, std::string_view body = {});

/// Splits a received stream into frames.
class FrameReader {
 public:
  /// @param greeted  true: the stream begins with frames; false: everything up to kHostGreeting is skipped.
  explicit FrameReader(bool greeted) : greeted_(greeted) {}

  void add(std::string_view bytes) { bytes_ += bytes; }
  /// The next frame; nullopt: it has not arrived completely. @throws std::runtime_error for bytes that are not a frame.
  std::optional<Frame> next();
  /// The bytes before the greeting; if there are more than 4096, the last 4096 of them.
  const std::string& before_greeting() const { return before_; }

 private:
  bool skip_to_greeting();

  bool greeted_;
  std::string bytes_, before_;
};

}  // namespace skein::cli
