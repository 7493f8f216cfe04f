#include "renderer/shading/graph_program.h"

#include <algorithm>
#include <set>

namespace hipr {

namespace {

constexpr uint32_t None = gpu::GRAPH_NOWHERE;

/// One step whose values are numbered in the order of steps, not yet in registers.
struct Step {
    const GraphNode* node;
    std::array<int, 3> operands{-1, -1, -1}; ///< steps; -1: the node's constant
    uint32_t target = None;
    int lastUse = -1;
};

/// Orders the nodes that targets need.
class Scheduler {
public:
    explicit Scheduler(const MaterialGraph& graph) : _graph(graph), _place(graph.nodes.size(), -1) {
        _need.reserve(graph.nodes.size());
        for (const GraphNode& node : graph.nodes)
            _need.push_back(need(node));
    }

    /// Adds what `node` needs, then the node; its value also goes to `target`.
    void require(uint32_t node, uint32_t target) {
        const int place = visit(node);
        if (_steps[place].target == None)
            _steps[place].target = target;
        else
            copy(place, target);
    }

    /// Adds a step that has no operands.
    void read(const GraphNode& node, uint32_t target) {
        Step step;
        step.node = &node;
        step.target = target;
        _steps.push_back(step);
    }

    std::vector<Step>& steps() { return _steps; }

private:
    /// How many values are kept while a node is computed from nothing, if none is shared (R. Sethi,
    /// J. D. Ullman, "The Generation of Optimal Code for Arithmetic Expressions", JACM 17(4), 1970).
    uint32_t need(const GraphNode& node) const {
        std::vector<uint32_t> needs;
        for (const GraphValue& operand : node.operands)
            if (!operand.isConstant()) needs.push_back(_need[operand.node]);
        std::sort(needs.rbegin(), needs.rend());
        uint32_t most = 1;
        for (size_t i = 0; i < needs.size(); ++i)
            most = std::max(most, needs[i] + uint32_t(i));
        return most;
    }

    int visit(uint32_t index) {
        if (_place[index] >= 0) return _place[index];
        const GraphNode& node = _graph.nodes[index];
        std::vector<uint32_t> order;
        for (const GraphValue& operand : node.operands)
            if (!operand.isConstant()) order.push_back(operand.node);
        std::stable_sort(order.begin(), order.end(),
                         [&](uint32_t a, uint32_t b) { return _need[a] > _need[b]; });
        for (const uint32_t operand : order)
            visit(operand);
        Step step;
        step.node = &node;
        const int place = int(_steps.size());
        for (size_t k = 0; k < 3; ++k)
            if (!node.operands[k].isConstant()) use(step, k, _place[node.operands[k].node], place);
        _steps.push_back(step);
        return _place[index] = place;
    }

    void copy(int from, uint32_t target) {
        static const GraphNode move{gpu::GRAPH_MOVE, 0, {}};
        Step step;
        step.node = &move;
        step.target = target;
        use(step, 0, from, int(_steps.size()));
        _steps.push_back(step);
    }

    void use(Step& step, size_t operand, int source, int at) {
        step.operands[operand] = source;
        _steps[source].lastUse = std::max(_steps[source].lastUse, at);
    }

    const MaterialGraph& _graph;
    std::vector<uint32_t> _need;
    std::vector<int> _place; ///< by node: its step
    std::vector<Step> _steps;
};

/// A register for each value that is used later; returns the step that finds none, or -1.
int allocate(const std::vector<Step>& steps, std::vector<uint32_t>& registers) {
    registers.assign(steps.size(), None);
    std::vector<uint32_t> free;
    for (uint32_t r = gpu::GRAPH_REGISTERS; r-- > 0;)
        free.push_back(r);
    for (size_t i = 0; i < steps.size(); ++i) {
        for (const int source : std::set<int>(steps[i].operands.begin(), steps[i].operands.end()))
            if (source >= 0 && steps[source].lastUse == int(i)) free.push_back(registers[source]);
        if (steps[i].lastUse < 0) continue;
        if (free.empty()) return int(i);
        registers[i] = free.back();
        free.pop_back();
    }
    return -1;
}

void encode(const std::vector<Step>& steps, const std::vector<uint32_t>& registers, uint32_t firstConstant,
            GraphProgram& out) {
    for (size_t i = 0; i < steps.size(); ++i) {
        const GraphNode& node = *steps[i].node;
        uint32_t operands[3] = {gpu::GRAPH_CONSTANT, gpu::GRAPH_CONSTANT,
                                gpu::GRAPH_CONSTANT}; // read, not used
        for (size_t k = 0; k < graphOperandCount(node.op); ++k) {
            operands[k] = gpu::GRAPH_CONSTANT + firstConstant + uint32_t(out.constants.size());
            if (steps[i].operands[k] < 0)
                out.constants.push_back(node.operands[k].constant);
            else
                operands[k] = registers[steps[i].operands[k]];
        }
        out.steps.push_back({node.op | registers[i] << 8 | steps[i].target << 16,
                             operands[0] | operands[1] << 16, operands[2], node.immediate});
    }
}

/// Textures that no step reads need no loading.
void keepUsedReads(GraphProgram& program) {
    constexpr uint32_t Unused = 0xffffffffu;
    std::vector<uint32_t> place(program.reads.size(), Unused);
    std::vector<MaterialInput> used;
    for (gpu::GraphStep& step : program.steps) {
        const uint32_t op = step.code & 0xffu;
        if (op < gpu::GRAPH_READ || op > gpu::GRAPH_TEXTURE) continue;
        if (place[step.immediate] == Unused) {
            place[step.immediate] = uint32_t(used.size());
            used.push_back(std::move(program.reads[step.immediate]));
        }
        step.immediate = place[step.immediate];
    }
    program.reads = std::move(used);
}

} // namespace

GraphProgram compileGraph(const MaterialGraph& graph, std::vector<ProgramTarget> targets,
                          uint32_t firstConstant) {
    std::stable_sort(targets.begin(), targets.end(), [](const ProgramTarget& a, const ProgramTarget& b) {
        return a.presence && !b.presence;
    });
    GraphProgram program;
    for (;;) {
        Scheduler scheduler(graph);
        program.reads = graph.reads;
        std::vector<GraphNode> direct(targets.size());
        std::vector<size_t> ends;
        for (size_t i = 0; i < targets.size(); ++i) {
            const ProgramTarget& target = targets[i];
            if (target.input.source == MaterialInput::Source::Graph) {
                scheduler.require(target.input.node, target.target);
            } else {
                direct[i] = {gpu::GRAPH_READ, uint32_t(program.reads.size()), {}};
                program.reads.push_back(target.input);
                scheduler.read(direct[i], target.target);
            }
            ends.push_back(scheduler.steps().size());
            if (target.presence) program.presenceSteps = uint32_t(ends.back());
        }
        std::vector<uint32_t> registers;
        const int full = allocate(scheduler.steps(), registers);
        if (full < 0) {
            encode(scheduler.steps(), registers, firstConstant, program);
            keepUsedReads(program);
            return program;
        }
        // The target whose steps found no register goes without.
        const size_t lost = size_t(std::upper_bound(ends.begin(), ends.end(), size_t(full)) - ends.begin());
        program.dropped.push_back(targets[lost].target);
        program.presenceSteps = 0;
        targets.erase(targets.begin() + ptrdiff_t(lost));
    }
}

} // namespace hipr
