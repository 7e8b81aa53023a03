#include "view/kept_flight.hpp"

#include <limits>
#include <vector>

#include "view/look_order.hpp"
#include "view/packed.hpp"

namespace skein::view {
namespace {

struct Choice {
  bool lidar = true, maps = true;
};

/// @returns a JSON object; an empty one as long as the flight has no scene.
std::string told(const Feed& flight, const std::vector<std::string>& clouds) {
  FeedPlace place;
  place.look_at(clouds);
  const std::string text = flight.next(place, std::numeric_limits<std::size_t>::max());
  return text.empty() ? "{}" : text;
}

std::string told(const Feed& flight, const Choice& choice) {
  std::vector<std::string> clouds = flight.cloud_names();
  std::erase_if(clouds, [&](const std::string& name) {
    return (!choice.lidar && name.starts_with(lidar_cloud(""))) || (!choice.maps && name.starts_with(map_cloud("")));
  });
  const auto word = [](bool is) { return is ? "true" : "false"; };
  std::string text = told(flight, clouds);
  text.pop_back();  // }
  if (text.size() > 1) text += ',';
  return text + R"("kept":{"lidar":)" + word(choice.lidar) + R"(,"maps":)" + word(choice.maps) + "}}";
}

}  // namespace

std::string kept_flight(const Feed& flight, std::size_t most_bytes) {
  if (most_bytes == 0) return packed(told(flight, std::vector<std::string>()));
  for (const Choice& choice : {Choice{true, true}, Choice{false, true}}) {
    if (std::string text = packed(told(flight, choice)); text.size() <= most_bytes) return text;
  }
  return packed(told(flight, Choice{false, false}));
}

}  // namespace skein::view
