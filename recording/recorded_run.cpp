#include "recording/recorded_run.hpp"

#include <algorithm>

#include "recording/mcap/reader.hpp"

namespace skein::recording {

RecordedRun::RecordedRun(const std::filesystem::path& file, const std::function<bool(const std::string&)>& wanted) {
  mcap::Reader::whole(file).messages([&](const mcap::Channel& channel, const mcap::Message& message) {
    const auto tick = static_cast<Tick>(message.log_time * kTicksPerSecond / 1'000'000'000);
    end_ = std::max(end_, tick);
    if (!wanted(channel.topic)) return;
    by_time_[tick].push_back({channel.topic, message.sequence, mcap::Bytes(message.data.begin(), message.data.end())});
  });
}

void RecordedRun::each(const std::function<void(Tick, const Said&)>& visit) const {
  for (const auto& [tick, samples] : by_time_) {
    for (const Said& said : samples) visit(tick, said);
  }
}

const std::vector<Said>& RecordedRun::at(Tick tick) const {
  static const std::vector<Said> kNothing;
  const auto found = by_time_.find(tick);
  return found == by_time_.end() ? kNothing : found->second;
}

}  // namespace skein::recording
