#include "view/feed.hpp"

#include <utility>

namespace skein::view {

void Feed::set_scene(std::string scene) {
  {
    const std::scoped_lock lock(mutex_);
    scene_ = std::move(scene);
  }
  tell();
}

void Feed::add_line(std::string line) {
  {
    const std::scoped_lock lock(mutex_);
    lines_.push_back(std::move(line));
  }
  tell();
}

void Feed::set_state(std::string state) {
  {
    const std::scoped_lock lock(mutex_);
    state_ = std::move(state);
    ++state_number_;
  }
  tell();
}

std::string Feed::next(FeedPlace& place, std::size_t most_bytes) const {
  const std::scoped_lock lock(mutex_);
  if (scene_.empty()) return {};
  std::string text;
  const auto add = [&text](const char* key, const std::string& value) {
    text += text.empty() ? "{\"" : ",\"";
    text += key;
    text += "\":" + value;
  };
  if (!std::exchange(place.scene, true)) add("scene", scene_);
  if (place.lines < lines_.size()) {
    std::string list;
    while (place.lines < lines_.size() && (list.empty() || text.size() + list.size() < most_bytes)) {
      list += (list.empty() ? "[" : ",") + lines_[place.lines++];
    }
    add("lines", list + "]");
    if (place.lines < lines_.size()) add("more", "true");
  }
  if (place.state != state_number_ && !state_.empty()) add("state", state_);
  place.state = state_number_;
  return text.empty() ? text : text + "}";
}

void Feed::on_news(std::function<void()> tell) {
  const std::scoped_lock lock(tell_mutex_);
  tell_ = std::move(tell);
}

void Feed::tell() const {
  const std::scoped_lock lock(tell_mutex_);
  if (tell_) tell_();
}

}  // namespace skein::view
