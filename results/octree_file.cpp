#include "results/octree_file.hpp"

#include <optional>
#include <sstream>
#include <string>

namespace skein::results {
namespace {

constexpr std::string_view kFirstLine = "# Octomap OcTree binary file";
constexpr double kFinest_m = 1e-3, kCoarsest_m = 100.0;

struct Head {
  std::size_t nodes = 0;
  double cell_m = 0.0;
  std::size_t size = 0;  ///< bytes
};

std::optional<Head> head_of(std::string_view file) {
  Head head;
  bool right_kind = false;
  for (bool first = true;; first = false) {
    const std::size_t end = file.find('\n', head.size);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string line(file.substr(head.size, end - head.size));
    head.size = end + 1;
    if (first && line != kFirstLine) return std::nullopt;
    if (line.starts_with('#')) continue;
    if (line == "data") break;
    std::istringstream words(line);
    std::string key, id;
    words >> key;
    if (key == "id") right_kind = words >> id && id == "OcTree";
    if (key == "size") words >> head.nodes;
    if (key == "res") words >> head.cell_m;
    if (!words) return std::nullopt;
  }
  const bool sound = head.cell_m >= kFinest_m && head.cell_m <= kCoarsest_m;
  return right_kind && sound ? std::optional(head) : std::nullopt;
}

}  // namespace

bool visit_octree_file(std::string_view file, const std::function<void(const KnownCube&)>& visit) {
  const auto head = head_of(file);
  return head && visit_octree(file.substr(head->size), head->cell_m, visit) == head->nodes;
}

std::optional<OctreeFile> octree_of_file(std::string_view file) {
  const auto head = head_of(file);
  return head ? std::optional(OctreeFile{file.substr(head->size), head->cell_m}) : std::nullopt;
}

}  // namespace skein::results
