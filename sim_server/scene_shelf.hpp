// Holds a scene that was loaded in advance. A process that is then copied (one_process/session.hpp) hands it to each
// copy, which need not load it.   Threads: one.
#pragma once

#include <optional>
#include <utility>

#include "core/scenario/scene.hpp"

namespace skein::sim {

class SceneShelf {
 public:
  void put(Scene scene) { scene_ = std::move(scene); }
  /// @returns the scene, once; nullopt: there is none any more.
  std::optional<Scene> take() { return std::exchange(scene_, std::nullopt); }

 private:
  std::optional<Scene> scene_;
};

}  // namespace skein::sim
