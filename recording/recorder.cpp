#include "recording/recorder.hpp"

#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/run/tick_time.hpp"
#include "idl/message_definition.hpp"
#include "recording/bag.hpp"
#include "results/run_folder.hpp"

namespace skein::recording {
namespace {

/// Range of ids of schemas and channels for a program. The ids must be unique in the whole recording, since its parts
/// are joined without changing them. A program that is started again ("life") uses the next `of_a_life` ids.
struct Ids {
  std::uint16_t first, lives, of_a_life;
};

Ids ids_of(const std::string& program) {
  if (program == programs::kCommRouter) return {32'768, 15, 2048};
  if (program == programs::kStation) return {63'488, 32, 64};
  return {1, 1, 32'767};
}

mcap::WriterOptions options_of(const std::string& program, int life) {
  const Ids ids = ids_of(program);
  if (life >= ids.lives) throw std::length_error("there is room for " + std::to_string(ids.lives) + " parts");
  const auto first = static_cast<std::uint16_t>(ids.first + life * ids.of_a_life);
  return {.first_id = first, .last_id = static_cast<std::uint16_t>(first + ids.of_a_life - 1)};
}

/// An Activity message without its CPU time, which differs from run to run; any other payload unchanged.
mcap::Bytes repeatable(std::span<const std::uint8_t> payload) {
  msg::Activity activity;
  if (!decode(payload, activity)) return {payload.begin(), payload.end()};
  activity.cpu_s(0.0);
  return encode(activity);
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const std::string& program, Scope scope) : scope_(scope) {
  if (scope == Scope::none) return;
  int life = 0;
  while (std::filesystem::exists(folder / run_folder::recording_part(program, life))) ++life;
  try {
    file_.emplace(folder / run_folder::recording_part(program, life), options_of(program, life));
  } catch (const std::exception& error) {
    write_error_ = std::string("the recording of ") + program + " ends: " + error.what();
  }
}

bus::Ear Recorder::ear(const std::string& node, const bus::TopicSpec& topic) {
  const std::string name = ros_topic(topic.name);
  const auto choice = choice_of(scope_, node, name);
  if (!choice) return {};
  auto last = std::make_shared<std::optional<Tick>>();
  const auto hear = [this, topic = recorded_topic(node, name), type = topic.type, period = choice->period,
                     last](std::span<const std::uint8_t> payload) {
    if (*last && tick_ - **last < period && tick_ != **last) return;
    *last = tick_;
    if (type == type_name<msg::Activity>()) return add(topic, type, repeatable(payload));
    add(topic, type, payload);
  };
  return {hear, choice->also_unread};
}

std::uint16_t Recorder::channel(const std::string& topic, const std::string& wire_type) {
  const auto found = channels_.find(topic);
  if (found != channels_.end()) return found->second;
  std::string name, definition;
  try {
    const MessageDefinition& known = message_definition(wire_type);
    name = known.name;
    definition = known.text;
  } catch (const std::out_of_range&) {
  }
  const mcap::StringMap qos = {{"offered_qos_profiles", offered_qos_profiles(topic)}};
  return channels_.emplace(topic, file_->add_channel(topic, name, definition, qos)).first->second;
}

void Recorder::add(const std::string& topic, const std::string& wire_type, std::span<const std::uint8_t> payload,
                   std::uint64_t sequence) {
  if (!file_) return;
  try {
    file_->write(channel(topic, wire_type), nanoseconds(tick_), payload, static_cast<std::uint32_t>(sequence));
  } catch (const std::length_error& error) {
    write_error_ = error.what();
    close();
  }
}

void Recorder::flush() {
  if (file_) file_->flush();
}

void Recorder::close() {
  if (!file_) return;
  file_->close();
  if (write_error_.empty()) write_error_ = file_->write_error();
  file_.reset();
}

std::string Recorder::write_error() const {
  return file_ && write_error_.empty() ? file_->write_error() : write_error_;
}

}  // namespace skein::recording
