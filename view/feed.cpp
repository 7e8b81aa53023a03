#include "view/feed.hpp"

#include <algorithm>
#include <utility>

namespace skein::view {

void FeedPlace::look_at(const std::vector<std::string>& names) {
  std::map<std::string, Cloud> wanted;
  for (const std::string& name : names) {
    const auto before = clouds.find(name);
    wanted[name] = before != clouds.end() ? before->second : Cloud();
  }
  clouds = std::move(wanted);
}

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

void Feed::set_cloud(const std::string& name, std::string cloud) {
  {
    const std::scoped_lock lock(mutex_);
    clouds_[name] = {++cloud_number_, std::move(cloud)};
  }
  tell();
}

/// Takes first the cloud that the browser has not got for longest: of N clouds that change all the time, it gets each
/// at every Nth turn. @returns a JSON list of clouds; an empty text if the browser has all latest versions
std::string Feed::next_clouds(FeedPlace& place, std::size_t most_bytes) const {
  std::vector<std::pair<const Cloud*, FeedPlace::Cloud*>> news;
  for (auto& [name, got] : place.clouds) {
    const auto cloud = clouds_.find(name);
    if (cloud != clouds_.end() && cloud->second.number != got.version) news.emplace_back(&cloud->second, &got);
  }
  // Of the clouds that the browser never got, the one whose latest version is the oldest comes first.
  std::ranges::sort(news, {}, [](const auto& one) { return std::pair(one.second->turn, one.first->number); });
  std::string list;
  for (const auto& [cloud, got] : news) {
    if (!list.empty() && list.size() + cloud->text.size() > most_bytes) break;
    list += (list.empty() ? "[" : ",") + cloud->text;
    *got = {cloud->number, ++place.turns};
  }
  return list.empty() ? list : list + "]";
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
  }
  place.more = place.lines < lines_.size();
  if (place.more) add("more", "true");
  if (place.state != state_number_ && !state_.empty()) add("state", state_);
  place.state = state_number_;
  if (text.size() < most_bytes) {
    if (const std::string clouds = next_clouds(place, most_bytes - text.size()); !clouds.empty()) add("clouds", clouds);
  }
  return text.empty() ? text : text + "}";
}

std::vector<std::string> Feed::cloud_names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, cloud] : clouds_) names.push_back(name);
  return names;
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
