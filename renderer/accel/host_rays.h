/// @file host_rays.h
/// Rays of a mapped queue, spread over the processors.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/accel/denormals.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// Calls `function(first, count, rays)` for runs of a queue's rays, on many threads.
template <class Function> void forRays(const TraceQueue& queue, const Function& function) {
    constexpr uint32_t RaysPerTask = 256;
    const auto& header =
        *reinterpret_cast<const gpu::QueueHeader*>(queue.header->mapped<char>() + queue.headerOffset);
    const auto* rays = queue.rays->mapped<gpu::Ray>();
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, header.count, RaysPerTask), [&](const auto& range) {
        const FlushDenormals flush;
        function(range.begin(), range.end() - range.begin(), rays + range.begin());
    });
}

} // namespace hipr
