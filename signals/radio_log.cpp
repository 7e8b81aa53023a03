#include "signals/radio_log.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <tuple>

#include "core/radio/radio_routes.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"

namespace skein::signals {
namespace {

constexpr const char* kArrivals = "/skein/arrivals";

/// Reads a serialised message (CDR, little-endian) field by field. A field that is cut off yields 0 or an empty text,
/// and whole() becomes false.
class Cdr {
 public:
  explicit Cdr(mcap::ByteView bytes) : bytes_(bytes.size() < kHead ? mcap::ByteView() : bytes.subspan(kHead)) {}

  template <class T>
  T number() {
    at_ = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
    T value{};
    if (at_ + sizeof(T) > bytes_.size()) {
      whole_ = false;
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  std::string text() {
    const auto length = number<std::uint32_t>();  // with its final zero
    if (length == 0 || length > bytes_.size() - std::min(at_, bytes_.size())) {
      whole_ = false;
      return {};
    }
    std::string value(reinterpret_cast<const char*>(bytes_.data()) + at_, length - 1);
    at_ += length;
    return value;
  }
  bool whole() const { return whole_; }

 private:
  static constexpr std::size_t kHead = 4;  ///< bytes that describe the encoding
  static_assert(std::endian::native == std::endian::little);

  mcap::ByteView bytes_;
  std::size_t at_ = 0;
  bool whole_ = true;
};

/// The arrival of a message at a node, with the router's number of the message.
struct Arrived {
  std::string source, target, topic;
  std::uint64_t number = 0, step = 0;
};

void read_arrivals(mcap::ByteView data, std::vector<Arrived>& arrived) {
  Cdr cdr(data);
  cdr.number<std::int32_t>();  // its stamp
  cdr.number<std::uint32_t>();
  const auto step = cdr.number<std::uint64_t>();
  for (auto left = cdr.number<std::uint32_t>(); left > 0 && cdr.whole(); --left) {
    Arrived one;
    one.source = cdr.text();
    one.target = cdr.text();
    one.topic = cdr.text();
    one.number = cdr.number<std::uint64_t>();
    one.step = step;
    if (cdr.whole()) arrived.push_back(std::move(one));
  }
}

/// The node and ROS topic of a channel of the recording; nullopt: the channel belongs to no node.
std::optional<RadioStream> stream_of(const std::string& channel, const std::vector<std::string>& nodes) {
  for (const std::string& node : nodes) {
    if (channel.starts_with("/" + node + "/")) return RadioStream{node, channel.substr(node.size() + 1)};
  }
  return std::nullopt;
}

class LogReader {
 public:
  LogReader(const std::filesystem::path& file, const Scenario& scenario)
      : reader_(mcap::Reader::whole(file)), scenario_(scenario), nodes_(scenario.uav_names()) {
    nodes_.push_back(scenario.node_name(kStationNode));
    for (const RadioRoute& route : radio_routes(scenario))
      add_stream({scenario.node_name(route.source), route.ros_topic});
  }

  RadioLog read() {
    reader_.messages([this](const mcap::Channel& channel, const mcap::Message& message) { take(channel, message); });
    for (const Arrived& one : arrived_) add_stream({one.source, one.topic});
    for (const auto& [channel, messages] : messages_) {
      const auto stream = streams_.find(channel);
      if (stream == streams_.end()) continue;
      for (const auto& [number, step] : messages) {
        log_.sent[stream->second].push_back(step);
        numbered_[{stream->second, number}].push_back(step);
      }
    }
    for (const Arrived& one : arrived_) add_arrival(one);
    return std::move(log_);
  }

 private:
  /// Adds a stream under its channel in the recording: the topic, with the node's name in front if it lacks that.
  void add_stream(const RadioStream& stream) {
    const std::string prefix = "/" + stream.source;
    streams_.emplace(stream.topic.starts_with(prefix + "/") ? stream.topic : prefix + stream.topic, stream);
  }

  std::uint64_t step_of(std::uint64_t time_ns) const {
    return static_cast<std::uint64_t>(std::llround(1e-9 * static_cast<double>(time_ns) / scenario_.exchange_period_s));
  }

  void take(const mcap::Channel& channel, const mcap::Message& message) {
    if (channel.topic == kArrivals) return read_arrivals(message.data, arrived_);
    const auto stream = stream_of(channel.topic, nodes_);
    if (!stream) return;
    const std::uint64_t step = step_of(message.log_time);
    constexpr std::string_view kDebug = "/debug/";
    if (stream->topic.starts_with(kDebug)) {
      log_.debug[{stream->source, stream->topic.substr(kDebug.size())}].push_back(
          {step, Cdr(message.data).number<double>()});
    } else {
      messages_[channel.topic].emplace_back(message.sequence, step);
    }
  }

  /// Numbers start anew when a program restarts, so the message is the last one with its number that was sent by then.
  void add_arrival(const Arrived& one) {
    const RadioStream stream{one.source, one.topic};
    const auto found = numbered_.find({stream, one.number});
    if (found == numbered_.end()) return;
    const auto after = std::ranges::upper_bound(found->second, one.step);
    if (after == found->second.begin()) return;
    const std::uint64_t sent = *std::prev(after);
    const bool is_new = seen_.emplace(stream, one.target, one.number, sent).second;
    log_.arrivals.push_back({stream, one.target, sent, one.step + 1, !is_new});
  }

  mcap::Reader reader_;
  const Scenario& scenario_;
  std::vector<std::string> nodes_;
  std::map<std::string, RadioStream> streams_;                                            ///< by channel
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::uint64_t>>> messages_;  ///< number, step
  std::map<std::pair<RadioStream, std::uint64_t>, std::vector<std::uint64_t>> numbered_;
  std::set<std::tuple<RadioStream, std::string, std::uint64_t, std::uint64_t>> seen_;
  std::vector<Arrived> arrived_;
  RadioLog log_;
};

}  // namespace

RadioLog read_radio_log(const std::filesystem::path& dir, const Scenario& scenario) {
  const std::filesystem::path file = dir / run_folder::kRecording;
  if (!std::filesystem::exists(file)) {
    throw InputError(file.string() + ": is missing; signals of messages come from it, so fly with --record=run");
  }
  return LogReader(file, scenario).read();
}

}  // namespace skein::signals
