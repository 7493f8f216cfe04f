/// @file automaton.h
/// Light path expressions as one table of states that a kernel walks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/lpe/expression.h"

namespace hipr {

/// A deterministic automaton for several expressions at once. State 0 is one that no path leaves and that
/// accepts nothing. Symbols are those of shaders/shared/lpe.h.
struct PathAutomaton {
    static constexpr size_t MostExpressions = 16, MostLabels = 16, MostStates = 256;

    std::vector<std::string> labels; ///< that lights' groups are told apart by
    uint32_t symbols = 0, start = 0; ///< `start`: at the camera
    std::vector<uint32_t> next;      ///< [state * symbols + symbol]
    std::vector<uint32_t> accepted;  ///< by state, a bit for each expression
    size_t states() const { return accepted.size(); }
};

/// The event that a symbol stands for. Light groups that are none of the labels have the last one, "".
PathEvent eventOf(uint32_t symbol, const std::vector<std::string>& labels);

/// Builds it. False if that takes more states or labels than there may be.
bool buildAutomaton(const std::vector<PathExpression>& expressions, PathAutomaton& automaton);

} // namespace hipr
