#include "testenv/unit/materialx/node_rows.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hipr::test {

const std::vector<NodeRow>& nodeRows() {
    static const std::vector<NodeRow> rows = {
#include "testenv/unit/materialx/node_values.inl"
    };
    return rows;
}

glm::vec4 operand(const std::vector<float>& numbers) {
    if (numbers.size() == 1) return glm::vec4(numbers[0]);
    glm::vec4 value(0.f);
    for (size_t i = 0; i < numbers.size(); ++i)
        value[int(i)] = numbers[i];
    return value;
}

GraphValue emitNode(GraphBuilder& build, const NodeRow& row,
                    const std::function<GraphValue(const std::string&, const std::vector<float>&)>& input) {
    std::string type;
    const MtlxNode* node = findMtlxNode(row.id, type);
    if (!node) throw std::runtime_error("unknown node " + row.id);
    MtlxCall call{build, type, row.output, {}, {}, {}, {}};
    call.text = [&](const char* name) { return row.text.first == name ? row.text.second : std::string(); };
    call.complain = [](const std::string& text) { throw std::runtime_error(text); };
    for (const auto& given : row.inputs)
        if (std::none_of(node->inputs.begin(), node->inputs.end(),
                         [&](const MtlxInput& i) { return given.first == i.name; }))
            throw std::runtime_error(row.id + " has no input " + given.first);
    for (const MtlxInput& in : node->inputs) {
        const auto given = std::find_if(row.inputs.begin(), row.inputs.end(),
                                        [&](const auto& value) { return value.first == in.name; });
        call.given.push_back(given != row.inputs.end());
        if (call.given.back())
            call.in.push_back(input(given->first, given->second));
        else
            call.in.push_back(in.geometry == MtlxGeometry::None ? GraphValue(in.value)
                                                                : mtlxGeometry(build, in.geometry));
    }
    return node->emit(call);
}

float allowance(float expected) {
    return 2e-5f + 1e-4f * std::abs(expected);
}

} // namespace hipr::test
