/// @file node_rows.h
/// Pattern nodes with inputs and the values they must have, computed by node_values.py in double precision.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/materialx/nodes.h"

namespace hipr::test {

struct NodeRow {
    std::string id;
    std::vector<std::pair<std::string, std::vector<float>>> inputs;
    std::vector<float> expected;
    std::string output = "out";
    std::pair<std::string, std::string> text{};
};

const std::vector<NodeRow>& nodeRows();

/// Numbers as an operand: one fills all four components, of several the missing ones are 0.
glm::vec4 operand(const std::vector<float>& numbers);

/// Makes a row's node; `input` makes the value of each input that the row has.
GraphValue emitNode(GraphBuilder& build, const NodeRow& row,
                    const std::function<GraphValue(const std::string&, const std::vector<float>&)>& input);

/// How far a value may be off: single precision, through noise and powers.
float allowance(float expected);

} // namespace hipr::test
