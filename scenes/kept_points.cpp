#include "scenes/kept_points.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/text/sha256.hpp"
#include "oracle/kept_answer.hpp"
#include "oracle/mesh_hash.hpp"

namespace skein::sim {
namespace {

std::string key_of(const UnsampledScene& unsampled) {
  const Scene& scene = unsampled.scene;
  Sha256 hash;
  hash.add("points").add(kSamplingVersion).add(unsampled.point_count).add(unsampled.seed);
  add_mesh(hash, scene.mesh);
  for (const OrientedBox& box : scene.boxes) hash.add(box.center).add(box.size).add(Quaterniond(box.R_WO));
  return hash.hex();
}

/// The bits of the points as hexadecimal text: reading JSON numbers would take ten times as long.
std::string text_of(const std::vector<InterestPoint>& points) {
  std::vector<float> numbers;
  for (const InterestPoint& point : points) {
    for (const Eigen::Vector3f* vector : {&point.p_W, &point.n_W}) {
      numbers.insert(numbers.end(), vector->data(), vector->data() + 3);
    }
  }
  return to_hex(std::span(reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(float)));
}

/// Inverse of text_of(). @throws std::runtime_error if the text has an incomplete point.
std::vector<InterestPoint> points_of(const std::string& text) {
  constexpr std::size_t kDigitsOfAPoint = 6 * 2 * sizeof(float);
  if (text.size() % kDigitsOfAPoint != 0) throw std::runtime_error("its points are cut short");
  const auto digit = [](char c) { return static_cast<std::uint8_t>(c <= '9' ? c - '0' : c - 'a' + 10); };
  std::vector<InterestPoint> points(text.size() / kDigitsOfAPoint);
  std::size_t at = 0;
  for (InterestPoint& point : points) {
    for (Eigen::Vector3f* vector : {&point.p_W, &point.n_W}) {
      std::array<std::uint8_t, 3 * sizeof(float)> bytes;
      for (std::uint8_t& byte : bytes) {
        byte = static_cast<std::uint8_t>(digit(text[at]) << 4 | digit(text[at + 1]));
        at += 2;
      }
      std::memcpy(vector->data(), bytes.data(), bytes.size());
    }
  }
  return points;
}

}  // namespace

Scene sampled_or_kept(UnsampledScene unsampled, const std::filesystem::path& cache) {
  const std::string key = key_of(unsampled);
  const std::filesystem::path file = cache / ("points-" + key + ".json");
  try {
    if (const auto kept = kept_answer(file, key)) {
      unsampled.scene.points = points_of(kept->get<std::string>());
      return std::move(unsampled.scene);
    }
  } catch (const std::exception& error) {
    spdlog::warn("{} is not used: {}", file.string(), error.what());
  }
  Scene scene = sampled(std::move(unsampled));
  try {
    keep_answer(file, key, text_of(scene.points));
  } catch (const std::exception& error) {
    spdlog::debug("the scene's points are not kept: {}", error.what());
  }
  return scene;
}

}  // namespace skein::sim
