// `skein doctor`: reports settings of this machine or network that would hinder a fleet.
#pragma once

#include "cli/options.hpp"

namespace skein::cli {

/// Runs the program skein_doctor, which checks and prints. It gets the user's own environment, because it checks that
/// too. @returns its exit code: kExitDone, kExitCheckFailed, or kExitBadInput after it has printed what is wrong.
int consult_doctor(const DoctorOptions& options);

}  // namespace skein::cli
