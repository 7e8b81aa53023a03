// For tests: results folders with random contents, also with missing, truncated and hostile data.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "process/json_text.hpp"
#include "results/causes.hpp"
#include "results/testing/drawn_map.hpp"
#include "results/testing/scratch.hpp"

namespace skein::report {

/// Texts that break out of HTML, JSON, CSS or a script if they are not escaped.
inline const std::vector<std::string> kNastyTexts = {"kios",
                                                     "</script><script>alert(1)</script>",
                                                     "<!--",
                                                     "--><b>",
                                                     "\"'&<>`",
                                                     "exec:./a 'b' \"c\" && d",
                                                     "\xff\xfe",
                                                     "\x01\x02",
                                                     "é漢字😀",
                                                     "]]>",
                                                     "\\u003c/script>",
                                                     "\xe2\x80\xa8",
                                                     ""};

class OddRun {
 public:
  explicit OddRun(std::mt19937& random) : random_(random) {
    static constexpr std::size_t kFleets[] = {0, 1, 2, 5, 5, 13, 100};
    const std::size_t uavs = kFleets[below(std::size(kFleets))];
    for (std::size_t i = 0; i < uavs; ++i) names_.push_back("uav_" + std::to_string(i));
    steps_ = uavs > 20 ? 20 : below(400);
    points_ = one_in(5) ? 0 : below(300);
  }

  void write(const std::filesystem::path& dir) {
    write_text(dir / "result.json", result().dump(2, ' ', false, Json::error_handler_t::replace));
    const auto table = [&](const char* name, const std::string& text) {
      if (one_in(12)) return;  // this file is missing
      write_text(dir / name, one_in(6) ? text.substr(0, below(text.size() + 1)) : text);
    };
    table("scene.json", scene());
    table("score.csv", scores());
    table("losses.csv", losses());
    table("trajectories.csv", trajectories());
    table("captures.csv", captures());
    table("events.csv", events());
    table("score_timeline.csv", timeline());
    table("activity.csv", activities());
    for (const std::string& name : names_) table(("map-" + name + ".bt").c_str(), results::drawn_map(random_));
  }

