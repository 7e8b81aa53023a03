// The messages between the UAVs and the station, as words of text on /plan.   Thread: that of the node.
//   start NAME explorer|photographer X Y Z        where it stands, until it knows the teams
//   fleet {NAME explorer|photographer X Y Z}...   from the station: all UAVs; after 15 s, a UAV uses its own list
//   at NAME X Y Z {X Y Z}...                      the cell where it is, and the next two on its way
//   work NAME REGION SURVEYED DONE                region of its team; sections surveyed, if it leads; own section done
//   map {X Y Z 0|1}...                            cells that are free (0) or occupied (1)
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

#include "grid.hpp"
#include "plan.hpp"

namespace baseline {

struct Work {
  int region = 0, surveyed = 0;
  bool done = false;
  double heard_s = 0.0;
};

class Radio {
 public:
  /// @param grid  learns the cells that other UAVs send. Both must outlive this.
  Radio(rclcpp::Node& node, Grid& grid);

  const std::string& name() const { return name_; }
  /// All starts, once the list is complete.
  std::optional<std::map<std::string, Start>> fleet() const;
  /// nullptr: never heard.
  const Work* work_of(const std::string& name) const;
  /// The cells where other UAVs with right of way are, or into which they are about to fly.
  std::vector<Cell> claimed() const;
  /// A UAV has right of way over those with a higher rank. Until this call, every other UAV has right of way.
  void set_rank(std::map<std::string, int> ranks) { ranks_ = std::move(ranks); }

  void say_start(const Start& start);
  void say_at(const std::vector<Cell>& cells);
  void say_work(const Work& work);
  /// The UAV's own LiDAR has found that a cell is free or occupied.
  void found(const Cell& cell, bool occupied) { learn(cell, occupied); }
  /// Sends cells that it has not sent yet, up to 400, and repeats up to 200 of all in turn: links come and go.
  void say_map();

 private:
  struct Claim {
    std::vector<Cell> cells;
    double heard_s = 0.0;
  };

  void hear(const std::string& text);
  void learn(const Cell& cell, bool occupied);
  void say(const std::string& text);

  rclcpp::Node& node_;
  Grid& grid_;
  const std::string name_;
  std::map<std::string, Start> starts_, list_;  ///< received one by one; from the station
  double since_s_ = -1.0;                       ///< time of its own first report
  std::map<std::string, Work> works_;
  std::map<std::string, Claim> claims_;
  std::map<std::string, int> ranks_;
  std::vector<std::pair<Cell, bool>> cells_;  ///< and whether they are occupied, in the order of learning
  std::size_t said_ = 0, repeated_ = 0;       ///< of cells_
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr in_;
};

}  // namespace baseline
