#include "cli/place/frames.hpp"

#include <algorithm>
#include <stdexcept>

namespace skein::cli {
namespace {

constexpr std::size_t kLongestHead = 32 << 20;  // [bytes]; a program's report is part of one
constexpr std::size_t kLongestBody = 1 << 30;
constexpr std::size_t kKeptBefore = 4096;

}  // namespace

std::string bytes_of(const Json& head, std::string_view body) {
  Json with_size = head;
  if (!body.empty()) with_size["bytes"] = body.size();
  // Text that a program wrote need not be valid UTF-8.
  std::string bytes = with_size.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
  if (!body.empty()) bytes.append(body).append("\n");
  return bytes;
}

std::optional<Frame> FrameReader::next() {
  if (!greeted_ && !skip_to_greeting()) return std::nullopt;
  const std::size_t line = bytes_.find('\n');
  if (line == std::string::npos) {
    if (bytes_.size() > kLongestHead) throw std::runtime_error("a line that is too long");
    return std::nullopt;
  }
  Frame frame{parse_json(bytes_.substr(0, line)), {}};
  if (!frame.head.is_object())
    throw std::runtime_error("something that is not a message of Skein: " +
                             bytes_.substr(0, std::min(line, std::size_t{80})));
  const std::size_t size = value_or(frame.head, "bytes", std::size_t{0}).get<std::size_t>();
  if (size > kLongestBody) throw std::runtime_error("a message of " + std::to_string(size) + " bytes");
  const std::size_t whole = line + 1 + (size == 0 ? 0 : size + 1);
  if (bytes_.size() < whole) return std::nullopt;
  frame.body = bytes_.substr(line + 1, size);
  bytes_.erase(0, whole);
  return frame;
}

bool FrameReader::skip_to_greeting() {
  while (!greeted_) {
    const std::size_t end = bytes_.find('\n');
    if (end == std::string::npos) return false;
    std::string line = bytes_.substr(0, end);
    bytes_.erase(0, end + 1);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    greeted_ = line == kHostGreeting;
    if (!greeted_) before_ += line + "\n";
    if (before_.size() > kKeptBefore) before_.erase(0, before_.size() - kKeptBefore);
  }
  return true;
}

}  // namespace skein::cli