 private:
  std::size_t below(std::size_t limit) { return limit > 0 ? random_() % limit : 0; }
  bool one_in(std::size_t many) { return below(many) == 0; }
  double number(double most) { return most * static_cast<double>(below(10'001)) / 10'000.0; }
  std::string nasty() { return kNastyTexts[below(kNastyTexts.size())]; }
  double time() { return 0.05 * static_cast<double>(below(steps_ + 1)); }
  std::string any_member() { return names_.empty() || one_in(6) ? "gcs" : names_[below(names_.size())]; }
  static std::string text(double value) { return Json(value).dump(); }

  Json result() {
    Json json = {{"skein_version", "1 " + nasty()},
                 {"scenario", nasty()},
                 {"seed", below(9)},
                 {"scene_seed", below(3)},
                 {"clock", "lockstep"},
                 {"exchange_period_s", 0.05},
                 {"rules", one_in(2) ? Json("contest") : Json::object()},
                 {"digest", one_in(2) ? Json("abc") : Json()},
                 {"sim_time_s", 0.05 * static_cast<double>(steps_)},
                 {"score", number(100.0)},
                 {"score_earned", number(100.0)},
                 {"points_total", one_in(4) ? Json() : Json(points_)}};
    static constexpr const char* kStatus[] = {"completed", "no_takeoff", "interrupted", "aborted"};
    json["status"] = kStatus[below(4)];
    for (const char* key : {"uavs", "collisions", "faults", "warnings", "lost_members"}) json[key] = Json::array();
    for (const std::string& name : names_) {
      json["planner"][name] = nasty();
      json["score_by_uav"][name] = number(10.0);
      json["dds"]["uav_agent-" + name] = nasty();
      json["uavs"].push_back({{"name", name},
                              {"role", one_in(2) ? "explorer" : "photographer"},
                              {"alive", one_in(3) ? Json() : Json(one_in(2))},
                              {"captures", below(100)},
                              {"planner_cpu_s", one_in(2) ? Json() : Json(1.5)}});
      if (one_in(4))
        json["collisions"].push_back(
            {{"time_s", time()}, {"uav", name}, {"with", nasty()}, {"position", {1.0, 2.0, 3.0}}});
    }
    for (std::size_t i = below(4); i > 0; --i) {
      json["warnings"].push_back(nasty());
      json["lost_members"].push_back({{"member", any_member()}, {"time_s", time()}, {"reason", nasty()}});
      json["faults"].push_back({{"kind", nasty()},
                                {"target", any_member() + " " + nasty()},
                                {"began_step", one_in(3) ? Json() : Json(below(50))},
                                {"ended_step", one_in(2) ? Json() : Json(60)}});
    }
    json["attainable"] = one_in(3) ? Json() : Json{{"points", points_}, {"score", number(200.0)}};
    json["losses"] = nullptr;
    if (one_in(2)) {
      json["losses"] = Json::object();
      for (const results::Cause& cause : results::kCauses)
        json["losses"][std::string(cause.key)] = {{"points", below(9)}, {"score", number(20.0) - 1.0}};
      for (std::size_t i = 0; one_in(2) && i < results::kPoorParts.size(); ++i)
        json["losses"]["below_threshold"]["by_part"][results::kPoorParts[i].key] = {{"points", below(9)},
                                                                                    {"score", number(5.0)}};
    }
    json["radio"] = {{"sent", below(1000)}, {"per_link", Json::array()}};
    json["radio"]["per_link"].push_back(
        {{"from", any_member()}, {"to", any_member()}, {"sent", below(99)}, {"delivered", below(99)}});
    json["station"] = {{"position", one_in(3) ? Json::array() : Json{1.0, 2.0, 0.3}}};
    for (const char* key :
         {"uavs", "planner", "dds", "radio", "warnings", "faults", "attainable", "station", "score", "collisions"}) {
      if (one_in(25)) json.erase(key);
      if (one_in(40)) json[key] = nullptr;
    }
    return json;
  }

  std::string scene() {
    Json json = {{"boxes", Json::array()}, {"points", Json::array()}};
    for (std::size_t i = below(4); i > 0; --i) {
      json["boxes"].push_back({{"name", nasty()},
                               {"center", {number(9.0), number(9.0), number(9.0)}},
                               {"size", {number(30.0), 9.0, 9.0}},
                               {"rotation", {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}});
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  std::string scores() {
    std::string csv = "x,y,z,nx,ny,nz,score,index\n";
    for (std::size_t i = 0; i < points_; ++i) {
      csv += text(number(40.0)) + "," + text(number(40.0)) + "," + (one_in(2000) ? "1e300" : text(number(40.0))) +
             ",0,0,1," + text(one_in(2) ? 0.0 : number(1.0)) + "," + std::to_string(i) + "\n";
    }
    return csv;
  }
  std::string losses() {
    std::string csv = "index,x,y,z,estimate,score,cause,loss,uav,capture,q_distance,q_tilt,q_blur,q\n";
    for (std::size_t i = 0; i < points_; i += 1 + below(3)) {
      csv += std::to_string(i) + ",0,0,0," + text(number(1.0)) + ",0.1," +
             std::string(one_in(9) ? "none" : results::kCauses[below(results::kCauses.size())].key) + "," +
             text(number(1.0)) + ",,,,,,\n";
    }
    return csv;
  }
  std::string trajectories() {
    std::string csv = "time_s,uav,x,y,z,qw,qx,qy,qz,vx,vy,vz,gimbal_pitch,gimbal_yaw,alive\n";
    for (std::size_t k = 0; k < steps_; k += 2) {
      for (const std::string& name : names_) {
        csv += text(0.05 * static_cast<double>(k)) + "," + name + "," + text(number(50.0)) + "," + text(number(50.0)) +
               "," + (one_in(9000) ? "nan" : text(number(50.0))) + ",1,0,0,0," + (one_in(3) ? "0" : "2") +
               ",0,0,0,0,1\n";
      }
    }
    return csv;
  }
  std::string captures() {
    std::string csv = "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason\n";
    for (std::size_t i = 0; i < below(900); ++i) {
      const double time_s = time();
      csv += any_member() + "," + std::to_string(below(60)) + ",0," + text(time_s) + "," +
             std::to_string(below(points_ + 5)) + ",1,1,1,1," + text(number(1.0)) + "," +
             (one_in(3) ? "" : text(time_s + number(3.0))) + "," + (one_in(5) ? "uav collided" : "") + "\n";
    }
    return csv;
  }
  std::string events() {
    static constexpr const char* kEvents[] = {"joined", "left", "link_up", "link_down", "captured", "released"};
    std::string csv = "step,time_s,event,subject,object\n";
    for (std::size_t k = 0; k < steps_; ++k) {
      for (std::size_t i = below(4); i > 0; --i) {
        const std::size_t event = below(6);
        csv += std::to_string(k) + "," + text(0.05 * static_cast<double>(k)) + "," + kEvents[event] + "," +
               any_member() + "," + (event == 2 || event == 3 ? any_member() : std::to_string(below(9))) + "\n";
      }
    }
    return csv;
  }
  std::string activities() {
    static constexpr const char* kModes[] = {"takes off", "flies to a goal", "stands: <b>", "dances", ""};
    std::string csv = "step,time_s,uav,mode,goal_x,goal_y,goal_z,waits_for,no_way\n";
    for (std::size_t k = 0; k < steps_; k += 1 + below(9)) {
      csv += std::to_string(k) + "," + text(0.05 * static_cast<double>(k)) + "," + any_member() + "," +
             kModes[below(5)] + ",,,," + (one_in(3) ? any_member() : "") + ",\n";
    }
    return csv;
  }
  std::string timeline() {
    std::string csv = "time_s,points,score\n";
    double score = 0.0;
    for (std::size_t k = 0; k < steps_; ++k) {
      csv += text(0.05 * static_cast<double>(k)) + "," + std::to_string(k) + "," + text(score) + "\n";
      score += number(1.0);
    }
    return csv;
  }

  std::mt19937& random_;
  std::vector<std::string> names_;
  std::size_t steps_ = 0, points_ = 0;
};

}  // namespace skein::report
