// What the UAVs say to each other and to the station, as words of text on /plan.   Thread: that of the node.
//   start NAME explorer|photographer X Y Z        where it stands, until the teams are made
//   fleet {NAME explorer|photographer X Y Z}...   of the station: all of them; a UAV takes its own list after 15 s
//   at NAME X Y Z {X Y Z}...                      the cell where it is, and the next ones on its way
//   work NAME REGION SURVEYED DONE                region of its team, sections surveyed by the leader, own done
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
  /// @param grid  takes what others say of it. Both must outlive this.
  Radio(rclcpp::Node& node, Grid& grid);

  const std::string& name() const { return name_; }
  /// All starts, once the list is complete.
  std::optional<std::map<std::string, Start>> fleet() const;
  /// nullptr: never heard.
  const Work* work_of(const std::string& name) const;
  /// Where other UAVs, before this one in rank, are about to fly.
  std::vector<Cell> claimed() const;
  /// Before the teams are known, every UAV is before every other.
  void set_rank(std::map<std::string, int> ranks) { ranks_ = std::move(ranks); }

  void say_start(const Start& start);
  void say_at(const std::vector<Cell>& cells);
  void say_work(const Work& work);
  /// What its own LiDAR says of a cell.
  void found(const Cell& cell, bool occupied) { learn(cell, occupied); }
  /// The newest cells that it has not said yet, and some of the others, in turn: links come and go.
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
  std::map<std::string, Start> starts_, list_;  ///< heard one by one; of the station
  double since_s_ = -1.0;                       ///< its own first report
  std::map<std::string, Work> works_;
  std::map<std::string, Claim> claims_;
  std::map<std::string, int> ranks_;
  std::vector<std::pair<Cell, bool>> cells_;  ///< and whether they are occupied, in the order in which it learnt that
  std::size_t said_ = 0, repeated_ = 0;       ///< of cells_
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr in_;
};

}  // namespace baseline
