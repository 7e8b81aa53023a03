// `skein doctor`: what of this machine or network is in a fleet's way.
#pragma once

#include "cli/options.hpp"

namespace skein::cli {

/// skein_doctor, which looks and prints. It gets the user's own environment, for it judges that too.
/// @returns its exit code: kExitDone, kExitCheckFailed, or kExitBadInput after it has said what is wrong.
int consult_doctor(const DoctorOptions& options);

}  // namespace skein::cli
