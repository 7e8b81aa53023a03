// The only file that is compiled with -mavx2. It must include no header with inline functions of external linkage: the
// linker might use the AVX2 version of such a function for other files, too.
#include "sight/ray_fan_kernel.hpp"

namespace skein::sim::fan {

bool trace_tile_avx2(const Job& job, const Window& window) { return trace_tile(job, window); }

}  // namespace skein::sim::fan
