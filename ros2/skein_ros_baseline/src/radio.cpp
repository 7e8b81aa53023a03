#include "radio.hpp"

#include <algorithm>
#include <sstream>

namespace baseline {
namespace {

constexpr double kClaimS = 2.0, kOwnListS = 15.0;
constexpr std::size_t kMostNew = 400, kMostOld = 200;

std::string text_of(const Cell& cell) {
  return " " + std::to_string(cell.x) + " " + std::to_string(cell.y) + " " + std::to_string(cell.z);
}

std::vector<Cell> cells_in(std::istream& words) {
  std::vector<Cell> cells;
  for (Cell cell; words >> cell.x >> cell.y >> cell.z;) cells.push_back(cell);
  return cells;
}

std::map<std::string, Start> starts_in(std::istream& words) {
  std::map<std::string, Start> starts;
  std::string name, role;
  for (double x, y, z; words >> name >> role >> x >> y >> z;) starts[name] = {role == "explorer", {x, y, z}};
  return starts;
}

}  // namespace

Radio::Radio(rclcpp::Node& node, Grid& grid)
    : node_(node), grid_(grid), name_(std::string(node.get_namespace()).substr(1)) {
  out_ = node.create_publisher<std_msgs::msg::String>("/plan", 64);
  in_ = node.create_subscription<std_msgs::msg::String>("/plan/" + name_, 1024,
                                                        [this](const std_msgs::msg::String& m) { hear(m.data); });
}

void Radio::hear(const std::string& text) {
  std::istringstream words(text);
  std::string kind, name;
  words >> kind;
  if (kind == "fleet") {
    list_ = starts_in(words);
  } else if (kind == "start") {
    starts_.merge(starts_in(words));
  } else if (kind == "map") {
    bool occupied = false;
    for (Cell cell; words >> cell.x >> cell.y >> cell.z >> occupied;) learn(cell, occupied);
  } else if (kind == "at" && words >> name) {
    claims_[name] = {cells_in(words), node_.now().seconds()};
  } else if (kind == "work" && words >> name) {
    Work& work = works_[name];
    words >> work.region >> work.surveyed >> work.done;
    work.heard_s = node_.now().seconds();
  }
}

void Radio::learn(const Cell& cell, bool occupied) {
  if (grid_.learn(cell, occupied)) cells_.emplace_back(cell, occupied);
}

std::optional<std::map<std::string, Start>> Radio::fleet() const {
  if (list_.count(name_) > 0) return list_;
  if (since_s_ >= 0.0 && node_.now().seconds() > since_s_ + kOwnListS) return starts_;
  return std::nullopt;
}

const Work* Radio::work_of(const std::string& name) const {
  const auto found = works_.find(name);
  return found == works_.end() ? nullptr : &found->second;
}

std::vector<Cell> Radio::claimed() const {
  const auto rank_of = [&](const std::string& name) {
    const auto found = ranks_.find(name);
    return found == ranks_.end() ? -1 : found->second;
  };
  std::vector<Cell> cells;
  for (const auto& [name, claim] : claims_) {
    if (node_.now().seconds() > claim.heard_s + kClaimS || rank_of(name) > rank_of(name_)) continue;
    cells.insert(cells.end(), claim.cells.begin(), claim.cells.end());
  }
  return cells;
}

void Radio::say(const std::string& text) {
  std_msgs::msg::String message;
  message.data = text;
  out_->publish(message);
}

void Radio::say_start(const Start& start) {
  starts_[name_] = start;
  if (since_s_ < 0.0) since_s_ = node_.now().seconds();
  std::ostringstream text;
  text << "start " << name_ << (start.explorer ? " explorer " : " photographer ") << start.p_W.transpose();
  say(text.str());
}

void Radio::say_at(const std::vector<Cell>& cells) {
  std::string text = "at " + name_;
  for (const Cell& cell : cells) text += text_of(cell);
  say(text);
}

void Radio::say_work(const Work& work) {
  say("work " + name_ + " " + std::to_string(work.region) + " " + std::to_string(work.surveyed) + " " +
      std::to_string(static_cast<int>(work.done)));
}

void Radio::say_map() {
  std::string text = "map";
  const auto add = [&](const std::pair<Cell, bool>& known) {
    text += text_of(known.first) + (known.second ? " 1" : " 0");
  };
  for (std::size_t i = 0; i < kMostNew && said_ < cells_.size(); ++i) add(cells_[said_++]);
  for (std::size_t i = 0; i < kMostOld && i < cells_.size(); ++i) add(cells_[++repeated_ % cells_.size()]);
  if (!cells_.empty()) say(text);
}

}  // namespace baseline
