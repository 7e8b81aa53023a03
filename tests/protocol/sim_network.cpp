#include "tests/protocol/sim_network.hpp"

#include <algorithm>

namespace skein::test {

class SimWriter final : public bus::Writer {
 public:
  SimWriter(SimNetwork& network, std::shared_ptr<SimNetwork::WriterEnd> end)
      : network_(network), end_(std::move(end)) {}
  ~SimWriter() override { network_.remove(end_); }
  void write(std::span<const std::uint8_t> payload) override { network_.write(end_, payload); }
  std::vector<bus::ParticipantId> matched() const override { return end_->matched; }

 private:
  SimNetwork& network_;
  std::shared_ptr<SimNetwork::WriterEnd> end_;
};

class SimReader final : public bus::Reader {
 public:
  SimReader(SimNetwork& network, std::shared_ptr<SimNetwork::ReaderEnd> end)
      : network_(network), end_(std::move(end)) {}
  ~SimReader() override { network_.remove(end_); }
  std::vector<bus::ParticipantId> matched() const override { return end_->matched; }

 private:
  SimNetwork& network_;
  std::shared_ptr<SimNetwork::ReaderEnd> end_;
};

class SimParticipant final : public bus::Participant {
 public:
  SimParticipant(SimNetwork& network, int domain) : network_(network), domain_(domain), id_(network.next_id_++) {}
  bus::ParticipantId id() const override { return id_; }
  std::unique_ptr<bus::Writer> create_writer(const bus::TopicSpec& topic) override {
    auto end = std::make_shared<SimNetwork::WriterEnd>();
    end->domain = domain_;
    end->topic = topic;
    end->who = id_;
    network_.add(end);
    return std::make_unique<SimWriter>(network_, end);
  }
  std::unique_ptr<bus::Reader> create_reader(const bus::TopicSpec& topic, bus::OnSample on_sample) override {
    auto end = std::make_shared<SimNetwork::ReaderEnd>();
    end->domain = domain_;
    end->topic = topic;
    end->who = id_;
    end->on_sample = std::move(on_sample);
    network_.add(end);
    return std::make_unique<SimReader>(network_, end);
  }

 private:
  SimNetwork& network_;
  const int domain_;
  const bus::ParticipantId id_;
};

std::unique_ptr<bus::Participant> SimBus::join(int domain) {
  return std::make_unique<SimParticipant>(network_, domain);
}

void SimNetwork::add(std::shared_ptr<WriterEnd> writer) {
  for (const auto& reader : readers_) connect(writer, reader);
  writers_.push_back(std::move(writer));
}

void SimNetwork::add(std::shared_ptr<ReaderEnd> reader) {
  for (const auto& writer : writers_) connect(writer, reader);
  readers_.push_back(std::move(reader));
}

void SimNetwork::connect(const std::shared_ptr<WriterEnd>& writer, const std::shared_ptr<ReaderEnd>& reader) {
  if (writer->domain != reader->domain || writer->topic.name != reader->topic.name || writer->who == reader->who)
    return;
  connections_.push_back({writer, reader, false, false, {}});
}

void SimNetwork::write(const std::shared_ptr<WriterEnd>& writer, std::span<const std::uint8_t> payload) {
  const std::vector<std::uint8_t> bytes(payload.begin(), payload.end());
  const auto depth = static_cast<std::size_t>(writer->topic.qos.depth);
  if (writer->topic.qos.latched) {
    writer->history.push_back(bytes);
    if (writer->history.size() > depth) writer->history.pop_front();
  }
  if (to_lose_.erase({writer->domain, writer->topic.name}) > 0) return;
  for (Connection& connection : connections_) {
    if (connection.writer != writer || !connection.writer_matched || !connection.reader->alive) continue;
    connection.under_way.push_back(bytes);
    if (connection.under_way.size() > depth) connection.under_way.pop_front();
  }
}

void SimNetwork::close_writers(int domain, const std::string& topic) {
  const std::vector<std::shared_ptr<WriterEnd>> writers = writers_;
  for (const auto& writer : writers) {
    if (writer->domain == domain && writer->topic.name == topic) remove(writer);
  }
}

void SimNetwork::remove(const std::shared_ptr<WriterEnd>& writer) {
  if (!writer->alive) return;
  writer->alive = false;
  std::erase(writers_, writer);
  for (Connection& connection : connections_) {
    if (connection.writer != writer) continue;
    if (connection.reader_matched) {
      auto& matched = connection.reader->matched;
      matched.erase(std::find(matched.begin(), matched.end(), writer->who));
    } else {
      connection.under_way.clear();
    }
  }
}

void SimNetwork::remove(const std::shared_ptr<ReaderEnd>& reader) {
  reader->alive = false;
  std::erase(readers_, reader);
  for (Connection& connection : connections_) {
    if (connection.reader != reader) continue;
    connection.under_way.clear();
    if (!connection.writer_matched) continue;
    auto& matched = connection.writer->matched;
    const auto it = std::find(matched.begin(), matched.end(), reader->who);
    if (it != matched.end()) matched.erase(it);
  }
  std::erase_if(connections_, [&](const Connection& c) { return c.reader == reader; });
}

std::vector<SimNetwork::Event> SimNetwork::events() const {
  std::vector<Event> result;
  for (std::size_t i = 0; i < connections_.size(); ++i) {
    const Connection& c = connections_[i];
    const bool both_alive = c.writer->alive && c.reader->alive;
    if (both_alive && !c.writer_matched) result.push_back({Event::Kind::match_writer, i});
    if (both_alive && !c.reader_matched) result.push_back({Event::Kind::match_reader, i});
    // Samples of a dead writer may still arrive.
    const bool waits = c.writer->topic.qos.latched && !c.reader_matched;
    if (!c.under_way.empty() && !waits) result.push_back({Event::Kind::deliver, i});
  }
  return result;
}

void SimNetwork::happen(const Event& event) {
  Connection& connection = connections_[event.connection];
  switch (event.kind) {
    case Event::Kind::match_writer:
      connection.writer_matched = true;
      connection.writer->matched.push_back(connection.reader->who);
      connection.under_way = connection.writer->history;
      return;
    case Event::Kind::match_reader:
      connection.reader_matched = true;
      connection.reader->matched.push_back(connection.writer->who);
      return;
    case Event::Kind::deliver: {
      bus::Sample sample{std::move(connection.under_way.front()), connection.writer->who};
      connection.under_way.pop_front();
      if (connection.reader_matched) connection.reader->on_sample(std::move(sample));
      return;
    }
  }
}

void SimNetwork::lose_tails_of_the_dead(RandomStream& random) {
  for (Connection& connection : connections_) {
    if (connection.writer->alive || connection.under_way.empty()) continue;
    connection.under_way.resize(random.bits() % (connection.under_way.size() + 1));
  }
}

std::string SimNetwork::describe() const {
  std::string text;
  for (const Connection& c : connections_) {
    if (c.under_way.empty() && c.writer_matched && c.reader_matched) continue;
    text += c.writer->topic.name + " " + std::to_string(c.writer->who) + "->" + std::to_string(c.reader->who) +
            (c.writer_matched ? " w" : " -") + (c.reader_matched ? "r " : "- ") + std::to_string(c.under_way.size()) +
            "\n";
  }
  return text;
}

}  // namespace skein::test
