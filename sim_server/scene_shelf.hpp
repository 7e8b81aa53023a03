// A scene that is loaded before anybody flies in it: processes that are copied (one_process/session.hpp) have it at
// hand.   Threads: one.
#pragma once

#include <optional>
#include <utility>

#include "core/scene.hpp"

namespace skein::sim {

class SceneShelf {
 public:
  void put(Scene scene) { scene_ = std::move(scene); }
  /// Once. @returns nullopt: there is none.
  std::optional<Scene> take() { return std::exchange(scene_, std::nullopt); }

 private:
  std::optional<Scene> scene_;
};

}  // namespace skein::sim
