#include "renderer/lpe/expression.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace hipr {
namespace {

constexpr const char *TypeLetters = "CRTVLBO", *ScatteringLetters = "DGSs";
constexpr size_t LongestExpression = 1000;

bool isOneOf(char c, const char* letters) {
    return c != '\0' && std::strchr(letters, c);
}

/// What is wrong with an expression.
struct Problem {
    std::string text;
};

class Parser {
public:
    explicit Parser(const std::string& text) : _text(text) {}

    PathExpression parse() {
        if (_text.size() > LongestExpression) throw Problem{"the expression is too long"};
        const size_t prefix = _text.find(';');
        if (prefix != std::string::npos)
            throw Problem{"the prefix '" + _text.substr(0, prefix + 1) + "' is not supported"};
        PathExpression expression = choice();
        if (peek() != '\0') fail("a lone '" + std::string(1, peek()) + "'");
        return expression;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Problem{what + " at character " + std::to_string(_at + 1)};
    }
    char peek() {
        while (_at < _text.size() && std::isspace(static_cast<unsigned char>(_text[_at])))
            ++_at;
        return _at < _text.size() ? _text[_at] : '\0';
    }
    bool take(char c) {
        const bool found = peek() == c;
        _at += found;
        return found;
    }
    void expect(char c) {
        if (!take(c)) fail(std::string("a '") + c + "' is missing");
    }

    PathExpression choice();
    PathExpression sequence();
    PathExpression repeated();
    PathExpression atom();
    PathExpression bracket();
    EventPattern simplePattern();
    EventPattern pattern();
    EventPattern event();
    unsigned count();
    void counts(PathExpression& repeat);
    std::string label();
    char letter(const char* letters);
    template <class Item, class Read> PathItems<Item> items(Read read);

    const std::string& _text;
    size_t _at = 0;
    unsigned _depth = 0;
};

PathExpression Parser::choice() {
    if (++_depth > 50) fail("too many brackets");
    PathExpression result;
    result.kind = PathExpression::Kind::Choice;
    do
        result.parts.push_back(sequence());
    while (take('|'));
    --_depth;
    return result;
}

PathExpression Parser::sequence() {
    PathExpression result;
    for (char c = peek(); c != '\0' && c != '|' && c != ')'; c = peek())
        result.parts.push_back(repeated());
    if (result.parts.empty()) fail("nothing to match");
    return result;
}

PathExpression Parser::repeated() {
    PathExpression part = atom();
    while (isOneOf(peek(), "*+?{")) {
        PathExpression repeat;
        repeat.kind = PathExpression::Kind::Repeat;
        counts(repeat);
        repeat.parts.push_back(std::move(part));
        part = std::move(repeat);
    }
    return part;
}

void Parser::counts(PathExpression& repeat) {
    if (take('*')) return;
    if (take('+')) {
        repeat.least = 1;
    } else if (take('?')) {
        repeat.most = 1;
    } else {
        expect('{');
        repeat.least = repeat.most = count();
        if (take(',')) repeat.most = peek() == '}' ? PathExpression::Unlimited : count();
        expect('}');
        if (repeat.most < repeat.least) fail("a count that ends before it begins");
    }
}

unsigned Parser::count() {
    if (!std::isdigit(static_cast<unsigned char>(peek()))) fail("a count is missing");
    unsigned value = 0;
    while (_at < _text.size() && std::isdigit(static_cast<unsigned char>(_text[_at]))) {
        value = 10 * value + unsigned(_text[_at++] - '0');
        if (value > PathExpression::LargestCount)
            fail("a count above " + std::to_string(PathExpression::LargestCount));
    }
    return value;
}

PathExpression Parser::atom() {
    if (take('(')) {
        PathExpression inner = choice();
        expect(')');
        return inner;
    }
    if (take('[')) return bracket();
    PathExpression one;
    one.kind = PathExpression::Kind::Event;
    one.patterns.push_back(pattern());
    return one;
}

PathExpression Parser::bracket() {
    PathExpression set;
    set.kind = PathExpression::Kind::Event;
    set.negated = take('^');
    while (!take(']'))
        set.patterns.push_back(pattern());
    return set;
}

EventPattern Parser::pattern() {
    return take('<') ? event() : simplePattern();
}

/// A letter or a label by itself, or a dot.
EventPattern Parser::simplePattern() {
    EventPattern pattern;
    const char c = peek();
    if (take('.')) return pattern;
    if (c == '\'' || c == '"') {
        pattern.labels.push_back({false, false, {label()}});
        return pattern;
    }
    const bool type = isOneOf(c, TypeLetters);
    if (!type && !isOneOf(c, ScatteringLetters))
        fail(c == '\0' ? "the end comes too soon" : "an unknown '" + std::string(1, c) + "'");
    (type ? pattern.type : pattern.scattering) = {false, false, {c}};
    ++_at;
    return pattern;
}

EventPattern Parser::event() {
    EventPattern pattern;
    pattern.type = items<char>([this] { return letter(TypeLetters); });
    if (peek() != '>') pattern.scattering = items<char>([this] { return letter(ScatteringLetters); });
    while (!take('>'))
        pattern.labels.push_back(items<std::string>([this] { return label(); }));
    return pattern;
}

template <class Item, class Read> PathItems<Item> Parser::items(Read read) {
    if (take('.')) return {};
    PathItems<Item> result{false, false, {}};
    if (!take('[')) return {false, false, {read()}};
    result.negated = take('^');
    while (!take(']'))
        result.items.push_back(read());
    return result;
}

char Parser::letter(const char* letters) {
    const char c = peek();
    if (!isOneOf(c, letters)) fail(std::string("one of ") + letters + " is missing");
    ++_at;
    return c;
}

std::string Parser::label() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a label in quotes is missing");
    const size_t end = _text.find(quote, ++_at);
    if (end == std::string::npos) fail("a label without its second quote");
    const std::string name = _text.substr(_at, end - _at);
    _at = end + 1;
    return name;
}

template <class Item, class Fits> bool fits(const PathItems<Item>& place, Fits one) {
    return place.any || std::any_of(place.items.begin(), place.items.end(), one) != place.negated;
}

} // namespace

bool EventPattern::matches(const PathEvent& event) const {
    const auto hasType = [&](char c) { return event.types.find(c) != std::string_view::npos; };
    const auto scatters = [&](char c) { return event.scattering == (c == 'G' ? 'S' : c); };
    return fits(type, hasType) && fits(scattering, scatters) &&
           std::all_of(labels.begin(), labels.end(), [&](const PathItems<std::string>& place) {
               return fits(place, [&](const std::string& name) { return event.label == name; });
           });
}

bool PathExpression::matches(const PathEvent& event) const {
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const EventPattern& pattern) { return pattern.matches(event); }) != negated;
}

bool parsePathExpression(const std::string& text, PathExpression& expression, std::string& problem) {
    try {
        expression = Parser(text).parse();
        return true;
    } catch (const Problem& caught) {
        problem = caught.text;
        return false;
    }
}

void collectLabels(const PathExpression& expression, std::vector<std::string>& labels) {
    for (const PathExpression& part : expression.parts)
        collectLabels(part, labels);
    for (const EventPattern& pattern : expression.patterns)
        for (const PathItems<std::string>& place : pattern.labels)
            for (const std::string& name : place.items)
                if (std::find(labels.begin(), labels.end(), name) == labels.end()) labels.push_back(name);
}

} // namespace hipr
