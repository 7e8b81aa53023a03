// Facts about the machine that this process runs on, for reports.   Threads: any.
#pragma once

#include <string>

namespace skein::cli {

/// Model name of the first processor, from /proc/cpuinfo; empty if there is none.
std::string cpu_model();
/// Number of processors that this process may use.
int usable_cores();
/// Memory of the whole machine [GB, 1e9 bytes]; 0 if it is unknown.
double memory_gb();

}  // namespace skein::cli
