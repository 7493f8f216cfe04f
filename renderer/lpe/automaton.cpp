#include "renderer/lpe/automaton.h"

#include <algorithm>
#include <map>

#include "shaders/shared/lpe.h"

namespace hipr {
namespace {

/// Sets of symbols fit one word.
using SymbolSet = uint64_t;
static_assert(gpu::LPE_LIGHTS + gpu::LPE_LIGHT_KINDS * (PathAutomaton::MostLabels + 1) <= 64);

constexpr size_t MostNodes = 4096, MostUnmerged = 2048;

/// Thompson's construction: K. Thompson, "Regular Expression Search Algorithm", Comm. ACM 11(6), 1968.
class Network {
public:
    Network(uint32_t symbols, const std::vector<std::string>& labels) {
        for (uint32_t symbol = 0; symbol < symbols; ++symbol)
            _events.push_back(eventOf(symbol, labels));
    }

    struct Node {
        SymbolSet symbols = 0; ///< by which `to` is reached; 0: by none of them
        int to = -1;
        std::vector<int> free; ///< nodes that are reached without an event
    };
    const std::vector<Node>& nodes() const { return _nodes; }
    bool tooLarge() const { return _nodes.size() > MostNodes; }

    /// Adds what leads from a node through an expression; returns where it ends.
    int add(const PathExpression& expression, int from);
    int newNode() {
        _nodes.emplace_back();
        return int(_nodes.size()) - 1;
    }

private:
    void link(int from, int to) { _nodes[size_t(from)].free.push_back(to); }
    int addRepeat(const PathExpression& repeat, int from);

