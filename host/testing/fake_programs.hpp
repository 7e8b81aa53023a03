// For tests: a folder with shell scripts that replace Skein's programs, and a small scenario for them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "host/preflight.hpp"
#include "tests/support/places.hpp"
#include "tests/support/text_files.hpp"

namespace skein::cli {

inline void write_script(const std::filesystem::path& file, const std::string& body) {
  write_text(file, "#!/bin/sh\n" + body);
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

/// Reads the options that the scripts need into $out, $uav and $check.
inline constexpr const char* kReadOptions = R"(
check=no
while [ $# -gt 0 ]; do
  case $1 in
    --check|--oracle|--list-planners) check=yes ;;
    --out) out=$2; shift ;;
    --uav) uav=$2; shift ;;
    --planner) planner=$2; shift ;;
  esac
  shift
done
[ $check = no ] || exit 0
)";

/// A scenario of two UAVs in a procedural scene. It defines its vehicles itself.
inline constexpr const char* kSmallScenario = R"(
name: small
desired_mm_per_pixel: 2.0
scene: {family: towers}
fleet:
  - {name: alpha, vehicle: {name: x, role: explorer, lidar: {}}, start: [0, 0]}
  - {name: beta, vehicle: {name: p, role: photographer}, start: [5, 0]}
)";

/// A scenario of this many UAVs, u0, u1, and so on.
inline std::string scenario_of(int uavs) {
  std::string text = "desired_mm_per_pixel: 2.0\nscene: {family: towers}\nfleet:\n";
  for (int i = 0; i < uavs; ++i) {
    text += "  - {name: u" + std::to_string(i) + ", vehicle: {name: x, role: explorer, lidar: {}}, start: [" +
            std::to_string(5 * (i % 16)) + ", " + std::to_string(5 * (i / 16)) + "]}\n";
  }
  return text;
}

/// A script that replaces `sim_server --draw-world W --scene-seed S --export-scene FOLDER`: it writes a world of two
/// UAVs, and a line in a log.
inline constexpr const char* kDrawWorld = R"(
echo "$2_$4" >> "$(dirname "$0")/drawn.log"
mkdir -p "$6/models"
for name in m.stl p.pcd b.yaml; do echo x > "$6/models/$name"; done
cat > "$6/$2_$4.yaml" <<END
desired_mm_per_pixel: 2.0
scene: {family: wild, scene_seed: $4, meshes: [./models/m.stl], points: ./models/p.pcd, boxes: ./models/b.yaml}
fleet:
  - {name: alpha, vehicle: {name: x, role: explorer, lidar: {}}, start: [0, 0]}
  - {name: beta, vehicle: {name: p, role: photographer}, start: [5, 0]}
END
)";

/// While this object lives, `skein` finds its programs in a scratch folder. By default, each exits at once with code 0.
class FakePrograms {
 public:
  FakePrograms() {
    ::setenv("SKEIN_BIN_DIR", dir().c_str(), 1);
    ::setenv("SKEIN_CONFIG_DIR", source_path("config").c_str(), 1);
    for (const char* name : {"sim_server", "comm_router", "station", "uav_agent"}) script(name, "");
    write_text(scenario(), kSmallScenario);
  }
  ~FakePrograms() {
    for (const char* name : {"SKEIN_BIN_DIR", "SKEIN_CONFIG_DIR"}) ::unsetenv(name);
  }

  void script(const std::string& program, const std::string& body) const {
    write_script(dir() / program, kReadOptions + body);
  }
  const std::filesystem::path& dir() const { return scratch_.path(); }
  std::filesystem::path scenario() const { return dir() / "small.yaml"; }

 private:
  ScratchDir scratch_;
};

}  // namespace skein::cli
