#include "sim_server/run_digest.hpp"

#include <array>
#include <bit>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace skein::sim {
namespace {

constexpr std::size_t kFieldsOfUav = 6;
constexpr std::array<const char*, kFieldsOfUav> kUavFields = {"position",   "attitude", "velocity",
                                                              "body_rates", "gimbal",   "alive"};

/// FNV-1a over whole words: good enough to find the step at which runs differ. The proof of equality is the SHA-256.
class ShortHash {
 public:
  ShortHash& add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) {
      hash_ = (hash_ ^ ((word >> shift) & 0xff)) * 0x100000001b3ULL;
    }
    return *this;
  }
  ShortHash& add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }
  ShortHash& add(const Vector3d& v) { return add(v.x()).add(v.y()).add(v.z()); }
  std::string hex() const {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto folded = static_cast<std::uint32_t>(hash_ ^ (hash_ >> 32));
    std::string text;
    for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[(folded >> shift) & 0xf];
    return text;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// Feeds every value to the running hash and to the short hash of the current field.
class Feed {
 public:
  Feed(Sha256& running, StepDigest& step) : running_(running), step_(step) {}

  template <class T>
  Feed& add(const T& value) {
    running_.add(value);
    if constexpr (std::is_integral_v<T>) {
      field_.add(static_cast<std::uint64_t>(value));
    } else {
      field_.add(value);
    }
    return *this;
  }
  Feed& add(const Quaterniond& q) { return add(q.w()).add(q.x()).add(q.y()).add(q.z()); }
  Feed& add(std::span<const std::uint8_t> bytes) {
    running_.add(bytes.size()).add(bytes);
    for (const std::uint8_t byte : bytes) field_.add(static_cast<std::uint64_t>(byte));
    return *this;
  }
  void end_field() {
    step_.fields.push_back(field_.hex());
    field_ = {};
  }

 private:
  Sha256& running_;
  StepDigest& step_;
  ShortHash field_;
};

}  // namespace

RunDigest::RunDigest(std::span<const std::string> uav_names) {
  for (const std::string& uav : uav_names) {
    for (const char* field : kUavFields) columns_.push_back(uav + "." + field);
  }
  for (const char* field : {"ledger", "radio", "tally"}) columns_.emplace_back(field);
}

StepDigest RunDigest::add(const DigestInput& input) {
  if (kFieldsOfUav * input.uavs.size() + 3 != columns_.size()) {
    throw std::logic_error("the digest was made for a fleet of another size");
  }
  StepDigest step{.k = input.k, .running = {}, .fields = {}};
  Feed feed(running_, step);
  running_.add(input.k);
  for (const DigestInput::Uav& uav : input.uavs) {
    feed.add(uav.state.p_WB).end_field();
    feed.add(uav.state.q_WB).end_field();
    feed.add(uav.state.v_WB).end_field();
    feed.add(uav.state.w_WB_B).end_field();
    feed.add(uav.gimbal.pitch).add(uav.gimbal.yaw).end_field();
    feed.add(uav.alive).end_field();
  }
  feed.add(input.ledger.size());
  for (const LedgerEntry& entry : input.ledger) {
    feed.add(entry.tick).add(entry.uav).add(entry.collision).add(entry.capture.points.size());
    for (const CapturePoint& point : entry.capture.points) feed.add(point.index);
  }
  feed.end_field();
  feed.add(input.radio).end_field();
  feed.add(input.tally).end_field();
  step.running = running_.hex();
  return step;
}

std::string RunDigest::hex() const { return running_.hex(); }

}  // namespace skein::sim