    std::vector<PathEvent> _events;
    std::vector<Node> _nodes;
};

int Network::add(const PathExpression& expression, int from) {
    if (tooLarge()) return from;
    if (expression.kind == PathExpression::Kind::Repeat) return addRepeat(expression, from);
    if (expression.kind == PathExpression::Kind::Sequence) {
        for (const PathExpression& part : expression.parts)
            from = add(part, from);
        return from;
    }
    const int end = newNode();
    if (expression.kind == PathExpression::Kind::Choice) {
        for (const PathExpression& part : expression.parts) {
            const int begin = newNode();
            link(from, begin);
            link(add(part, begin), end);
        }
        return end;
    }
    const int begin = newNode();
    link(from, begin);
    for (size_t symbol = 0; symbol < _events.size(); ++symbol)
        if (expression.matches(_events[symbol])) _nodes[size_t(begin)].symbols |= SymbolSet(1) << symbol;
    _nodes[size_t(begin)].to = end;
    return end;
}

int Network::addRepeat(const PathExpression& repeat, int from) {
    const PathExpression& part = repeat.parts.front();
    for (unsigned i = 0; i < repeat.least; ++i)
        from = add(part, from);
    const int end = newNode();
    link(from, end);
    if (repeat.most == PathExpression::Unlimited) {
        const int loop = newNode();
        link(from, loop);
        link(add(part, loop), loop);
        link(loop, end);
    }
    for (unsigned i = repeat.least; repeat.most != PathExpression::Unlimited && i < repeat.most; ++i) {
        from = add(part, from);
        link(from, end);
    }
    return end;
}

using NodeSet = std::vector<int>; ///< sorted

/// All nodes that are reached without an event.
NodeSet closure(const Network& network, NodeSet nodes) {
    std::vector<bool> seen(network.nodes().size());
    for (const int node : nodes)
        seen[size_t(node)] = true;
    for (size_t i = 0; i < nodes.size(); ++i)
        for (const int other : network.nodes()[size_t(nodes[i])].free)
            if (!seen[size_t(other)]) seen[size_t(other)] = true, nodes.push_back(other);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

NodeSet after(const Network& network, const NodeSet& nodes, uint32_t symbol) {
    NodeSet result;
    for (const int index : nodes) {
        const Network::Node& node = network.nodes()[size_t(index)];
        if (node.symbols >> symbol & 1 && std::find(result.begin(), result.end(), node.to) == result.end())
            result.push_back(node.to);
    }
    return closure(network, std::move(result));
}

/// Makes a state of every set of nodes that a path can be in. State 0 is the empty set.
bool spellOut(const Network& network, const NodeSet& start, const std::vector<int>& ends,
              PathAutomaton& automaton) {
    std::map<NodeSet, uint32_t> known{{{}, 0}};
    std::vector<NodeSet> sets{{}};
    const auto stateOf = [&](NodeSet set) {
        const auto [found, isNew] = known.try_emplace(std::move(set), uint32_t(sets.size()));
        if (isNew) sets.push_back(found->first);
        return found->second;
    };
    automaton.start = stateOf(start);
    for (size_t i = 0; i < sets.size(); ++i) {
        if (sets.size() > MostUnmerged) return false;
        const NodeSet set = sets[i];
        for (uint32_t symbol = 0; symbol < automaton.symbols; ++symbol)
            automaton.next.push_back(stateOf(after(network, set, symbol)));
        uint32_t accepted = 0;
        for (size_t e = 0; e < ends.size(); ++e)
            if (std::binary_search(set.begin(), set.end(), ends[e])) accepted |= 1u << e;
        automaton.accepted.push_back(accepted);
    }
    return true;
}

/// Merges states that no path tells apart: E. F. Moore, "Gedanken-experiments on Sequential Machines", 1956.
void merge(PathAutomaton& automaton) {
    std::vector<uint32_t> classes = automaton.accepted;
    for (size_t count = 0;;) {
        std::map<std::vector<uint32_t>, uint32_t> known;
        std::vector<uint32_t> refined;
        for (size_t state = 0; state < automaton.states(); ++state) {
            std::vector<uint32_t> key{classes[state]};
            for (uint32_t symbol = 0; symbol < automaton.symbols; ++symbol)
                key.push_back(classes[automaton.next[state * automaton.symbols + symbol]]);
            refined.push_back(known.try_emplace(std::move(key), uint32_t(known.size())).first->second);
        }
        classes = std::move(refined);
        if (known.size() == count) break;
        count = known.size();
    }
    PathAutomaton merged{automaton.labels, automaton.symbols, classes[automaton.start], {}, {}};
    for (size_t state = 0; state < automaton.states(); ++state) {
        if (classes[state] != merged.states()) continue; // classes are numbered as they are met; 0 stays
        merged.accepted.push_back(automaton.accepted[state]);
        for (uint32_t symbol = 0; symbol < automaton.symbols; ++symbol)
            merged.next.push_back(classes[automaton.next[state * automaton.symbols + symbol]]);
    }
    automaton = std::move(merged);
}

} // namespace

PathEvent eventOf(uint32_t symbol, const std::vector<std::string>& labels) {
    static const PathEvent scattered[gpu::LPE_LIGHTS] = {
        {"C", 0, ""},       {"R", 'D', "diffuse"}, {"R", 'D', "sheen"},      {"R", 'S', "specular"},
        {"R", 'S', "coat"}, {"T", 'D', "diffuse"}, {"T", 'D', "subsurface"}, {"T", 'S', "transmission"},
        {"V", 0, ""}};
    static const char* const kinds[gpu::LPE_LIGHT_KINDS] = {"L", "LB", "O"};
    if (symbol < gpu::LPE_LIGHTS) return scattered[symbol];
    const size_t light = symbol - gpu::LPE_LIGHTS, groups = labels.size() + 1, group = light % groups;
    return {kinds[light / groups], 0, group < labels.size() ? std::string_view(labels[group]) : ""};
}

bool buildAutomaton(const std::vector<PathExpression>& expressions, PathAutomaton& automaton) {
    automaton = {};
    for (const PathExpression& expression : expressions)
        collectLabels(expression, automaton.labels);
    if (expressions.size() > PathAutomaton::MostExpressions ||
        automaton.labels.size() > PathAutomaton::MostLabels)
        return false;
    automaton.symbols = gpu::LPE_LIGHTS + gpu::LPE_LIGHT_KINDS * uint32_t(automaton.labels.size() + 1);
    Network network(automaton.symbols, automaton.labels);
    NodeSet begins;
    std::vector<int> ends;
    for (const PathExpression& expression : expressions) {
        begins.push_back(network.newNode());
        ends.push_back(network.add(expression, begins.back()));
    }
    if (network.tooLarge()) return false;
    const NodeSet seen = after(network, closure(network, begins), gpu::LPE_CAMERA);
    if (!spellOut(network, seen, ends, automaton)) return false;
    merge(automaton);
    return automaton.states() <= PathAutomaton::MostStates;
}

} // namespace hipr
