#include "uav_agent/kept_maps.hpp"

#include <stdexcept>
#include <utility>

#include "core/messages/view_topics.hpp"
#include "core/run/tick_time.hpp"
#include "idl/cdr.hpp"
#include "idl/message_definition.hpp"
#include "idl/type_names.hpp"
#include "results/run_folder.hpp"
#include "uav_agent/octomap_message.hpp"

namespace skein::agent {
KeptMaps::KeptMaps(std::filesystem::path folder, std::string uav, Tick period)
    : folder_(std::move(folder)), uav_(std::move(uav)), period_(period) {}

void KeptMaps::keep(Tick tick, const WorldMap* world, const OccupancyMap& key_frames) {
  tick_ = tick;
  if (tick < due_) return;
  due_ = (tick / period_ + 1) * period_;  // at the same times for all UAVs, whenever their programs began
  if (has_changed(world, key_frames)) write(world, key_frames);
}

void KeptMaps::end(const WorldMap* world, const OccupancyMap& key_frames) {
  if (!tick_) return;
  has_changed(world, key_frames);  // brings the tree up to date
  if (written_ != tick_) write(world, key_frames);
  if (!file_) return;
  file_->close();
  write_error_ = file_->write_error();
  file_.reset();
}

bool KeptMaps::has_changed(const WorldMap* world, const OccupancyMap& key_frames) {
  if (world != nullptr) return tree_.update(*world);
  const std::uint64_t before = std::exchange(key_frames_, key_frames.key_frames());
  return key_frames_ != before;
}

void KeptMaps::write(const WorldMap* world, const OccupancyMap& key_frames) {
  if (!write_error_.empty()) return;
  if (!file_) open();
  if (!file_) return;
  const Tick tick = *tick_;
  const msg::Octomap map =
      world != nullptr ? octomap_of(tree_.bytes(), world->config().cell_m, tick) : octomap_of(key_frames, tick);
  file_->write(channel_, nanoseconds(tick), encode(map));
  file_->flush();
  written_ = tick;
  write_error_ = file_->write_error();
}

void KeptMaps::open() {
  try {
    int life = 0;
    while (std::filesystem::exists(folder_ / run_folder::maps_file(uav_, life))) ++life;
    file_.emplace(folder_ / run_folder::maps_file(uav_, life));
    const MessageDefinition& type = message_definition(type_name<msg::Octomap>());
    const std::string topic = topics::flight_map(uav_).name.substr(2);  // on the wire it begins with "rt"
    channel_ = file_->add_channel(topic, type.name, type.text);
  } catch (const std::exception& error) {
    file_.reset();
    write_error_ = "no further map snapshots of " + uav_ + ": " + error.what();
  }
}

}  // namespace skein::agent
