// A program's part of a run's recording: an MCAP file of its own in the run's folder, from which the launcher makes
// recording.mcap. Times are simulated: the same run makes the same recording.
// Not thread-safe. A disk that refuses ends the recording, never the run.
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
  /// @param folder   the run's.
  /// @param program  results/run_folder.hpp's name of it; started again, it writes one more part.
  Recorder(const std::filesystem::path& folder, const std::string& program, Scope scope);

  Scope scope() const { return scope_; }
  /// The time of all that follows. It may go back: what waited is told at the time to which it belongs.
  void set_time(Tick tick) { tick_ = tick; }

  /// Records what the scope asks for.
  bus::Ear ear(const std::string& node, const bus::TopicSpec& topic) override;
  /// Whatever the scope, unless nothing is recorded. @param topic  ROS name in the recording.
  /// @param wire_type  one that the IDL does not know is recorded without its definition.
  /// @param sequence  its number at its source, where it has one.
  void add(const std::string& topic, const std::string& wire_type, std::span<const std::uint8_t> payload,
           std::uint64_t sequence = 0);
  template <class Message>
  void add(const std::string& topic, const Message& message) {
    if (scope_ != Scope::none) add(topic, type_name<Message>(), encode(message));
  }

  /// What has been recorded is in the file when this returns.
  void flush();
  /// Nothing may follow.
  void close();
  /// What went wrong, for people; empty as long as nothing did.
  std::string trouble() const;

 private:
  std::uint16_t channel(const std::string& topic, const std::string& wire_type);

  const Scope scope_;
  std::optional<mcap::Writer> file_;  ///< none: nothing is recorded
  std::string trouble_;
  Tick tick_ = 0;
  std::map<std::string, std::uint16_t, std::less<>> channels_;  ///< by topic
};

}  // namespace skein::recording
