// The message bus of all Skein processes: topics with serialised CDR payloads, in numbered domains. A backend (inproc/,
// fastdds/, cyclonedds/) transports bytes by topic name, type name and QoS; typed.hpp adds message types.
//
// Threads: a backend may call Reader callbacks from its own threads; an Inbox (inbox.hpp) passes the samples to the
// thread that owns the program's state. A Writer may be used from one thread at a time.
#pragma once

#include <netinet/in.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bus/unsent.hpp"
#include "core/config/network_config.hpp"
#include "core/run/run_id.hpp"

namespace skein::bus {

/// Identifies a DDS participant: a hash (FNV-1a, 64 bit) of the 12 bytes of its GUID prefix, so that programs of both
/// vendors use the same id for it. 0 means unknown.
using ParticipantId = std::uint64_t;

/// Quality of service. History is always KEEP_LAST; a writer never blocks on a dead, stopped or slow reader.
struct Qos {
  bool reliable = true;
  bool latched = false;  ///< TRANSIENT_LOCAL: a late joiner gets the last `depth` samples
  int depth = 64;        ///< history depth; at least the number of samples in one exchange
};

struct TopicSpec {
  std::string name;  ///< on the wire: "rt/jurong/gimbal"
  std::string type;  ///< on the wire: "geometry_msgs::msg::dds_::TwistStamped_"
  Qos qos;
};

/// One received sample. `payload` begins with the 4-byte encapsulation header (CDR_LE for what Skein writes).
struct Sample {
  std::vector<std::uint8_t> payload;
  ParticipantId source = 0;  ///< participant that wrote the sample
};

/// Writer and reader discover their match independently: a writer may list a reader that has not matched the writer
/// yet, and that reader does not receive what is written until it has. A program that must not lose its first sample
/// waits for a message that says that the reader is ready. When a writer is destroyed, samples that a reader has not
/// received yet may be lost.
class Writer {
 public:
  virtual ~Writer() = default;
  /// @param payload  with encapsulation header. All backends pad it with zeros to a multiple of four bytes, as RTPS
  /// does. Never blocks for long: a reader loses samples that it cannot take in time; the participant's unsent() counts
  /// samples that the vendor does not accept.
  virtual void write(std::span<const std::uint8_t> payload) = 0;
  /// Participants of the readers that this writer has matched, one entry per reader.
  virtual std::vector<ParticipantId> matched() const = 0;
  /// Whether any reader is matched; cheap enough to be called before each sample.
  virtual bool has_readers() const { return !matched().empty(); }
};

class Reader {
 public:
  virtual ~Reader() = default;
  /// Participants of the writers that this reader has matched, one entry per writer. The writer of a sample that was
  /// passed to OnSample is among them until it leaves.
  virtual std::vector<ParticipantId> matched() const = 0;
};

/// Called for each sample; samples of one writer come in the order in which it wrote them. A backend's thread calls it,
/// one call at a time per reader, possibly before create_reader() returns. It must neither block nor destroy the
/// reader.
using OnSample = std::function<void(Sample&&)>;

/// One participant in one domain. Its readers and writers must be destroyed before it.
class Participant {
 public:
  /// @param unsent  counter of unsent samples, usually shared by all participants of the bus.
  explicit Participant(std::shared_ptr<Unsent> unsent = std::make_shared<Unsent>()) : unsent_(std::move(unsent)) {}
  virtual ~Participant() = default;
  virtual ParticipantId id() const = 0;
  virtual std::unique_ptr<Writer> create_writer(const TopicSpec& topic) = 0;
  /// A reader never receives samples of its own participant's writers.
  virtual std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) = 0;
  /// From hold() to release(), the backend may hold back what this thread writes, to send it together. A second call
  /// of the same function has no effect. Do not wait for an answer to a sample before release(). See Burst.
  virtual void hold() {}
  virtual void release() {}
  /// Counter of the samples that the participant's writers could not send.
  Unsent& unsent() const { return *unsent_; }

 private:
  const std::shared_ptr<Unsent> unsent_;
};

/// Groups samples that are written in succession and useful only together, such as those of a step: calls hold(), and
/// release() in its destructor.
class Burst {
 public:
  explicit Burst(Participant& participant) : participant_(participant) { participant_.hold(); }
  ~Burst() { participant_.release(); }
  Burst(const Burst&) = delete;
  Burst& operator=(const Burst&) = delete;

 private:
  Participant& participant_;
};

/// Result and time of one name look-up for all peers, so that a program that joins many domains need not look up names
/// for each. It is valid for a few seconds only, because further hosts may start.
struct Asked {
  std::map<std::string, in_addr> addresses{};
  std::chrono::steady_clock::time_point at{};
};

/// Key in BusConfig::networks of the network for all domains that have no entry.
inline constexpr int kEveryDomain = -1;

struct BusConfig {
  std::string vendor = "cyclonedds";        ///< "cyclonedds", "fastdds" or "inproc"
  std::map<int, DomainNetwork> networks{};  ///< by domain, or kEveryDomain; default: no message leaves the host
  std::chrono::milliseconds peers_patience{10'000};  ///< see find_reach()
  Asked asked{};                                     ///< set by make_bus()
  int lease_s = 8;  ///< a participant that is silent for this time is considered dead, [1, 3600]
  /// Folder with the files of process/files/security_files.hpp; empty: an open domain
  std::filesystem::path security{};
  RunId run = RunId::none;  ///< the run to which the program belongs

  DomainNetwork network(int domain) const;
};

/// Domain ids of DDS run from 0 to this one: the UDP ports of a domain begin at 7400 + 250 x domain and must stay below
/// 65536. Those of inproc have no upper limit.
inline constexpr int kMaxDomain = 230;

/// A backend, for one run. A participant may outlive the bus that created it.
class Bus {
 public:
  explicit Bus(RunId run = RunId::none) : run_(run) {}
  virtual ~Bus() = default;
  /// The run to which the bus belongs.
  RunId run() const { return run_; }
  /// Counter of the unsent samples of all participants that this bus created.
  const std::shared_ptr<Unsent>& unsent() const { return unsent_; }
  /// Has the same effect for others as the death of the process: the participants of this bus no longer send or
  /// receive, and are no longer matched. For programs that share a process; only inproc implements it.
  virtual void vanish() {}
  /// @throws InputError when `domain` is not 0 .. kMaxDomain; std::runtime_error when the vendor fails
  virtual std::unique_ptr<Participant> join(int domain) = 0;

 private:
  const RunId run_;
  const std::shared_ptr<Unsent> unsent_ = std::make_shared<Unsent>();
};

/// @throws InputError (core/types.hpp) for an unknown vendor; the message lists the known ones. Also when a file of
/// `security` cannot be read; inproc has no security.
std::unique_ptr<Bus> make_bus(BusConfig config);
/// Names of all DDS vendors, in the order in which the choice `mixed` assigns them to programs: cyclonedds, fastdds.
/// Not inproc.
std::vector<std::string> dds_vendors();

}  // namespace skein::bus
