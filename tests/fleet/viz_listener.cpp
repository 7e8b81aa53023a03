// A participant in a run's world domain, not part of the fleet, that reads the topics for viewers, as RViz 2 would.
//   viz_listener VENDOR DOMAIN FILE
// Appends one line of JSON to FILE per sample, {"topic": "/viz/links", ...}; and, once it has found the writer of each
// topic, the line {"listening": true}. Runs until it is killed.
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bus/bus.hpp"
#include "core/topics.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace {

using Json = nlohmann::json;
namespace msg = skein::msg;

double stamp_of(const msg::Time& time) { return time.sec() + 1e-9 * time.nanosec(); }

Json xyz(const auto& p) { return {p.x(), p.y(), p.z()}; }

Json json_of(const msg::Marker& marker) {
  Json points = Json::array();
  for (const msg::Point& point : marker.points()) points.push_back(xyz(point));
  return {{"stamp", stamp_of(marker.header().stamp())},
          {"frame", marker.header().frame_id()},
          {"name", marker.ns() + std::to_string(marker.id())},
          {"type", marker.type()},
          {"action", marker.action()},
          {"position", xyz(marker.pose().position())},
          {"text", marker.text()},
          {"points", std::move(points)}};
}

Json json_of(const msg::MarkerArray& array) {
  Json markers = Json::array();
  for (const msg::Marker& marker : array.markers()) markers.push_back(json_of(marker));
  return {{"stamp", markers.empty() ? Json() : markers[0]["stamp"]}, {"markers", markers}};
}

Json json_of(const msg::TFMessage& message) {
  Json frames = Json::object(), stamp;
  for (const msg::TransformStamped& frame : message.transforms()) {
    stamp = stamp_of(frame.header().stamp());
    frames[frame.child_frame_id()] = {{"parent", frame.header().frame_id()},
                                      {"position", xyz(frame.transform().translation())}};
  }
  return {{"stamp", stamp}, {"frames", frames}};
}

/// The points of a cloud whose fields are x, y, z and intensity.
Json json_of(const msg::PointCloud2& cloud) {
  Json points = Json::array();
  for (std::size_t at = 0; at + cloud.point_step() <= cloud.data().size(); at += cloud.point_step()) {
    std::array<float, 4> point{};
    std::memcpy(point.data(), cloud.data().data() + at, sizeof point);
    points.push_back(point);
  }
  return {{"stamp", stamp_of(cloud.header().stamp())}, {"frame", cloud.header().frame_id()}, {"points", points}};
}

Json json_of(const msg::Clock& clock) { return {{"stamp", stamp_of(clock.clock())}}; }

template <class Message>
Json decoded(const skein::bus::Sample& sample) {
  Message message;
  return skein::decode(sample.payload, message) ? json_of(message) : Json::object();
}

Json decoded(const std::string& type, const skein::bus::Sample& sample) {
  if (type == skein::type_name<msg::Marker>()) return decoded<msg::Marker>(sample);
  if (type == skein::type_name<msg::MarkerArray>()) return decoded<msg::MarkerArray>(sample);
  if (type == skein::type_name<msg::TFMessage>()) return decoded<msg::TFMessage>(sample);
  if (type == skein::type_name<msg::PointCloud2>()) return decoded<msg::PointCloud2>(sample);
  return decoded<msg::Clock>(sample);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const auto bus = skein::bus::make_bus({.vendor = argv[1]});
  const auto participant = bus->join(std::stoi(argv[2]));
  std::mutex mutex;
  std::ofstream file(argv[3]);
  const auto note = [&](const Json& line) {
    const std::scoped_lock lock(mutex);
    file << line.dump() << std::endl;
  };
  std::vector<std::unique_ptr<skein::bus::Reader>> readers;
  for (const skein::topics::TopicInfo& topic : skein::topics::viewer_topics()) {
    const skein::topics::WireTopic wire = skein::topics::wire(topic);
    const auto note_sample = [&note, type = wire.type, name = std::string(topic.pattern)](skein::bus::Sample&& sample) {
      Json line = decoded(type, sample);
      line["topic"] = name;
      note(line);
    };
    readers.push_back(participant->create_reader(
        {wire.name, wire.type, {.reliable = true, .latched = wire.latched, .depth = 1000}}, note_sample));
  }
  for (bool told = false;;) {
    bool matched = true;
    for (const auto& reader : readers) matched = matched && !reader->matched().empty();
    if (matched && !told) note({{"listening", true}});
    told = told || matched;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // polling period; nothing depends on it
  }
}
