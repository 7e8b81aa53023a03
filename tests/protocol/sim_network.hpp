// A network made of events, whose order a test chooses: discovery reaches the two ends of a connection at different
// times, samples overtake those of other connections, processes die with samples in flight. Harsher than DDS: samples
// that arrive before the reader has matched are lost. Single-threaded.
#pragma once

#include <deque>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "core/math/random_stream.hpp"

namespace skein::test {

class SimNetwork;

/// One process's access to the network; it is killed as a whole.
class SimBus final : public bus::Bus {
 public:
  explicit SimBus(SimNetwork& network, RunId run = RunId::none) : Bus(run), network_(network) {}
  std::unique_ptr<bus::Participant> join(int domain) override;

 private:
  SimNetwork& network_;
};

class SimNetwork {
 public:
  /// Something that may happen next.
  struct Event {
    enum class Kind { match_writer, match_reader, deliver } kind;
    std::size_t connection;
  };
  std::vector<Event> events() const;
  void happen(const Event& event);
  const std::string& topic_of(const Event& event) const { return connections_[event.connection].writer->topic.name; }
  /// Of the samples of dead processes that are still in flight, drops a random tail from each connection.
  void lose_tails_of_the_dead(RandomStream& random);
  /// Destroys all writers of a topic in a domain; what they write from now on is lost.
  void close_writers(int domain, const std::string& topic);
  /// Loses the next sample on a topic in a domain, on its way to all readers.
  void lose_next(int domain, const std::string& topic) { to_lose_.emplace(domain, topic); }
  /// The events that are still pending, for the message of a failing test.
  std::string describe() const;

 private:
  friend class SimBus;
  friend class SimParticipant;
  friend class SimWriter;
  friend class SimReader;

  struct WriterEnd {
    int domain = 0;
    bus::TopicSpec topic;
    bus::ParticipantId who = 0;
    bool alive = true;
    std::deque<std::vector<std::uint8_t>> history;  ///< latched only
    std::vector<bus::ParticipantId> matched;
  };
  struct ReaderEnd {
    int domain = 0;
    bus::TopicSpec topic;
    bus::ParticipantId who = 0;
    bool alive = true;
    bus::OnSample on_sample;
    std::vector<bus::ParticipantId> matched;
  };
  struct Connection {
    std::shared_ptr<WriterEnd> writer;
    std::shared_ptr<ReaderEnd> reader;
    bool writer_matched = false, reader_matched = false;
    std::deque<std::vector<std::uint8_t>> under_way;
  };

  void add(std::shared_ptr<WriterEnd> writer);
  void add(std::shared_ptr<ReaderEnd> reader);
  void connect(const std::shared_ptr<WriterEnd>& writer, const std::shared_ptr<ReaderEnd>& reader);
  void write(const std::shared_ptr<WriterEnd>& writer, std::span<const std::uint8_t> payload);
  void remove(const std::shared_ptr<WriterEnd>& writer);
  void remove(const std::shared_ptr<ReaderEnd>& reader);

  bus::ParticipantId next_id_ = 100;
  std::vector<std::shared_ptr<WriterEnd>> writers_;
  std::vector<std::shared_ptr<ReaderEnd>> readers_;
  std::vector<Connection> connections_;
  std::set<std::pair<int, std::string>> to_lose_;
};

}  // namespace skein::test
