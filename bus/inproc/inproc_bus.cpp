#include "bus/inproc/inproc_bus.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <utility>

#include "bus/wire.hpp"

namespace skein::bus {

namespace {

struct Endpoint {
  int domain = 0;
  ParticipantId participant = 0;
  TopicSpec topic;
};

struct ReaderEnd : Endpoint {
  OnSample on_sample;
  bool alive = true;  // a callback may destroy readers while a sample is on its way to them
};

struct WriterEnd : Endpoint {
  std::deque<std::vector<std::uint8_t>> latched;
};

/// What DDS asks for: same topic and type, and the writer offers at least what the reader requests.
bool match(const WriterEnd& writer, const ReaderEnd& reader) {
  return writer.domain == reader.domain && writer.participant != reader.participant &&
         writer.topic.name == reader.topic.name && writer.topic.type == reader.topic.type &&
         writer.topic.qos.reliable >= reader.topic.qos.reliable && writer.topic.qos.latched >= reader.topic.qos.latched;
}

/// All endpoints of this process. One lock for all domains, recursive, since callbacks write and subscribe.
class Exchange {
 public:
  /// Buses that know nothing of each other must meet, as they do over a network: hence one for the process.
  static Exchange& instance() {
    static Exchange exchange;
    return exchange;
  }

  ParticipantId next_id() {
    const std::scoped_lock lock(mutex_);
    const std::uint64_t number = ++participants_;
    std::array<std::uint8_t, 12> prefix{};
    for (std::size_t i = 0; i < 8; ++i) prefix[11 - i] = static_cast<std::uint8_t>(number >> (8 * i));
    return participant_id(prefix);
  }

  void add(const std::shared_ptr<WriterEnd>& writer) {
    const std::scoped_lock lock(mutex_);
    writers_.push_back(writer);
  }

  void add(const std::shared_ptr<ReaderEnd>& reader) {
    const std::scoped_lock lock(mutex_);
    readers_.push_back(reader);
    if (!reader->topic.qos.latched) return;
    const auto writers = writers_;
    for (const auto& writer : writers) {
      if (!match(*writer, *reader)) continue;
      const auto latched = writer->latched;
      for (const auto& payload : latched) deliver(*writer, *reader, payload);
    }
  }

  void remove(const std::shared_ptr<WriterEnd>& writer) {
    const std::scoped_lock lock(mutex_);
    std::erase(writers_, writer);
  }

  void remove(const std::shared_ptr<ReaderEnd>& reader) {
    const std::scoped_lock lock(mutex_);
    std::erase(readers_, reader);
    reader->alive = false;
  }

  void write(WriterEnd& writer, const std::vector<std::uint8_t>& payload) {
    const std::scoped_lock lock(mutex_);
    if (writer.topic.qos.latched) {
      writer.latched.push_back(payload);
      if (writer.latched.size() > static_cast<std::size_t>(writer.topic.qos.depth)) writer.latched.pop_front();
    }
    const auto readers = readers_;
    for (const auto& reader : readers)
      if (match(writer, *reader)) deliver(writer, *reader, payload);
  }

  std::vector<ParticipantId> readers_of(const WriterEnd& writer) {
    const std::scoped_lock lock(mutex_);
    std::vector<ParticipantId> ids;
    for (const auto& reader : readers_)
      if (match(writer, *reader)) ids.push_back(reader->participant);
    return ids;
  }

  std::vector<ParticipantId> writers_of(const ReaderEnd& reader) {
    const std::scoped_lock lock(mutex_);
    std::vector<ParticipantId> ids;
    for (const auto& writer : writers_)
      if (match(*writer, reader)) ids.push_back(writer->participant);
    return ids;
  }

 private:
  static void deliver(const WriterEnd& writer, ReaderEnd& reader, const std::vector<std::uint8_t>& payload) {
    if (reader.alive) reader.on_sample({payload, writer.participant});
  }

  std::recursive_mutex mutex_;
  std::uint64_t participants_ = 0;
  std::vector<std::shared_ptr<WriterEnd>> writers_;
  std::vector<std::shared_ptr<ReaderEnd>> readers_;
};

class InprocWriter : public Writer {
 public:
  explicit InprocWriter(std::shared_ptr<WriterEnd> end) : end_(std::move(end)) { Exchange::instance().add(end_); }
  ~InprocWriter() override { Exchange::instance().remove(end_); }

  void write(std::span<const std::uint8_t> payload) override { Exchange::instance().write(*end_, padded(payload)); }
  std::vector<ParticipantId> matched() const override { return Exchange::instance().readers_of(*end_); }

 private:
  std::shared_ptr<WriterEnd> end_;
};

class InprocReader : public Reader {
 public:
  explicit InprocReader(std::shared_ptr<ReaderEnd> end) : end_(std::move(end)) { Exchange::instance().add(end_); }
  ~InprocReader() override { Exchange::instance().remove(end_); }

  std::vector<ParticipantId> matched() const override { return Exchange::instance().writers_of(*end_); }

 private:
  std::shared_ptr<ReaderEnd> end_;
};

class InprocParticipant : public Participant {
 public:
  InprocParticipant(int domain, std::shared_ptr<Unsent> unsent)
      : Participant(std::move(unsent)), domain_(domain), id_(Exchange::instance().next_id()) {}

  ParticipantId id() const override { return id_; }

  std::unique_ptr<Writer> create_writer(const TopicSpec& topic) override {
    return std::make_unique<InprocWriter>(std::make_shared<WriterEnd>(WriterEnd{{domain_, id_, topic}, {}}));
  }

  std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) override {
    return std::make_unique<InprocReader>(
        std::make_shared<ReaderEnd>(ReaderEnd{{domain_, id_, topic}, std::move(on_sample)}));
  }

 private:
  int domain_;
  ParticipantId id_;
};

class InprocBus : public Bus {
 public:
  using Bus::Bus;
  std::unique_ptr<Participant> join(int domain) override {
    check_domain(domain);
    return std::make_unique<InprocParticipant>(domain, unsent());
  }
};

}  // namespace

std::unique_ptr<Bus> make_inproc_bus(RunId run) { return std::make_unique<InprocBus>(run); }

}  // namespace skein::bus
