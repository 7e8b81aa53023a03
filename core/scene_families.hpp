// The families of procedural scenes that a scenario may name. sim_server/scenes/ builds them, one file a family.
#pragma once

#include <array>

namespace skein {

struct SceneFamily {
  const char* name;
  const char* description;
};

inline constexpr std::array kSceneFamilies = {
    SceneFamily{"towers", "three towers under a roof deck, in the manner of the benchmark's MBS"},
};

}  // namespace skein
