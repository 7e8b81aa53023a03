// A library to be preloaded: whoever asks for the time of the wall clock gets another one. For skein check-planner.
#pragma once

namespace skein {

/// Beside the programs.
inline constexpr const char* kOtherClockLibrary = "libskein_other_clock.so";
/// Seconds to add.
inline constexpr const char* kOtherClockVariable = "SKEIN_OTHER_CLOCK_S";

}  // namespace skein
