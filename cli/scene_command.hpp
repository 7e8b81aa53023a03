// `skein scene`: a scene as files in CARIC's layout.
#pragma once

#include "cli/options.hpp"

namespace skein::cli {

/// Runs sim_server, which builds the scene, writes the files and prints their names.
/// @returns its exit code: kExitDone, or kExitBadInput after it has printed what is wrong.
int export_scene(const SceneOptions& options);

}  // namespace skein::cli
