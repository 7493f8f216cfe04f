// The form of rasterisation that a kernel is compiled for.
#ifdef LANES
#include "higs/raster_lanes.glsl"
#else
#include "higs/raster_groups.glsl"
#endif
