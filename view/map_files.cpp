#include "view/map_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/messages/view_topics.hpp"
#include "core/types.hpp"
#include "idl/cdr.hpp"
#include "idl/conversions.hpp"
#include "recording/mcap/reader.hpp"
#include "results/run_folder.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;

/// The map files of one UAV, in the order in which its program was started.
std::vector<fs::path> files_of(const fs::path& dir, const std::string& uav) {
  std::vector<fs::path> files;
  for (int life = 0; fs::exists(dir / run_folder::maps_file(uav, life)); ++life) {
    files.push_back(dir / run_folder::maps_file(uav, life));
  }
  return files;
}

/// @returns nullopt when one of the files is damaged, or is not a map file.
std::optional<std::vector<mcap::Reader>> open_all(const std::vector<fs::path>& files) try {
  std::vector<mcap::Reader> readers;
  for (const fs::path& file : files) {
    readers.emplace_back(file);
    if (!readers.back().damage().empty()) return std::nullopt;
  }
  return readers;
} catch (const InputError&) {
  return std::nullopt;
}

using OnMap = std::function<void(const mcap::Message&)>;
void each_map(std::vector<mcap::Reader>& readers, const std::string& uav, const OnMap& on_map) {
  const std::string topic = topics::flight_map(uav).name.substr(2);  // without the "rt" of its wire name
  for (mcap::Reader& reader : readers) {
    reader.messages([&](const mcap::Channel& channel, const mcap::Message& message) {
      if (channel.topic == topic) on_map(message);
    });
  }
}

/// Collects the snapshots of one UAV.
class Snapshots {
 public:
  explicit Snapshots(const std::function<double(double)>& height_m) : height_m_(height_m) {}

  void add(const mcap::Message& message) {
    msg::Octomap octomap;
    if (!decode(message.data, octomap)) return fail();
    const double time_s = seconds(from_time(octomap.header().stamp()));
    const bool fits = occupied.empty() || (time_s > occupied.back().time_s && octomap.resolution() == cell_m);
    if (!fits) return fail();
    cell_m = octomap.resolution();
    const std::string_view tree(reinterpret_cast<const char*>(octomap.data().data()), octomap.data().size());
    ShownMap map;  // stays empty for an empty octree: nothing is known
    if (!tree.empty()) {
      auto shown = shown_map(tree, cell_m, height_m_(time_s), std::numeric_limits<std::size_t>::max());
      if (!shown) return fail();
      map = std::move(*shown);
    }
    occupied.push_back({time_s, std::move(map.occupied)});
    free.push_back({time_s, std::move(map.free)});
  }

  bool sound = true;
  double cell_m = 0.5;
  std::vector<RunsAt> occupied, free;

 private:
  void fail() { sound = false; }

  const std::function<double(double)>& height_m_;
};

}  // namespace

std::optional<MapInTime> read_maps(const fs::path& dir, const std::string& uav,
                                   const std::function<double(double)>& height_m) {
  auto readers = open_all(files_of(dir, uav));
  if (!readers) return std::nullopt;
  std::size_t count = 0, at = 0;
  each_map(*readers, uav, [&](const mcap::Message&) { ++count; });
  if (count == 0) return std::nullopt;
  const std::size_t stride = (count + kMostMapsRead - 1) / kMostMapsRead;
  Snapshots snapshots(height_m);
  each_map(*readers, uav, [&](const mcap::Message& message) {
    ++at;
    if (snapshots.sound && (count - at) % stride == 0) snapshots.add(message);  // always takes the last one
  });
  if (!snapshots.sound) return std::nullopt;
  return map_in_time(std::move(snapshots.occupied), std::move(snapshots.free), snapshots.cell_m);
}

bool has_maps_in_time(const fs::path& dir, std::span<const std::string> uavs) {
  bool any = false;
  for (const std::string& uav : uavs) {
    const std::vector<fs::path> files = files_of(dir, uav);
    if (!open_all(files)) return false;
    any = any || !files.empty();
  }
  return any;
}

}  // namespace skein::view
