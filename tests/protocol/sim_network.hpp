// A network made of events, for exploring every order of them: discovery that reaches the two ends of a connection at
// different times, samples that overtake those of other connections, processes that die with samples under way.
// Harsher than DDS: what arrives before the reader has matched is lost. Single-threaded.
#pragma once

#include <deque>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "core/random_stream.hpp"

namespace skein::test {

class SimNetwork;

/// One process's way into the network; killed as a whole.
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
  /// Samples of the dead that are still under way: cuts a random tail off each of their connections.
  void lose_tails_of_the_dead(RandomStream& random);
  /// All writers of a topic in a domain are destroyed; what they write from now on goes nowhere.
  void close_writers(int domain, const std::string& topic);
  /// The next sample on a topic in a domain is lost on its way to everybody.
  void lose_next(int domain, const std::string& topic) { to_lose_.emplace(domain, topic); }
  /// What is not at rest, for a failing test.
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
