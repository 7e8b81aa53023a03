#include "bus/inproc/inproc_bus.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "bus/wire.hpp"
#include "core/types.hpp"

namespace skein::bus {

namespace {

struct Channel;

struct Endpoint {
  Channel& channel;
  ParticipantId participant = 0;
  TopicSpec topic;
  bool alive = true;  ///< false: removed, perhaps by a callback during a delivery to it, or its bus has vanished
};

struct ReaderEnd : Endpoint {
  OnSample on_sample;
};

struct WriterEnd : Endpoint {
  std::deque<std::vector<std::uint8_t>> latched;
};

template <class End>
using Ends = std::vector<std::shared_ptr<End>>;

/// All endpoints of one topic in one domain. Lists are replaced, never modified, so a loop over one stays valid.
struct Channel {
  std::recursive_mutex* mutex = nullptr;  ///< the domain's
  std::shared_ptr<const Ends<WriterEnd>> writers = std::make_shared<Ends<WriterEnd>>();
  std::shared_ptr<const Ends<ReaderEnd>> readers = std::make_shared<Ends<ReaderEnd>>();
};

template <class End>
void add_to(std::shared_ptr<const Ends<End>>& ends, const std::shared_ptr<End>& end) {
  auto more = std::make_shared<Ends<End>>(*ends);
  more->push_back(end);
  ends = std::move(more);
}

/// Removes the endpoints that meet a condition. @returns these.
template <class End, class Condition>
Ends<End> remove_from(std::shared_ptr<const Ends<End>>& ends, Condition condition) {
  Ends<End> out;
  auto rest = std::make_shared<Ends<End>>();
  for (const auto& end : *ends) (condition(*end) ? out : *rest).push_back(end);
  if (!out.empty()) ends = std::move(rest);
  return out;
}

/// Whether two endpoints on one topic match, by DDS's rules: same type, and the writer offers at least the QoS that the
/// reader requests. Endpoints of one participant do not match, and removed ones match none.
bool match(const WriterEnd& writer, const ReaderEnd& reader) {
  return writer.alive && reader.alive && writer.participant != reader.participant &&
         writer.topic.type == reader.topic.type && writer.topic.qos.reliable >= reader.topic.qos.reliable &&
         writer.topic.qos.latched >= reader.topic.qos.latched;
}

/// All endpoints of this process. Each domain has its own lock, so that agents on different threads do not wait for
/// each other; it is recursive, because callbacks write and subscribe in their own domain. No thread holds two of them.
class Exchange {
 public:
  /// One object for the whole process: separate buses must find each other, as over a network.
  static Exchange& instance() {
    static Exchange exchange;
    return exchange;
  }

  ParticipantId next_id() {
    const std::uint64_t number = ++participants_;
    std::array<std::uint8_t, 12> prefix{};
    for (std::size_t i = 0; i < 8; ++i) prefix[11 - i] = static_cast<std::uint8_t>(number >> (8 * i));
    return participant_id(prefix);
  }

  std::shared_ptr<WriterEnd> add_writer(int domain, ParticipantId participant, const TopicSpec& topic) {
    Channel& channel = channel_of(domain, topic.name);
    const std::scoped_lock lock(*channel.mutex);
    auto writer = std::make_shared<WriterEnd>(WriterEnd{{channel, participant, topic}, {}});
    add_to(channel.writers, writer);
    return writer;
  }

  std::shared_ptr<ReaderEnd> add_reader(int domain, ParticipantId participant, const TopicSpec& topic,
                                        OnSample on_sample) {
    Channel& channel = channel_of(domain, topic.name);
    const std::scoped_lock lock(*channel.mutex);
    auto reader = std::make_shared<ReaderEnd>(ReaderEnd{{channel, participant, topic}, std::move(on_sample)});
    add_to(channel.readers, reader);
    if (!topic.qos.latched) return reader;
    const auto writers = channel.writers;
    for (const auto& writer : *writers) {
      if (!match(*writer, *reader)) continue;
      const auto latched = writer->latched;
      for (const auto& payload : latched) deliver(*writer, *reader, payload);
    }
    return reader;
  }

  void remove(const WriterEnd& writer) {
    const std::scoped_lock lock(*writer.channel.mutex);
    remove_from(writer.channel.writers, [&](const WriterEnd& end) { return &end == &writer; });
  }

  void remove(ReaderEnd& reader) {
    const std::scoped_lock lock(*reader.channel.mutex);
    remove_from(reader.channel.readers, [&](const ReaderEnd& end) { return &end == &reader; });
    reader.alive = false;
  }

  /// Removes all endpoints of these participants.
  void remove(const std::set<ParticipantId>& participants) {
    const auto theirs = [&](const Endpoint& end) { return participants.contains(end.participant); };
    for (Channel* channel : channels()) {
      const std::scoped_lock lock(*channel->mutex);
      for (const auto& writer : remove_from(channel->writers, theirs)) writer->alive = false;
      for (const auto& reader : remove_from(channel->readers, theirs)) reader->alive = false;
    }
  }

