// The only way in which Skein's processes talk: topics of already serialised CDR payloads, in numbered domains.
// A backend (inproc/, fastdds/, cyclonedds/) moves bytes by topic name, type name and QoS; typed.hpp adds the types.
//
// Threads: a backend may call Reader callbacks from its own threads; an Inbox (inbox.hpp) takes them to the one
// thread that owns a program's state. Writers may be used from one thread at a time.
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

/// A DDS participant as all others in its domain see it: a hash (FNV-1a, 64 bit) of the 12 bytes of its GUID prefix,
/// so that both vendors name the same participant alike. 0 means unknown.
using ParticipantId = std::uint64_t;

/// Quality of service. Everything is KEEP_LAST; a writer never blocks on a dead, stopped or slow reader.
struct Qos {
  bool reliable = true;
  bool latched = false;  ///< TRANSIENT_LOCAL: a late joiner gets the last `depth` samples
  int depth = 64;        ///< at least what one lock-step round may hold
};

struct TopicSpec {
  std::string name;  ///< on the wire: "rt/jurong/gimbal"
  std::string type;  ///< on the wire: "geometry_msgs::msg::dds_::TwistStamped_"
  Qos qos;
};

/// One received sample. `payload` begins with the 4-byte encapsulation header (CDR_LE for what Skein writes).
struct Sample {
  std::vector<std::uint8_t> payload;
  ParticipantId source = 0;  ///< who wrote it
};

/// Matches are found by either side for itself: that a writer lists a reader does not mean that the reader has found
/// the writer, and what is written in between passes it by. Who must not lose the first sample waits until the other
/// side has said that it is ready. What a reader has not got when a writer is destroyed may be lost to it.
class Writer {
 public:
  virtual ~Writer() = default;
  /// @param payload with encapsulation header. A length that is no multiple of four is padded with zeros, here as on
  /// the wire. Never blocks for long: what a reader cannot take is lost to it, and what the vendor does not take at all
  /// goes to the participant's unsent().
  virtual void write(std::span<const std::uint8_t> payload) = 0;
  /// Participants with a reader that this writer has matched, one entry a reader.
  virtual std::vector<ParticipantId> matched() const = 0;
  /// Whether there are any; cheap enough to ask before each sample.
  virtual bool has_readers() const { return !matched().empty(); }
};

class Reader {
 public:
  virtual ~Reader() = default;
  /// Participants with a writer that this reader has matched, one entry a writer. Whoever wrote a sample that was
  /// handed out is among them until that writer has left.
  virtual std::vector<ParticipantId> matched() const = 0;
};

/// Called for each sample in the order in which each writer wrote; from a backend's thread, one call at a time for a
/// reader, and perhaps before create_reader() returns. It must not destroy that reader, nor block.
using OnSample = std::function<void(Sample&&)>;

/// One participant in one domain. Endpoints must be destroyed before it.
class Participant {
 public:
  /// @param unsent  shared with others, as a rule with all of the bus.
  explicit Participant(std::shared_ptr<Unsent> unsent = std::make_shared<Unsent>()) : unsent_(std::move(unsent)) {}
  virtual ~Participant() = default;
  virtual ParticipantId id() const = 0;
  virtual std::unique_ptr<Writer> create_writer(const TopicSpec& topic) = 0;
  /// A participant never hears its own writers.
  virtual std::unique_ptr<Reader> create_reader(const TopicSpec& topic, OnSample on_sample) = 0;
  /// What this thread writes from now on may wait until it calls release(), to travel together. Both do nothing when
  /// they were called already; nobody may wait for an answer in between. See Burst.
  virtual void hold() {}
  virtual void release() {}
  /// Where its writers count what they could not send.
  Unsent& unsent() const { return *unsent_; }

 private:
  const std::shared_ptr<Unsent> unsent_;
};

/// Samples that are written in a row and of use only together: a step's. Sends them at the latest when it ends.
class Burst {
 public:
  explicit Burst(Participant& participant) : participant_(participant) { participant_.hold(); }
  ~Burst() { participant_.release(); }
  Burst(const Burst&) = delete;
  Burst& operator=(const Burst&) = delete;

 private:
  Participant& participant_;
};

/// What the names of all peers told at once, and when: who joins many domains need not wait for each. It is soon out of
/// date, while others come up.
struct Asked {
  std::map<std::string, in_addr> addresses{};
  std::chrono::steady_clock::time_point at{};
};

/// In BusConfig::networks.
inline constexpr int kEveryDomain = -1;

struct BusConfig {
  std::string vendor = "cyclonedds";                 ///< "cyclonedds", "fastdds" or "inproc"
  std::map<int, DomainNetwork> networks{};           ///< by domain, or kEveryDomain; usual: nothing leaves the host
  std::chrono::milliseconds peers_patience{10'000};  ///< see find_reach()
  Asked asked{};                                     ///< make_bus() does
  int lease_s = 8;  ///< who gives no sign of life for so long is taken for dead, [1, 3600]
  /// Folder with the files of process/files/security_files.hpp; empty: an open domain
  std::filesystem::path security{};
  RunId run = RunId::none;  ///< that its programs take part in

  DomainNetwork network(int domain) const;
};

/// Domain ids run from 0 to this one: the UDP ports of a domain begin at 7400 + 250 x domain and must stay below 65536.
inline constexpr int kMaxDomain = 230;

/// A vendor's implementation, for one run. A participant may outlive the bus that it was made by.
class Bus {
 public:
  explicit Bus(RunId run = RunId::none) : run_(run) {}
  virtual ~Bus() = default;
  /// The run that its programs take part in.
  RunId run() const { return run_; }
  /// What the writers of all participants that it made did not send.
  const std::shared_ptr<Unsent>& unsent() const { return unsent_; }
  /// As if the process of its participants had died: they write and hear nothing more, and nobody has matched them.
  /// For programs that share a process, hence only inproc's does something.
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
/// Names of all vendors, in the order in which `mixed` deals them out: cyclonedds, fastdds. inproc is not among them.
std::vector<std::string> dds_vendors();

}  // namespace skein::bus
