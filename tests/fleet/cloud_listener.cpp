// A participant in a DDS domain, not part of the fleet, that reads point clouds as any ROS 2 program would: by the
// field names in the messages, without knowing what Skein puts into them.
//   cloud_listener VENDOR DOMAIN FILE TOPIC TYPE [TOPIC TYPE]...     types: sensor_msgs PointCloud or PointCloud2
// Appends one line to FILE per sample: {"topic": ..., "points": {"x": [...], "intensity": [...], ...}}; and, once it
// has found the writer of each topic, the line {"listening": true}. Runs until it is killed.
#include <chrono>
#include <cstring>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bus/bus.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace {

using Json = nlohmann::json;
namespace msg = skein::msg;

constexpr std::uint8_t kFloat32 = 7;  // sensor_msgs/msg/PointField

Json columns_of(const msg::PointCloud& cloud) {
  Json columns = {{"x", Json::array()}, {"y", Json::array()}, {"z", Json::array()}};
  for (const auto& point : cloud.points()) {
    columns["x"].push_back(point.x());
    columns["y"].push_back(point.y());
    columns["z"].push_back(point.z());
  }
  for (const auto& channel : cloud.channels()) columns[channel.name()] = channel.values();
  return columns;
}

Json columns_of(const msg::PointCloud2& cloud) {
  Json columns = Json::object();
  for (const auto& field : cloud.fields()) {
    Json& column = columns[field.name()] = Json::array();
    for (std::size_t at = field.offset(); at + 4 <= cloud.data().size(); at += cloud.point_step()) {
      float value = 0.0F;
      std::memcpy(&value, cloud.data().data() + at, sizeof value);
      column.push_back(field.datatype() == kFloat32 ? Json(value) : Json());
    }
  }
  return columns;
}

template <class Cloud>
Json read(const skein::bus::Sample& sample) {
  Cloud cloud;
  return skein::decode(sample.payload, cloud) ? columns_of(cloud) : Json();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  const auto bus = skein::bus::make_bus({.vendor = argv[1]});
  const auto participant = bus->join(std::stoi(argv[2]));
  std::mutex mutex;
  std::ofstream file(argv[3]);
  const auto note = [&](const Json& line) {
    const std::scoped_lock lock(mutex);
    file << line.dump() << std::endl;
  };
  std::vector<std::unique_ptr<skein::bus::Reader>> readers;
  for (int i = 4; i + 1 < argc; i += 2) {
    const std::string topic = argv[i], type = argv[i + 1];
    const bool new_kind = type == skein::type_name<msg::PointCloud2>();
    const auto note_sample = [&note, topic, new_kind](skein::bus::Sample&& sample) {
      note({{"topic", topic}, {"points", new_kind ? read<msg::PointCloud2>(sample) : read<msg::PointCloud>(sample)}});
    };
    readers.push_back(participant->create_reader({topic, type, {.reliable = true, .depth = 1000}}, note_sample));
  }
  for (bool told = false;;) {
    bool matched = true;
    for (const auto& reader : readers) matched = matched && !reader->matched().empty();
    if (matched && !told) note({{"listening", true}});
    told = told || matched;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polling period; nothing depends on it
  }
}
