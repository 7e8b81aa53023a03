// The only file that is compiled with -mavx2. It includes nothing that could leave an inline function behind which the
// linker might choose for other files too.
#include "sight/ray_fan_kernel.hpp"

namespace skein::sim::fan {

bool trace_tile_avx2(const Job& job, const Window& window) { return trace_tile(job, window); }

}  // namespace skein::sim::fan
