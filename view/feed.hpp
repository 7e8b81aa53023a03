// What browsers are told of a flight: its scene, lines in their order (story.hpp), the newest state, and clouds (points
// and maps) for those who ask for them. It is filled by one side and read by another: a reader keeps its place in the
// lines and comes for more when it has sent what it has.
// So a slow browser holds nothing up and nothing piles up for it: of states and of each cloud it gets the newest, of
// lines all.
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

/// How far a browser has been told.
struct FeedPlace {
  bool scene = false;
  std::size_t lines = 0;
  std::uint64_t state = 0;
  bool more = false;                                 ///< lines were left
  std::map<std::string, std::uint64_t> clouds = {};  ///< that it asks for, by name

  /// Asks for these clouds and no others; one that it asked for before is not told again until there is news.
  void look_at(const std::vector<std::string>& names);
};

class Feed {
 public:
  /// Texts are JSON objects. Nobody is told anything before there is a scene; what comes before it is kept.
  void set_scene(std::string scene);
  void add_line(std::string line);
  void set_state(std::string state);
  /// @param name  who asks for it is told the newest of this name, which is kept.
  void set_cloud(const std::string& name, std::string cloud);

  /// Of all clouds that there are.
  std::vector<std::string> cloud_names() const;

  /// The next message for who stands at `place`, which moves on: {"scene": ..., "lines": [...], "state": ...,
  /// "clouds": [...]}, each only if it is news; "more" is true while lines are left. About `most_bytes`, but at least a
  /// line, and a cloud where that is all.
  /// @returns an empty text when there is nothing new.
  std::string next(FeedPlace& place, std::size_t most_bytes) const;
  /// Who is told, from the filling thread, that there is something new; replaces the one before. After it has returned
  /// no call of the former runs.
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
  std::map<std::string, Cloud> clouds_;  ///< the newest by name
  std::uint64_t cloud_number_ = 0;
  mutable std::mutex tell_mutex_;
  std::function<void()> tell_;
};

}  // namespace skein::view
