#include "bus/cyclonedds/cyclonedds_bus.hpp"

// Before all other headers of Cyclone: see raw_sertype.hpp.
#include "bus/cyclonedds/raw_sertype.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <utility>

#include "bus/cyclonedds/domain.hpp"
#include "bus/cyclonedds/own_host.hpp"
#include "bus/cyclonedds/packing.hpp"
#include "bus/cyclonedds/security.hpp"
#include "bus/wire.hpp"

namespace skein::bus {

namespace cyclonedds {
namespace {

constexpr std::size_t kMaxPacked = 14'000;  // largest datagram that samples share [bytes]; UDP permits more

/// dds_guid_t holds the bytes as they are on the wire.
ParticipantId id_of(const dds_guid_t& guid) { return participant_id(std::span<const std::uint8_t, 12>(guid.v, 12)); }

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPtr = std::unique_ptr<dds_qos_t, DeleteQos>;

/// The QoS that writers and readers of a topic have in common.
QosPtr common_qos(const Qos& qos) {
  QosPtr dds(dds_create_qos());
  // The 10 ms are how long a writer may block. It blocks only above Cyclone's high watermark, which no run reaches: it
  // is set to 2 GB (domain.cpp).
  dds_qset_reliability(dds.get(), qos.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(10));
  dds_qset_durability(dds.get(), qos.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_ignorelocal(dds.get(), DDS_IGNORELOCAL_PARTICIPANT);
  const std::array<dds_data_representation_id_t, 1> representations{DDS_DATA_REPRESENTATION_XCDR1};
  dds_qset_data_representation(dds.get(), representations.size(), representations.data());
  return dds;
}

QosPtr writer_qos(const Qos& qos) {
  QosPtr dds = common_qos(qos);
  dds_qset_history(dds.get(), DDS_HISTORY_KEEP_LAST, qos.depth);
  // This setting, not the history, determines how many samples a late joiner gets; the default is one.
  dds_qset_durability_service(dds.get(), 0, DDS_HISTORY_KEEP_LAST, qos.depth, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return dds;
}

QosPtr reader_qos(const Qos& qos) {
  QosPtr dds = common_qos(qos);
  // The listener takes each sample as it arrives, so the history stays short. With KEEP_LAST, two simultaneous writers
  // could evict each other's samples before the listener is called.
  dds_qset_history(dds.get(), DDS_HISTORY_KEEP_ALL, 0);
  return dds;
}

/// A topic of a raw type. This object is needed only to create an endpoint: the endpoint keeps Cyclone's topic alive.
class RawTopic {
 public:
  RawTopic(dds_entity_t participant, const TopicSpec& topic) : type_(make_raw_sertype(topic.type)) {
    entity_ = dds_create_topic_sertype(participant, topic.name.c_str(), &type_, nullptr, nullptr, nullptr);
    if (entity_ < 0) ddsi_sertype_unref(type_);
    check(entity_, "cannot create topic " + topic.name + " of type " + topic.type);
  }
  ~RawTopic() { dds_delete(entity_); }
  RawTopic(const RawTopic&) = delete;
  RawTopic& operator=(const RawTopic&) = delete;

  dds_entity_t entity() const { return entity_; }
  /// The registered type: the given one, or an equal one that was registered before.
  const ddsi_sertype* type() const { return type_; }

 private:
  ddsi_sertype* type_;
  dds_entity_t entity_;
};

/// Participants of the matched endpoints. @param list, describe  Cyclone's functions for the kind of endpoint.
template <class List, class Describe>
std::vector<ParticipantId> matched_participants(dds_entity_t entity, List list, Describe describe) {
  std::vector<dds_instance_handle_t> handles;
  dds_return_t count = list(entity, nullptr, 0);
  while (count > static_cast<dds_return_t>(handles.size())) {
    handles.resize(static_cast<std::size_t>(count));
    count = list(entity, handles.data(), handles.size());
  }
  check(count, "cannot list matched endpoints");
  handles.resize(static_cast<std::size_t>(count));

  std::vector<ParticipantId> ids;
  for (const dds_instance_handle_t handle : handles) {
    dds_builtintopic_endpoint_t* endpoint = describe(entity, handle);
    if (endpoint == nullptr) continue;  // it has left meanwhile
    ids.push_back(id_of(endpoint->participant_key));
    dds_builtintopic_free_endpoint(endpoint);
  }
  return ids;
}

class CycloneWriter : public Writer {
 public:
  CycloneWriter(dds_entity_t participant, Packing& packing, const TopicSpec& topic, Unsent& unsent)
      : name_(topic.name), unsent_(unsent) {
    const RawTopic raw(participant, topic);
    type_ = raw.type();
    packing.install(type_);
    entity_ = check(dds_create_writer(participant, raw.entity(), writer_qos(topic.qos).get(), nullptr),
                    "cannot create a writer on " + topic.name);
  }
  ~CycloneWriter() override { dds_delete(entity_); }

  void write(std::span<const std::uint8_t> payload) override {
    const dds_return_t result = dds_writecdr(entity_, make_raw_sample(type_, payload));
    if (result == DDS_RETCODE_TIMEOUT)
      unsent_.note(name_, "its readers are too slow");
    else
      check(result, "cannot write to " + name_);
  }

  std::vector<ParticipantId> matched() const override {
    return matched_participants(entity_, dds_get_matched_subscriptions, dds_get_matched_subscription_data);
  }

  bool has_readers() const override {
    dds_publication_matched_status_t status;
    check(dds_get_publication_matched_status(entity_, &status), "cannot count the readers of " + name_);
    return status.current_count > 0;
  }

 private:
  std::string name_;
  Unsent& unsent_;
  const ddsi_sertype* type_ = nullptr;  // kept alive by the writer
  dds_entity_t entity_ = 0;
};

class CycloneReader : public Reader {
 public:
  CycloneReader(dds_entity_t participant, const TopicSpec& topic, OnSample on_sample)
      : on_sample_(std::move(on_sample)) {
    const RawTopic raw(participant, topic);
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener,
                            [](dds_entity_t reader, void* self) { static_cast<CycloneReader*>(self)->take(reader); });
    // The reader looks up a writer's participant as soon as the two match: once the writer has left, Cyclone no longer
    // knows the participant, and a writer may leave right after its last sample.
    dds_lset_subscription_matched(
        listener, [](dds_entity_t reader, const dds_subscription_matched_status_t status, void* self) {
          if (status.current_count_change > 0)
            static_cast<CycloneReader*>(self)->source_of(reader, status.last_publication_handle);
        });
    entity_ = dds_create_reader(participant, raw.entity(), reader_qos(topic.qos).get(), listener);
    dds_delete_listener(listener);
    check(entity_, "cannot create a reader on " + topic.name);
  }
  /// Returns after the last callback has returned.
  ~CycloneReader() override { dds_delete(entity_); }

  std::vector<ParticipantId> matched() const override {
    return matched_participants(entity_, dds_get_matched_publications, dds_get_matched_publication_data);
  }

 private:
  /// Passes on all waiting samples. Cyclone makes one call of a listener at a time. @param reader  handle from the
  /// callback: the first call may come before dds_create_reader() has returned the handle.
  void take(dds_entity_t reader) {
    std::array<ddsi_serdata*, 16> samples{};
    std::array<dds_sample_info_t, 16> infos;
    for (;;) {
      const dds_return_t count = dds_takecdr(reader, samples.data(), samples.size(), infos.data(), DDS_ANY_STATE);
      if (count <= 0) return;
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        // Cyclone reports with a sample without data that a writer has left. Such a sample also lacks the raw type, so
        // payload_of() could not read it.
        if (infos[i].valid_data) {
          const auto payload = payload_of(samples[i]);
          on_sample_({{payload.begin(), payload.end()}, source_of(reader, infos[i].publication_handle)});
        }
        ddsi_serdata_unref(samples[i]);
      }
    }
  }

  /// Participant of a writer; 0: unknown. Known sources are never removed: samples may arrive after a writer has left.
  ParticipantId source_of(dds_entity_t reader, dds_instance_handle_t writer) {
    const std::scoped_lock lock(mutex_);
    const auto known = sources_.find(writer);
    if (known != sources_.end()) return known->second;
    dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
    if (endpoint == nullptr) return 0;
    const ParticipantId id = id_of(endpoint->participant_key);
    dds_builtintopic_free_endpoint(endpoint);
    sources_.emplace(writer, id);
    return id;
  }

  OnSample on_sample_;
  std::mutex mutex_;
  std::map<dds_instance_handle_t, ParticipantId> sources_;
  dds_entity_t entity_ = 0;
};

class CycloneParticipant : public Participant {
 public:
  CycloneParticipant(int domain, const BusConfig& config, const Reach& reach, std::shared_ptr<Unsent> unsent)
      : Participant(std::move(unsent)),
        domain_(domain, config, reach),
        packing_(std::min(kMaxPacked, reach.largest_datagram)),
        entity_(check(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr),
                      "cannot join domain " + std::to_string(domain))) {
    dds_guid_t guid;
    check(dds_get_guid(entity_, &guid), "participant without GUID");
    id_ = id_of(guid);
    if (meets_default_nodes(config, reach)) {
      reach_own_host(domain_.entity(), entity_);
    } else if (!reach.address.empty()) {
      hear_own_address(domain_.entity(), entity_, reach.address);
    }
    if (!config.security.empty()) watch_strangers(domain, entity_);
  }
  ~CycloneParticipant() override {
    packing_.release();
    dds_delete(entity_);
  }

  ParticipantId id() const override { return id_; }

  std::unique_ptr<Writer> create_writer(const TopicSpec& topic) override {
    return std::make_unique<CycloneWriter>(entity_, packing_, topic, unsent());
  }

  std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) override {
    return std::make_unique<CycloneReader>(entity_, topic, std::move(on_sample));
  }

  void hold() override { packing_.hold(); }
  void release() override { packing_.release(); }

 private:
  Domain domain_;
  Packing packing_;
  dds_entity_t entity_;
  ParticipantId id_ = 0;
};

class CycloneBus : public Bus {
 public:
  explicit CycloneBus(BusConfig config) : Bus(config.run), config_(std::move(config)) {}

  std::unique_ptr<Participant> join(int domain) override {
    check_domain(domain);
    return std::make_unique<CycloneParticipant>(domain, config_, reach_of(config_, domain), unsent());
  }

 private:
  BusConfig config_;
};

}  // namespace
}  // namespace cyclonedds

std::unique_ptr<Bus> make_cyclonedds_bus(const BusConfig& config) {
  return std::make_unique<cyclonedds::CycloneBus>(config);
}

}  // namespace skein::bus
