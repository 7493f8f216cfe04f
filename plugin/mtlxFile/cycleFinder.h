/// @file cycleFinder.h
/// Elements of a document that depend on themselves.
#pragma once

#include <functional>
#include <set>
#include <utility>
#include <vector>

#include <pugixml.hpp>

namespace hipr::mtlx {

/// Finds the connections that close a cycle, in depth first order.
class CycleFinder {
public:
    /// @param next  what an element depends on, each with what makes it so
    using Edges = std::function<std::vector<std::pair<pugi::xml_node, pugi::xml_node>>(pugi::xml_node)>;
    explicit CycleFinder(Edges next) : _next(std::move(next)) {}

    std::vector<pugi::xml_node> closing; ///< what makes an element depend on itself

    void visit(pugi::xml_node element) {
        begin(element);
        while (!_path.empty()) { // no recursion: chains may be longer than the stack
            Step& step = _path.back();
            if (step.done == step.edges.size()) {
                _open.erase(step.element);
                _path.pop_back();
                continue;
            }
            const auto [why, target] = step.edges[step.done++];
            if (_open.count(target)) {
                closing.push_back(why);
            } else {
                begin(target);
            }
        }
    }

private:
    struct Step {
        pugi::xml_node element;
        std::vector<std::pair<pugi::xml_node, pugi::xml_node>> edges;
        size_t done;
    };

    void begin(pugi::xml_node element) {
        if (_seen.insert(element).second) {
            _open.insert(element);
            _path.push_back({element, _next(element), 0});
        }
    }

    Edges _next;
    std::set<pugi::xml_node> _seen, _open;
    std::vector<Step> _path;
};

} // namespace hipr::mtlx
