#include "renderer/shading/alias.h"

namespace hipr {

std::vector<gpu::AliasEntry> buildAliasTable(const std::vector<double>& probabilities) {
    const size_t n = probabilities.size();
    std::vector<gpu::AliasEntry> table(n);
    std::vector<double> share(n);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < n; ++i) {
        share[i] = probabilities[i] * double(n);
        table[i] = {1.f, i};
        (share[i] < 1.0 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        table[poor] = {float(share[poor]), rich};
        share[rich] -= 1.0 - share[poor];
        if (share[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    return table; // what is left over is 1 up to rounding
}

} // namespace hipr
