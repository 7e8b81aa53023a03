// Implements the benchmark's baseline (floor.hpp) with eProsima Fast DDS's C++ API.
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <map>
#include <stdexcept>

#include "bench/floor/vendor.hpp"
#include "bus/fastdds/raw_type.hpp"
#include "bus/fastdds/settings.hpp"

namespace skein::bench {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::types::ReturnCode_t;

/// Returns the entity that Fast DDS created. Throws if it is null, which means that the creation failed.
template <class Entity>
Entity* require(Entity* entity) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS: cannot create an entity");
  return entity;
}

/// The entities of this process in one domain.
struct DomainEntities {
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;

  dds::Topic* topic(const Flow& flow) const {
    if (!participant->find_type(flow.topic.type)) {
      dds::TypeSupport(new bus::fastdds::RawType(flow.topic.type)).register_type(participant);
    }
    return require(participant->create_topic(flow.topic.name, flow.topic.type, dds::TOPIC_QOS_DEFAULT));
  }
};

class FastWriter final : public Endpoint {
 public:
  FastWriter(const DomainEntities& entities, const Flow& flow)
      : sample_(flow.payload),
        writer_(require(entities.publisher->create_datawriter(entities.topic(flow),
                                                              bus::fastdds::writer_qos(flow.topic.qos, true)))) {}

  std::size_t matched() const override {
    dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return static_cast<std::size_t>(status.current_count);
  }
  void write() override {
    if (!writer_->write(&sample_)) throw std::runtime_error("Fast DDS: cannot write");
  }

 private:
  bus::fastdds::RawSample sample_;
  dds::DataWriter* writer_;
};

class FastReader final : public Endpoint, private dds::DataReaderListener {
 public:
  FastReader(const DomainEntities& entities, const Flow& flow, Arrivals& arrivals)
      : arrivals_(arrivals),
        reader_(require(entities.subscriber->create_datareader(
            entities.topic(flow), bus::fastdds::reader_qos(flow.topic.qos), this, dds::StatusMask::data_available()))) {
  }
  /// Fast DDS must not call this object while or after it is destroyed.
  ~FastReader() override { reader_->set_listener(nullptr); }

  std::size_t matched() const override {
    dds::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return static_cast<std::size_t>(status.current_count);
  }

 private:
  void on_data_available(dds::DataReader* reader) override {
    bus::fastdds::RawSample sample;
    dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) arrivals_.add(1, sample.size());
    }
  }

  Arrivals& arrivals_;
  dds::DataReader* reader_;
};

class FastDdsVendor final : public Vendor {
 public:
  ~FastDdsVendor() override {
    for (const auto& [domain, entities] : domains_) {
      entities.participant->delete_contained_entities();
      dds::DomainParticipantFactory::get_instance()->delete_participant(entities.participant);
    }
  }
  std::unique_ptr<Endpoint> open_writer(const Flow& flow) override {
    return std::make_unique<FastWriter>(entities(flow.domain), flow);
  }
  std::unique_ptr<Endpoint> open_reader(const Flow& flow, Arrivals& arrivals) override {
    return std::make_unique<FastReader>(entities(flow.domain), flow, arrivals);
  }

 private:
  const DomainEntities& entities(int domain) {
    DomainEntities& entities = domains_[domain];
    if (entities.participant == nullptr) {
      entities.participant = require(dds::DomainParticipantFactory::get_instance()->create_participant(
          static_cast<std::uint32_t>(domain), bus::fastdds::participant_qos(domain, {}, {})));
      entities.publisher = require(entities.participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT));
      entities.subscriber = require(entities.participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT));
    }
    return entities;
  }

  std::map<int, DomainEntities> domains_;
};

}  // namespace

std::unique_ptr<Vendor> make_vendor() { return std::make_unique<FastDdsVendor>(); }

}  // namespace skein::bench
