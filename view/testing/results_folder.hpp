// For tests: a results folder of a short run of two UAVs.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace skein::view {

class ResultsFolder {
 public:
  ResultsFolder() {
    write("result.json", R"({"scenario": "towers", "status": "completed", "score": 0.8765432101234567,
      "points_detected": 1, "sim_time_s": 3.0, "exchange_period_s": 0.05, "planners": {"a": "kios", "b": "hover"},
      "uavs": [{"name": "a", "role": "explorer"}, {"name": "b", "role": "photographer"}],
      "station": {"position": [1, 2, 0]}, "collisions": [{"time_s": 2.5, "uav": "b", "with": "structure"}]})");
  }

  const std::filesystem::path& path() const { return folder_.path(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path() / name) << text; }

  void write_tables() const {
    write("scene.json", R"({"boxes": []})");
    write("score.csv", "index,x,y,z,nx,ny,nz,score\n0,1,2,3,0,0,1,0.877\n1,1,2,4,0,0,1,0\n");
    std::string poses = "time_s,uav,x,y,z,qw,qx,qy,qz,vx,vy,vz,gimbal_pitch,gimbal_yaw,alive,clearance\n";
    for (int i = 0; i <= 30; ++i) {
      const std::string time = std::to_string(0.1 * i);
      poses += time + ",a," + time + ",0,1,1,0,0,0,1,0,0,0,0,1,5\n" + time + ",b,0,0,2,1,0,0,0,0,0,0,0,0,1,5\n";
    }
    write("trajectories.csv", poses);
    write("events.csv",
          "step,time_s,event,subject,object\n0,0.00,joined,a,\n1,0.05,link_up,a,gcs\n1,0.05,link_up,gcs,a\n"
          "20,1.00,link_down,a,gcs\n20,1.00,captured,a,0\n30,1.50,released,a,0\n");
    write("captures.csv",
          "uav,capture,tick,time_s,point,q_seen,q_blur,q_res,q_distance,q,delivered_at_s,reason\n"
          "a,0,400,1.00,0,1,0.9,0.974,0.99,0.877,1.20,\na,0,400,1.00,1,1,0.5,0.5,0.9,0.25,1.20,better capture\n"
          "b,0,800,2.00,1,1,0.9,0.9,0.9,0.81,,uav collided\n");
    write("score_timeline.csv", "time_s,points,score\n0.00,0,0\n1.20,1,0.877\n");
  }

 private:
  ScratchFolder folder_;
};

}  // namespace skein::view
