#include "sight/ray_fan_kernel.hpp"

namespace skein::sim::fan {

bool trace_tile_sse2(const Job& job, const Window& window) { return trace_tile(job, window); }

}  // namespace skein::sim::fan
