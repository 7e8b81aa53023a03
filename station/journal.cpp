#include "station/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/text/sha256.hpp"
#include "process/files/nowhere.hpp"

namespace skein::station {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kHashBytes = 8;
constexpr std::size_t kHeadBytes = sizeof(std::uint32_t) + kHashBytes;

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) {
  throw std::system_error(errno, std::generic_category(), "journal " + file.string() + ": " + what);
}

template <class Integer>
void put(Bytes& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}

void put(Bytes& bytes, float value) { put(bytes, std::bit_cast<std::uint32_t>(value)); }

/// Reads what put() wrote; past the end it reads zeros and ok() is false.
class Cursor {
 public:
  explicit Cursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class Integer>
  Integer get() {
    if (bytes_.size() < sizeof(Integer)) {
      ok_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) value |= std::uint64_t{bytes_[i]} << (8 * i);
    bytes_ = bytes_.subspan(sizeof(Integer));
    return static_cast<Integer>(value);
  }
  float get_float() { return std::bit_cast<float>(get<std::uint32_t>()); }
  std::size_t left() const { return bytes_.size(); }
  bool ok() const { return ok_; }

 private:
  std::span<const std::uint8_t> bytes_;
  bool ok_ = true;
};

constexpr std::string_view kMagic = "skeinjnl";

Bytes encode_head(RunId run) {
  Bytes head(kMagic.begin(), kMagic.end());
  put(head, static_cast<std::uint64_t>(run));
  return head;
}

Bytes encode(const TallyRecord& record) {
  Bytes body;
  const LedgerEntry& entry = record.entry;
  put(body, record.tick);
  put(body, entry.index);
  put(body, entry.tick);
  put(body, static_cast<std::uint64_t>(entry.uav));
  put(body, static_cast<std::uint8_t>(entry.collision));
  put(body, static_cast<std::uint64_t>(entry.capture.uav));
  put(body, entry.capture.capture);
  put(body, entry.capture.tick);
  put(body, entry.capture.token);
  put(body, static_cast<std::uint32_t>(entry.capture.points.size()));
  for (const CapturePoint& point : entry.capture.points) {
    put(body, point.index);
    put(body, point.q_blur);
    put(body, point.q_res);
    put(body, point.q);
    put(body, point.q_distance);
  }
  return body;
}

std::optional<TallyRecord> decode(std::span<const std::uint8_t> body) {
  Cursor cursor(body);
  TallyRecord record;
  LedgerEntry& entry = record.entry;
  record.tick = cursor.get<Tick>();
  entry.index = cursor.get<std::uint64_t>();
  entry.tick = cursor.get<Tick>();
  entry.uav = UavIndex(cursor.get<std::uint64_t>());
  entry.collision = cursor.get<std::uint8_t>() != 0;
  entry.capture.uav = UavIndex(cursor.get<std::uint64_t>());
  entry.capture.capture = cursor.get<std::uint64_t>();
  entry.capture.tick = cursor.get<Tick>();
  entry.capture.token = cursor.get<std::uint64_t>();
  for (std::uint32_t left = cursor.get<std::uint32_t>(); left > 0 && cursor.ok(); --left) {
    CapturePoint point;
    point.index = cursor.get<std::uint32_t>();
    point.q_blur = cursor.get_float();
    point.q_res = cursor.get_float();
    point.q = cursor.get_float();
    point.q_distance = cursor.get_float();
    entry.capture.points.push_back(point);
  }
  if (!cursor.ok() || cursor.left() > 0) return std::nullopt;
  return record;
}

/// First bytes of the body's hash.
std::array<std::uint8_t, kHashBytes> short_hash(std::span<const std::uint8_t> body) {
  const auto digest = Sha256().add(body).digest();
  std::array<std::uint8_t, kHashBytes> head;
  std::copy_n(digest.begin(), kHashBytes, head.begin());
  return head;
}

/// The body of the record at the start of `bytes`, or nullopt when it is cut off or broken.
std::optional<std::span<const std::uint8_t>> whole_body(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeadBytes) return std::nullopt;
  const std::size_t length = Cursor(bytes).get<std::uint32_t>();
  if (bytes.size() - kHeadBytes < length) return std::nullopt;
  const auto body = bytes.subspan(kHeadBytes, length);
  const auto hash = bytes.subspan(sizeof(std::uint32_t), kHashBytes);
  if (!std::ranges::equal(hash, short_hash(body))) return std::nullopt;
  return body;
}

Bytes read_all(int descriptor, const std::filesystem::path& file) {
  Bytes bytes;
  std::array<std::uint8_t, 65536> chunk;
  while (true) {
    const ssize_t got = ::read(descriptor, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(file, "cannot be read");
    if (got == 0) return bytes;
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + got);
  }
}

}  // namespace

Journal::Journal(const std::filesystem::path& file, RunId run) : file_(file), ended_(is_nowhere(file)) {
  if (ended_) return;
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(file_, "cannot be opened");
  try {
    replay(run);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::replay(RunId run) {
  const Bytes bytes = read_all(descriptor_, file_), head = encode_head(run);
  std::span<const std::uint8_t> rest(bytes);
  const bool ours = rest.size() >= head.size() && std::ranges::equal(rest.first(head.size()), head);
  if (ours) {
    rest = rest.subspan(head.size());
    while (const auto body = whole_body(rest)) {
      std::optional<TallyRecord> record = decode(*body);
      if (!record) break;
      replayed_.push_back(std::move(*record));
      rest = rest.subspan(kHeadBytes + body->size());
    }
  }
  if (!rest.empty() && ::ftruncate(descriptor_, static_cast<off_t>(bytes.size() - rest.size())) != 0) {
    fail(file_, "its broken end cannot be cut off");
  }
  if (!ours) write_error_ = write(head);
}

std::string Journal::append(std::span<const TallyRecord> records) {
  if (ended_) return std::exchange(write_error_, {});
  Bytes bytes;
  for (const TallyRecord& record : records) {
    const Bytes body = encode(record);
    put(bytes, static_cast<std::uint32_t>(body.size()));
    const auto hash = short_hash(body);
    bytes.insert(bytes.end(), hash.begin(), hash.end());
    bytes.insert(bytes.end(), body.begin(), body.end());
  }
  return write(bytes);
}

std::string Journal::write(std::span<const std::uint8_t> rest) {
  while (!rest.empty()) {
    const ssize_t put_out = ::write(descriptor_, rest.data(), rest.size());
    if (put_out < 0 && errno == EINTR) continue;
    if (put_out < 0) {
      ended_ = true;  // replay() cuts off a record that is not whole
      return "cannot write " + file_.string() + ": " + std::generic_category().message(errno);
    }
    rest = rest.subspan(static_cast<std::size_t>(put_out));
  }
  return {};
}

}  // namespace skein::station
