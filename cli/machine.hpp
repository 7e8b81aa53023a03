// The machine that this runs on, for reports.   Threads: any.
#pragma once

#include <string>

namespace skein::cli {

/// Of the first processor, as /proc/cpuinfo has it; empty where that does not tell.
std::string cpu_model();
/// Processors that this process may use.
int usable_cores();
/// Of the whole machine; 0 where nobody tells.
double memory_gb();

}  // namespace skein::cli