  void write(WriterEnd& writer, const std::vector<std::uint8_t>& payload) {
    const std::scoped_lock lock(*writer.channel.mutex);
    if (writer.topic.qos.latched) {
      writer.latched.push_back(payload);
      if (writer.latched.size() > static_cast<std::size_t>(writer.topic.qos.depth)) writer.latched.pop_front();
    }
    const auto readers = writer.channel.readers;
    for (const auto& reader : *readers) {
      if (match(writer, *reader)) deliver(writer, *reader, payload);
    }
  }

  std::vector<ParticipantId> readers_of(const WriterEnd& writer) {
    const std::scoped_lock lock(*writer.channel.mutex);
    std::vector<ParticipantId> ids;
    for (const auto& reader : *writer.channel.readers) {
      if (match(writer, *reader)) ids.push_back(reader->participant);
    }
    return ids;
  }

  std::vector<ParticipantId> writers_of(const ReaderEnd& reader) {
    const std::scoped_lock lock(*reader.channel.mutex);
    std::vector<ParticipantId> ids;
    for (const auto& writer : *reader.channel.writers) {
      if (match(*writer, reader)) ids.push_back(writer->participant);
    }
    return ids;
  }

  bool has_readers(const WriterEnd& writer) {
    const std::scoped_lock lock(*writer.channel.mutex);
    const Ends<ReaderEnd>& readers = *writer.channel.readers;
    return std::any_of(readers.begin(), readers.end(), [&](const auto& reader) { return match(writer, *reader); });
  }

 private:
  static void deliver(const WriterEnd& writer, ReaderEnd& reader, const std::vector<std::uint8_t>& payload) {
    if (reader.alive) reader.on_sample({payload, writer.participant});
  }

  /// The channel of a topic; created at the first call, never removed.
  Channel& channel_of(int domain, const std::string& topic) {
    const std::scoped_lock lock(mutex_);
    const auto [at, is_new] = channels_.try_emplace({domain, topic});
    if (is_new) at->second.mutex = &domains_[domain];  // shared by all channels of the domain
    return at->second;
  }

  std::vector<Channel*> channels() {
    const std::scoped_lock lock(mutex_);
    std::vector<Channel*> all;
    for (auto& [key, channel] : channels_) all.push_back(&channel);
    return all;
  }

  std::atomic<std::uint64_t> participants_ = 0;
  std::mutex mutex_;  ///< guards the two maps below; never held during a callback
  std::map<std::pair<int, std::string>, Channel> channels_;  ///< by domain and topic
  std::map<int, std::recursive_mutex> domains_;
};

class InprocWriter : public Writer {
 public:
  explicit InprocWriter(std::shared_ptr<WriterEnd> end) : end_(std::move(end)) {}
  ~InprocWriter() override { Exchange::instance().remove(*end_); }

  void write(std::span<const std::uint8_t> payload) override { Exchange::instance().write(*end_, padded(payload)); }
  std::vector<ParticipantId> matched() const override { return Exchange::instance().readers_of(*end_); }
  bool has_readers() const override { return Exchange::instance().has_readers(*end_); }

 private:
  const std::shared_ptr<WriterEnd> end_;
};

class InprocReader : public Reader {
 public:
  explicit InprocReader(std::shared_ptr<ReaderEnd> end) : end_(std::move(end)) {}
  ~InprocReader() override { Exchange::instance().remove(*end_); }

  std::vector<ParticipantId> matched() const override { return Exchange::instance().writers_of(*end_); }

 private:
  const std::shared_ptr<ReaderEnd> end_;
};

class InprocParticipant : public Participant {
 public:
  InprocParticipant(int domain, ParticipantId id, std::shared_ptr<Unsent> unsent)
      : Participant(std::move(unsent)), domain_(domain), id_(id) {}

  ParticipantId id() const override { return id_; }

  std::unique_ptr<Writer> create_writer(const TopicSpec& topic) override {
    return std::make_unique<InprocWriter>(Exchange::instance().add_writer(domain_, id_, topic));
  }

  std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) override {
    return std::make_unique<InprocReader>(Exchange::instance().add_reader(domain_, id_, topic, std::move(on_sample)));
  }

 private:
  const int domain_;
  const ParticipantId id_;
};

class InprocBus : public Bus {
 public:
  using Bus::Bus;
  std::unique_ptr<Participant> join(int domain) override {
    if (domain < 0) throw InputError("domain " + std::to_string(domain) + " is out of range: it must be 0 or more");
    const ParticipantId id = Exchange::instance().next_id();
    const std::scoped_lock lock(mutex_);
    joined_.insert(id);
    return std::make_unique<InprocParticipant>(domain, id, unsent());
  }
  void vanish() override {
    const std::scoped_lock lock(mutex_);
    Exchange::instance().remove(joined_);
  }

 private:
  std::mutex mutex_;  ///< programs join from any thread
  std::set<ParticipantId> joined_;
};

}  // namespace

std::unique_ptr<Bus> make_inproc_bus(RunId run) { return std::make_unique<InprocBus>(run); }

}  // namespace skein::bus
