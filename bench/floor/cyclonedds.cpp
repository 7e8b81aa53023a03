// Implements the benchmark's baseline (floor.hpp) with Eclipse Cyclone DDS's C API, and with Cyclone's serialiser for a
// type that is one sequence of octets.
#include <dds/dds.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "bench/floor/vendor.hpp"
#include "bus/cyclonedds/domain.hpp"
#include "bus/cyclonedds/own_host.hpp"
#include "bus/wire.hpp"

namespace skein::bench {
namespace {

using bus::cyclonedds::check;
using bus::cyclonedds::Domain;

struct Octets {
  dds_sequence_t data;
};
/// Bytes before the octets: encapsulation header and the sequence's length.
constexpr std::size_t kOverhead = 8;

constexpr std::array<std::uint32_t, 3> kOctetsOps = {
    std::uint32_t{DDS_OP_ADR} | std::uint32_t{DDS_OP_TYPE_SEQ} | std::uint32_t{DDS_OP_SUBTYPE_1BY},
    offsetof(Octets, data), DDS_OP_RTS};

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPtr = std::unique_ptr<dds_qos_t, DeleteQos>;

QosPtr qos_of(const bus::Qos& qos, bool writer) {
  QosPtr dds(dds_create_qos());
  dds_qset_reliability(dds.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(10));
  dds_qset_durability(dds.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(dds.get(), writer ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL, writer ? qos.depth : 0);
  return dds;
}

dds_entity_t create_topic(dds_entity_t participant, const Flow& flow) {
  const dds_topic_descriptor_t type = {.m_size = sizeof(Octets),
                                       .m_align = alignof(Octets),
                                       .m_flagset = 0,
                                       .m_nkeys = 0,
                                       .m_typename = flow.topic.type.c_str(),
                                       .m_keys = nullptr,
                                       .m_nops = 2,
                                       .m_ops = kOctetsOps.data(),
                                       .m_meta = "",
                                       .type_information = {},
                                       .type_mapping = {},
                                       .restrict_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1};
  return check(dds_create_topic(participant, &type, flow.topic.name.c_str(), nullptr, nullptr), "no topic");
}

class CycloneWriter final : public Endpoint {
 public:
  CycloneWriter(dds_entity_t participant, const Flow& flow) : octets_(flow.payload.size() - kOverhead) {
    entity_ = check(
        dds_create_writer(participant, create_topic(participant, flow), qos_of(flow.topic.qos, true).get(), nullptr),
        "no writer");
    const auto length = static_cast<std::uint32_t>(octets_.size());
    sample_.data = {length, length, octets_.data(), false};
  }

  std::size_t matched() const override {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(entity_, &status);
    return status.current_count;
  }
  void write() override { check(dds_write(entity_, &sample_), "cannot write"); }

 private:
  std::vector<std::uint8_t> octets_;
  Octets sample_{};
  dds_entity_t entity_ = 0;
};

class CycloneReader final : public Endpoint {
 public:
  CycloneReader(dds_entity_t participant, const Flow& flow, Arrivals& arrivals) : arrivals_(arrivals) {
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener,
                            [](dds_entity_t reader, void* self) { static_cast<CycloneReader*>(self)->take(reader); });
    entity_ =
        dds_create_reader(participant, create_topic(participant, flow), qos_of(flow.topic.qos, false).get(), listener);
    dds_delete_listener(listener);
    check(entity_, "no reader");
  }
  ~CycloneReader() override { dds_delete(entity_); }  // no call of the listener after this

  std::size_t matched() const override {
    dds_subscription_matched_status_t status{};
    dds_get_subscription_matched_status(entity_, &status);
    return status.current_count;
  }

 private:
  void take(dds_entity_t reader) {
    std::array<void*, 16> samples{};
    std::array<dds_sample_info_t, 16> infos;
    for (;;) {
      const dds_return_t count = dds_take(reader, samples.data(), infos.data(), samples.size(), samples.size());
      if (count <= 0) return;
      std::uint64_t arrived = 0, bytes = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if (!infos[i].valid_data) continue;
        ++arrived;
        bytes += static_cast<const Octets*>(samples[i])->data._length + kOverhead;
      }
      dds_return_loan(reader, samples.data(), count);
      arrivals_.add(arrived, bytes);
    }
  }

  Arrivals& arrivals_;
  dds_entity_t entity_ = 0;
};

class CycloneVendor final : public Vendor {
 public:
  ~CycloneVendor() override {
    for (const auto& [domain, entities] : domains_) dds_delete(entities.participant);
  }
  std::unique_ptr<Endpoint> open_writer(const Flow& flow) override {
    return std::make_unique<CycloneWriter>(participant(flow.domain), flow);
  }
  std::unique_ptr<Endpoint> open_reader(const Flow& flow, Arrivals& arrivals) override {
    return std::make_unique<CycloneReader>(participant(flow.domain), flow, arrivals);
  }

 private:
  /// The entities of this process in one domain.
  struct DomainEntities {
    std::unique_ptr<Domain> domain;
    dds_entity_t participant = 0;
  };

  dds_entity_t participant(int id) {
    DomainEntities& entities = domains_[id];
    if (!entities.domain) {
      const bus::BusConfig config;
      const bus::Reach reach;
      entities.domain = std::make_unique<Domain>(id, config, reach);
      entities.participant =
          check(dds_create_participant(static_cast<dds_domainid_t>(id), nullptr, nullptr), "cannot join");
      if (bus::meets_default_nodes(config, reach))
        bus::cyclonedds::reach_own_host(entities.domain->entity(), entities.participant);
    }
    return entities.participant;
  }

  std::map<int, DomainEntities> domains_;
};

}  // namespace

std::unique_ptr<Vendor> make_vendor() { return std::make_unique<CycloneVendor>(); }

}  // namespace skein::bench
