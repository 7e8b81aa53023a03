#include "bus/fastdds/fastdds_bus.hpp"

#include <spdlog/fmt/fmt.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "bus/fastdds/matches.hpp"
#include "bus/fastdds/raw_type.hpp"
#include "bus/fastdds/security.hpp"
#include "bus/fastdds/settings.hpp"
#include "bus/wire.hpp"

namespace skein::bus {

namespace fastdds {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

template <class Entity>
Entity* created(Entity* entity, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS: cannot create " + what);
  return entity;
}

/// Records what Fast DDS has reported to a listener: a remote endpoint has been matched, or is no longer matched.
void update(Matches& matches, const dds::InstanceHandle_t& handle, const auto& status) {
  const GUID_t endpoint = eprosima::fastrtps::rtps::iHandle2GUID(handle);
  status.current_count_change > 0 ? matches.begin(endpoint) : matches.end(endpoint);
}

class FastWriter : public Writer, private dds::DataWriterListener {
 public:
  FastWriter(dds::Publisher& publisher, dds::Topic& topic, const Qos& qos, bool one_host, const GuidPrefix_t& own,
             Unsent& unsent)
      : publisher_(publisher),
        unsent_(unsent),
        reliable_(qos.reliable),
        matches_(own),
        writer_(created(publisher.create_datawriter(&topic, fastdds::writer_qos(qos, one_host), this,
                                                    dds::StatusMask::publication_matched()),
                        "a writer on " + topic.get_name())) {}
  ~FastWriter() override {
    writer_->set_listener(nullptr);
    // While Fast DDS 2.9 deletes a writer, its heartbeat may still read samples that are already back in their pool. If
    // a dead reader had left samples unacknowledged, it then counted gaps for ever. An empty history is safe.
    std::size_t removed = 0;
    writer_->clear_history(&removed);
    publisher_.delete_datawriter(writer_);
  }

  void write(std::span<const std::uint8_t> payload) override {
    // A reader of Cyclone 0.10 begins reliable delivery at a writer's first heartbeat, and drops samples that it has
    // received before. The heartbeat that Fast DDS sends at the match often comes too early. So a heartbeat precedes
    // each sample: Fast DDS sends one to assert liveliness.
    if (reliable_ && matches_.any_cyclone()) writer_->assert_liveliness();
    RawSample sample = padded(payload);
    if (writer_->write(&sample)) return;
    unsent_.note(writer_->get_topic()->get_name(), fmt::format("Fast DDS refused its {} bytes", payload.size()));
  }

  std::vector<ParticipantId> matched() const override { return matches_.participants(); }
  bool has_readers() const override { return !matches_.empty(); }

 private:
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    update(matches_, status.last_subscription_handle, status);
  }

  dds::Publisher& publisher_;
  Unsent& unsent_;
  bool reliable_;
  Matches matches_;
  dds::DataWriter* writer_;
};

class FastReader : public Reader, private dds::DataReaderListener {
 public:
  FastReader(dds::Subscriber& subscriber, dds::Topic& topic, const Qos& qos, const GuidPrefix_t& own,
             OnSample on_sample)
      : subscriber_(subscriber),
        latched_(qos.latched),
        own_(own),
        on_sample_(std::move(on_sample)),
        matches_(own),
        reader_(created(
            subscriber.create_datareader(&topic, fastdds::reader_qos(qos), this,
                                         dds::StatusMask::data_available() << dds::StatusMask::subscription_matched()),
            "a reader on " + topic.get_name())) {}
  /// Returns after the last callback has returned.
  ~FastReader() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }

  std::vector<ParticipantId> matched() const override { return matches_.participants(); }

 private:
  void on_data_available(dds::DataReader* reader) override {
    const std::scoped_lock lock(taking_);
    RawSample payload;
    dds::SampleInfo info;
    while (reader->take_next_sample(&payload, &info) == ReturnCode_t::RETCODE_OK) {
      const GUID_t& writer = info.sample_identity.writer_guid();
      const GuidPrefix_t& source = writer.guidPrefix;
      matches_.note_sample(writer);
      if (info.valid_data && source != own_ && is_for_us(info)) on_sample_({std::move(payload), id_of(source)});
    }
  }

