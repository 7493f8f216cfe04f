/// @file graph_program.h
/// MaterialGraph -> the steps kernels run.
#pragma once

#include <vector>

#include "renderer/api/graph.h"
#include "shaders/shared/graph.h"
#include "shaders/shared/material.h"

namespace hipr {

/// An input that a program sets.
struct ProgramTarget {
    uint32_t target;       ///< gpu::INPUT_*
    MaterialInput input;   ///< not a constant
    bool presence = false; ///< opacity needs it
};

/// A program without addresses.
struct GraphProgram {
    std::vector<gpu::GraphStep> steps;
    uint32_t presenceSteps = 0;       ///< the first of them, which set the targets that opacity needs
    std::vector<glm::vec4> constants; ///< operands number them from `firstConstant` on
    std::vector<MaterialInput> reads; ///< GRAPH_READ and its like name them by index
    std::vector<uint32_t> dropped;    ///< targets that would have needed more than GRAPH_REGISTERS
};

/// Puts the operations that the targets need in an order that keeps few values at a time.
GraphProgram compileGraph(const MaterialGraph& graph, std::vector<ProgramTarget> targets,
                          uint32_t firstConstant);

} // namespace hipr
