// The data that browsers get about a flight: its scene, all lines in their order (story.hpp), the newest state, and
// clouds (LiDAR points and maps) for those browsers that request them. One side fills the feed; the page's server reads
// it. For each browser, the server keeps a place in the feed, and asks for more once the last message is sent.
// So a slow browser blocks nothing, and no data queues up for it: it gets all lines, but only the newest state and the
// newest version of each cloud.
// Threads: any.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace skein::view {

/// The data that a browser has got so far.
struct FeedPlace {
  bool scene = false;
  std::size_t lines = 0;
  std::uint64_t state = 0;
  bool more = false;  ///< whether the last message left lines for the next one

  struct Cloud {
    std::uint64_t version = 0;  ///< that the browser has
    std::uint64_t turn = 0;     ///< when it got this version, counted in clouds; 0: never
  };
  std::map<std::string, Cloud> clouds = {};  ///< requested clouds by name
  std::uint64_t turns = 0;                   ///< number of clouds sent

  /// Requests these clouds and no others. A cloud that was requested before is not sent again until it changes.
  void look_at(const std::vector<std::string>& names);
};

class Feed {
 public:
  /// All texts are JSON objects. Before there is a scene, browsers get nothing; what is added earlier is kept for them.
  void set_scene(std::string scene);
  void add_line(std::string line);
  void set_state(std::string state);
  /// Replaces the cloud of this name. Browsers that request it get the newest one.
  void set_cloud(const std::string& name, std::string cloud);

  /// The names of all clouds in the feed.
  std::vector<std::string> cloud_names() const;

  /// The next message for a browser at `place`, which moves on: {"scene": ..., "lines": [...], "more": true, "state":
  /// ..., "clouds": [...]}, with only the keys that have news. "more" means that lines are left. `most_bytes` is a
  /// rough limit: the first line, and the first cloud if there is room left for it to begin, are sent whole. The clouds
  /// take turns: those that the browser has not got for longest come first.
  /// @returns an empty text when there is nothing new.
  std::string next(FeedPlace& place, std::size_t most_bytes) const;
  /// Sets the function that is called, in the thread that fills the feed, when there is something new. It replaces the
  /// former function; once on_news() has returned, no call of the former one is running.
  void on_news(std::function<void()> tell);

 private:
  void tell() const;
  std::string next_clouds(FeedPlace& place, std::size_t most_bytes) const;

  mutable std::mutex mutex_;
  std::string scene_, state_;
  std::vector<std::string> lines_;
  std::uint64_t state_number_ = 0;
  struct Cloud {
    std::uint64_t number = 0;
    std::string text;
  };
  std::map<std::string, Cloud> clouds_;  ///< by name: the newest
  std::uint64_t cloud_number_ = 0;
  mutable std::mutex tell_mutex_;
  std::function<void()> tell_;
};

}  // namespace skein::view