  // A volatile reader must not get samples that were written before its creation. But Cyclone 0.10 resends, on request,
  // samples that it still keeps for another reader, such as a killed one, and Fast DDS requests them. Timestamps show
  // which are old: both ends run on one machine, or their clocks agree. After a writer's first new sample, all are new.
  bool is_for_us(const dds::SampleInfo& info) {
    const GUID_t& writer = info.sample_identity.writer_guid();
    if (latched_ || !is_cyclone(writer.guidPrefix) || up_to_date_.contains(writer)) return true;
    if (info.source_timestamp.to_ns() < created_ns_) return false;
    up_to_date_.insert(writer);
    return true;
  }

  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    update(matches_, status.last_publication_handle, status);
  }

  dds::Subscriber& subscriber_;
  const bool latched_;
  const std::int64_t created_ns_ =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  std::set<GUID_t> up_to_date_;  ///< writers of which a new sample has arrived
  GuidPrefix_t own_;
  OnSample on_sample_;
  std::mutex taking_;
  Matches matches_;
  dds::DataReader* reader_;
};

class FastParticipant : public Participant {
 public:
  FastParticipant(int domain, const BusConfig& config, const Reach& reach, std::shared_ptr<Unsent> unsent)
      : Participant(std::move(unsent)),
        one_host_(reach.host_only),
        participant_(created(dds::DomainParticipantFactory::get_instance()->create_participant(
                                 static_cast<std::uint32_t>(domain), participant_qos(domain, config, reach),
                                 config.security.empty() ? nullptr : &stranger_watch_, dds::StatusMask::none()),
                             "a participant in domain " + std::to_string(domain))),
        prefix_(participant_->guid().guidPrefix),
        publisher_(created(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "a publisher")),
        subscriber_(created(participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "a subscriber")) {}
  ~FastParticipant() override {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  ParticipantId id() const override { return id_of(prefix_); }

  std::unique_ptr<Writer> create_writer(const TopicSpec& topic) override {
    return std::make_unique<FastWriter>(*publisher_, open(topic), topic.qos, one_host_, prefix_, unsent());
  }

  std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) override {
    return std::make_unique<FastReader>(*subscriber_, open(topic), topic.qos, prefix_, std::move(on_sample));
  }

 private:
  /// The topic, created at the first call: Fast DDS permits one per name in a participant. It exists as long as the
  /// participant, or until it is opened with another type after its last endpoint has gone.
  /// @throws std::runtime_error if an endpoint uses it with another type.
  dds::Topic& open(const TopicSpec& spec) {
    const std::scoped_lock lock(mutex_);
    if (const auto known = topics_.find(spec.name); known != topics_.end()) {
      const std::string type = known->second->get_type_name();
      if (type == spec.type) return *known->second;
      if (participant_->delete_topic(known->second) != ReturnCode_t::RETCODE_OK) {
        throw std::runtime_error("Fast DDS: topic " + spec.name + " has type " + type +
                                 " already, it cannot have type " + spec.type + " as well");
      }
      topics_.erase(known);
    }
    if (!participant_->find_type(spec.type)) dds::TypeSupport(new RawType(spec.type)).register_type(participant_);
    dds::Topic* topic =
        created(participant_->create_topic(spec.name, spec.type, dds::TOPIC_QOS_DEFAULT), "topic " + spec.name);
    topics_.emplace(spec.name, topic);
    return *topic;
  }

  const bool one_host_;
  StrangerWatch stranger_watch_;
  dds::DomainParticipant* participant_;
  GuidPrefix_t prefix_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
  std::mutex mutex_;
  std::map<std::string, dds::Topic*> topics_;
};

class FastBus : public Bus {
 public:
  explicit FastBus(BusConfig config) : Bus(config.run), config_(std::move(config)) {}

  std::unique_ptr<Participant> join(int domain) override {
    check_domain(domain);
    return std::make_unique<FastParticipant>(domain, config_, reach_of(config_, domain), unsent());
  }

 private:
  BusConfig config_;
};

}  // namespace
}  // namespace fastdds

std::unique_ptr<Bus> make_fastdds_bus(const BusConfig& config) { return std::make_unique<fastdds::FastBus>(config); }

}  // namespace skein::bus
