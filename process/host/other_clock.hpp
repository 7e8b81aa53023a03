// A library for LD_PRELOAD that shifts the wall clock of a process, for skein check-planner.
#pragma once

namespace skein {

/// File name of the library, in the same folder as the programs.
inline constexpr const char* kOtherClockLibrary = "libskein_other_clock.so";
/// Environment variable: seconds to add to the wall clock.
inline constexpr const char* kOtherClockVariable = "SKEIN_OTHER_CLOCK_S";

}  // namespace skein
