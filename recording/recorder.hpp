// A program's part of a run's recording: an MCAP file of its own in the run's folder. The launcher joins all parts to
// recording.mcap. Times are simulated times, so the same run gives the same recording.
// Not thread-safe. A write error (such as a full disk) ends the recording, never the run.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bus/tap.hpp"
#include "core/types.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"
#include "recording/choice.hpp"
#include "recording/mcap/writer.hpp"

namespace skein::recording {

class Recorder final : public bus::Tap {
 public:
  /// If the file cannot be opened, nothing is recorded, and write_error() says why.
  /// @param folder   the run's folder.
  /// @param program  its name in results/run_folder.hpp. A program that is started again writes another part.
  Recorder(const std::filesystem::path& folder, const std::string& program, Scope scope);

  Scope scope() const { return scope_; }
  /// Sets the time of all samples that follow. With add(), the time may go back: a delayed sample gets its own time.
  void set_time(Tick tick) { tick_ = tick; }

  /// Records the topic as the scope demands (choice.hpp).
  bus::Ear ear(const std::string& node, const bus::TopicSpec& topic) override;
  /// Records a sample with every scope but `none`. @param topic  ROS name in the recording.
  /// @param wire_type  DDS type name; a type that the IDL does not contain is recorded without its definition.
  /// @param sequence  number of the sample at its source, if it has one.
  void add(const std::string& topic, const std::string& wire_type, std::span<const std::uint8_t> payload,
           std::uint64_t sequence = 0);
  template <class Message>
  void add(const std::string& topic, const Message& message) {
    if (scope_ != Scope::none) add(topic, type_name<Message>(), encode(message));
  }

  /// When this returns, all samples so far are in the file.
  void flush();
  /// Ends the recording: later samples are dropped.
  void close();
  /// Description of the first error, for people; empty if there was none.
  std::string write_error() const;

 private:
  std::uint16_t channel(const std::string& topic, const std::string& wire_type);

  const Scope scope_;
  std::optional<mcap::Writer> file_;  ///< nullopt: nothing is recorded
  std::string write_error_;
  Tick tick_ = 0;
  std::map<std::string, std::uint16_t, std::less<>> channels_;  ///< by topic
};

}  // namespace skein::recording
