// `skein scene`: a scene as files in CARIC's layout.
#pragma once

#include "cli/options.hpp"

namespace skein::cli {

/// sim_server, which builds the scene, writes the files and says which.
/// @returns its exit code: kExitDone, or kExitBadInput after it has said what is wrong.
int export_scene(const SceneOptions& options);

}  // namespace skein::cli
