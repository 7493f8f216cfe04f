/// @file expression.h
/// Light path expressions: regular expressions over what happens to a path on its way from the camera to a
/// light.
///
/// Source of the notation: Open Shading Language, "Light path expressions" (OSL wiki), with the sets inside
/// events, <RS[^'coat']> and [<L.>O], that Arnold and RenderMan write.
///
///   C                      the camera: every path begins with it
///   R, T, V                reflection, transmission, scattering in a volume
///   L, B, O                a light, a dome light (which is an L as well), a surface that emits
///   D, S or G              of R and T: diffuse or specular, of whatever roughness
///   'name'                 the group of an L, B or O; the lobe of an R or T: diffuse, sheen, specular, coat,
///                          subsurface, transmission
///   <TS'name'>             an event by its type, scattering and label, each a letter, a set or a dot; what
///   is left
///                          out may be anything
///   .  [..]  [^..]         any event, one of several, any but those
///   *  +  ?  {n}  {n,m}  {n,}  |  (..)
///
/// Passing straight through a cut-out, and a walk under a surface (one <TD'subsurface'>), are no further
/// events.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hipr {

/// One thing that happens to a path.
struct PathEvent {
    std::string_view types; ///< letters that stand for it
    char scattering = 0;    ///< 'D', 'S', or 0
    std::string_view label;
};

/// A place of an event: the letters or labels that fit.
template <class Item> struct PathItems {
    bool any = true, negated = false;
    std::vector<Item> items;
};

struct EventPattern {
    PathItems<char> type, scattering;
    std::vector<PathItems<std::string>> labels; ///< all have to fit
    bool matches(const PathEvent& event) const;
};

/// A node of a parsed expression.
struct PathExpression {
    enum class Kind { Event, Sequence, Choice, Repeat };
    static constexpr unsigned Unlimited = ~0u, LargestCount = 32;

    Kind kind = Kind::Sequence;
    bool negated = false; ///< Event: one that fits none of the patterns
    std::vector<EventPattern> patterns;
    std::vector<PathExpression> parts;
    unsigned least = 0, most = Unlimited; ///< Repeat: of the one part
    bool matches(const PathEvent& event) const;
};

/// Reads an expression. False, with the reason in `problem`, if it is none.
bool parsePathExpression(const std::string& text, PathExpression& expression, std::string& problem);

/// Adds the labels that an expression names.
void collectLabels(const PathExpression& expression, std::vector<std::string>& labels);

} // namespace hipr
