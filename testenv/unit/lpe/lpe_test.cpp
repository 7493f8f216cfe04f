// Light path expressions: the table of states against a matcher that tries everything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <random>

#include "renderer/lpe/automaton.h"
#include "shaders/shared/lpe.h"

using namespace hipr;

namespace {

const std::vector<std::string> Groups = {"key", "fill"};

/// What happens, as the test knows it.
struct Event {
    std::string types;
    char scattering;
    std::string label;
};

/// All events that are told apart, in the order of symbols for the labels `Groups`.
std::vector<Event> allEvents() {
    std::vector<Event> events = {
        {"C", 0, ""},       {"R", 'D', "diffuse"}, {"R", 'D', "sheen"},      {"R", 'S', "specular"},
        {"R", 'S', "coat"}, {"T", 'D', "diffuse"}, {"T", 'D', "subsurface"}, {"T", 'S', "transmission"},
        {"V", 0, ""}};
    for (const char* types : {"L", "LB", "O"})
        for (const std::string& group : {Groups[0], Groups[1], std::string()})
            events.push_back({types, 0, group});
    return events;
}

/// A random expression: its text, and the test's own way to say what it matches.
struct Random {
    enum Kind { Letter, Dot, Label, Full, Set, Sequence, Choice, Repeat } kind;
    bool negated = false;
    std::string letters, label;
    std::vector<Random> parts;
    unsigned least = 0, most = 1000;

    bool matches(const Event& e) const {
        const auto has = [&](char c) {
            const bool type = std::string("CRTVLBO").find(c) != std::string::npos;
            return type ? e.types.find(c) != std::string::npos : e.scattering == (c == 'G' ? 'S' : c);
        };
        switch (kind) {
        case Letter:
            return has(letters[0]);
        case Dot:
            return true;
        case Label:
            return e.label == label;
        case Full: { // <type scattering 'label'>, dots for anything
            bool fits = letters[0] == '.' || has(letters[0]);
            fits = fits && (letters[1] == '.' || has(letters[1]));
            return fits && (label.empty() || (e.label == label) != negated);
        }
        default: { // Set
            bool any = false;
            for (const Random& part : parts)
                any = any || part.matches(e);
            return any != negated;
        }
        }
    }
    std::string text() const {
        std::string inner;
        switch (kind) {
        case Letter:
            return letters;
        case Dot:
            return ".";
        case Label:
            return "'" + label + "'";
        case Full:
            inner = label.empty() ? "" : negated ? "[^'" + label + "']" : "'" + label + "'";
            return "<" + letters + inner + ">";
        case Set:
            for (const Random& part : parts)
                inner += part.text();
            return (negated ? "[^" : "[") + inner + "]";
        case Repeat:
            inner = "(" + parts[0].text() + ")";
            if (least == 0 && most == 1000) return inner + "*";
            if (least == 1 && most == 1000) return inner + "+";
            if (least == 0 && most == 1) return inner + "?";
            return inner + "{" + std::to_string(least) + "," + (most == 1000 ? "" : std::to_string(most)) +
                   "}";
        default:
            for (const Random& part : parts)
                inner += (inner.empty() ? "" : kind == Choice ? "|" : "") + part.text();
            return "(" + inner + ")";
        }
    }
};

/// Every place at which a match that begins at `from` may end.
std::vector<size_t> ends(const Random& r, const std::vector<Event>& path, size_t from) {
    std::vector<size_t> result;
    const auto add = [&](size_t end) {
        if (std::find(result.begin(), result.end(), end) == result.end()) result.push_back(end);
    };
    if (r.kind < Random::Sequence) {
        if (from < path.size() && r.matches(path[from])) add(from + 1);
    } else if (r.kind == Random::Choice) {
        for (const Random& part : r.parts)
            for (const size_t end : ends(part, path, from))
                add(end);
    } else {
        std::vector<size_t> reached{from};
        const bool repeat = r.kind == Random::Repeat;
        const size_t rounds = repeat ? std::min<size_t>(r.most, path.size() + r.least + 1) : r.parts.size();
        for (size_t i = 0; i <= rounds; ++i) {
            if (repeat ? i >= r.least : i == rounds)
                for (const size_t end : reached)
                    add(end);
            if (i == rounds) break;
            std::vector<size_t> next;
            for (const size_t at : reached)
                for (const size_t end : ends(r.parts[repeat ? 0 : i], path, at))
                    if (std::find(next.begin(), next.end(), end) == next.end()) next.push_back(end);
            reached = next;
        }
    }
    return result;
}

class Maker {
public:
    explicit Maker(unsigned seed) : _random(seed) {}
    unsigned below(unsigned n) { return unsigned(_random() % n); }

    Random atom() {
        Random r;
        const char* letters = "CRTVLBODGS";
        switch (below(8)) {
        case 0:
            return r.kind = Random::Dot, r;
        case 1:
            return r.kind = Random::Label, r.label = Groups[below(2)], r;
        case 2:
        case 3:
            r.kind = Random::Full;
            r.letters = {"CRTVLBO."[below(8)], "DGS."[below(4)]};
            if (below(2)) r.label = Groups[below(2)], r.negated = below(2);
            return r;
        case 4:
            r.kind = Random::Set;
            r.negated = below(2);
            for (unsigned i = 1 + below(3); i > 0; --i)
                r.parts.push_back(atom());
            for (const Random& part : r.parts)
                if (part.kind == Random::Set) return atom(); // sets are not nested
            return r;
        default:
            return r.kind = Random::Letter, r.letters = letters[below(10)], r;
        }
    }
    Random expression(unsigned depth) {
        Random r;
        if (depth == 0 || below(3) == 0) return atom();
        r.kind = std::array{Random::Sequence, Random::Choice, Random::Repeat}[below(3)];
        for (unsigned i = r.kind == Random::Repeat ? 1 : 1 + below(3); i > 0; --i)
            r.parts.push_back(expression(depth - 1));
        if (r.kind == Random::Repeat) {
            r.least = below(3);
            r.most = below(2) ? 1000 : r.least + below(3);
        }
        return r;
    }

private:
    std::mt19937 _random;
};

PathExpression parsed(const std::string& text) {
    PathExpression expression;
    std::string problem;
    EXPECT_TRUE(parsePathExpression(text, expression, problem)) << text << ": " << problem;
    return expression;
}

/// The expressions that a path from the camera along `symbols` is in, as bits.
uint32_t walk(const PathAutomaton& automaton, const std::vector<uint32_t>& symbols) {
    uint32_t state = automaton.start;
    for (const uint32_t symbol : symbols)
        state = automaton.next[state * automaton.symbols + symbol];
    return automaton.accepted[state];
}

bool in(const std::string& text, const std::vector<uint32_t>& symbols) {
    PathAutomaton automaton;
    EXPECT_TRUE(buildAutomaton({parsed(text)}, automaton)) << text;
    return walk(automaton, symbols) == 1;
}

std::string problemOf(const std::string& text) {
    PathExpression expression;
    std::string problem;
    EXPECT_FALSE(parsePathExpression(text, expression, problem)) << text;
    return problem;
}

constexpr uint32_t Light = gpu::LPE_LIGHTS, Dome = Light + 1, Object = Light + 2; // without labels

} // namespace

TEST(Lpe, EventsAreThoseOfTheTable) {
    const std::vector<Event> events = allEvents();
    for (uint32_t symbol = 0; symbol < events.size(); ++symbol) {
        const PathEvent event = eventOf(symbol, Groups);
        EXPECT_EQ(std::string(event.types).find_first_not_of(events[symbol].types), std::string::npos)
            << symbol;
        EXPECT_EQ(event.types.size(), events[symbol].types.size()) << symbol;
        EXPECT_EQ(event.scattering, events[symbol].scattering) << symbol;
        EXPECT_EQ(event.label, events[symbol].label) << symbol;
    }
}

TEST(Lpe, AgreesWithAMatcherThatTriesEverything) {
    const std::vector<Event> events = allEvents();
    Maker maker(7);
    int accepted = 0, built = 0;
    for (int round = 0; round < 1500; ++round) {
        // Three at a time, behind the camera, and one that names all labels so that symbols are those of
        // `events`.
        std::vector<Random> randoms;
        std::vector<PathExpression> expressions{parsed("C<L.'key'><L.'fill'>")};
        for (int i = 0; i < 3; ++i) {
            randoms.push_back(maker.expression(3));
            expressions.push_back(parsed("C" + randoms.back().text()));
        }
        PathAutomaton automaton;
        if (!buildAutomaton(expressions, automaton)) continue;
        ++built;
        ASSERT_EQ(automaton.labels, Groups);
        ASSERT_EQ(automaton.symbols, events.size());
        for (int path = 0; path < 60; ++path) {
            std::vector<uint32_t> symbols;
            std::vector<Event> happened;
            for (unsigned i = maker.below(6); i > 0; --i) {
                symbols.push_back(maker.below(uint32_t(events.size())));
                happened.push_back(events[symbols.back()]);
            }
            const uint32_t found = walk(automaton, symbols) >> 1;
            for (uint32_t i = 0; i < 3; ++i) {
                const bool expected =
                    testing::Matches(testing::Contains(happened.size()))(ends(randoms[i], happened, 0));
                ASSERT_EQ((found >> i & 1) != 0, expected) << randoms[i].text();
                accepted += expected;
            }
        }
    }
    EXPECT_GT(built, 1200);
    EXPECT_GT(accepted, 5000);
}

TEST(Lpe, CommonExpressionsMeanWhatTheyMeanElsewhere) {
    using namespace gpu;
    EXPECT_TRUE(in("C<RD>L", {LPE_DIFFUSE, Light}));
    EXPECT_TRUE(in("C<RD>L", {LPE_SHEEN, Dome})) << "a dome is a light";
    EXPECT_FALSE(in("C<RD>L", {LPE_DIFFUSE, LPE_DIFFUSE, Light}));
    EXPECT_FALSE(in("C<RD>L", {LPE_SPECULAR, Light}));
    EXPECT_TRUE(in("C<RD>[DSVOB].*", {LPE_DIFFUSE, LPE_COAT, Light}));
    EXPECT_TRUE(in("C<RS[^'coat''sheen']>.*", {LPE_SPECULAR, LPE_VOLUME, Object}));
    EXPECT_FALSE(in("C<RS[^'coat''sheen']>.*", {LPE_COAT, Light, 0}));
    EXPECT_TRUE(in("C<TD>.*", {LPE_SUBSURFACE, Dome}));
    EXPECT_TRUE(in("C[LO]", {Object}));
    EXPECT_TRUE(in("CB", {Dome}));
    EXPECT_FALSE(in("CB", {Light}));
    EXPECT_TRUE(in("CV.*", {LPE_VOLUME, Light}));
    EXPECT_TRUE(in("C <.D> [DS]* [<L.>O]", {LPE_DIFFUSE_THROUGH, LPE_TRANSMISSION, Object}));
    EXPECT_TRUE(in("C.*<L.'key'>", {LPE_DIFFUSE, Light}));
    EXPECT_FALSE(in("C.*<L.'key'>", {LPE_DIFFUSE, Light + 1})) << "without the group";
    EXPECT_TRUE(in("C<RG>.*", {LPE_SPECULAR, Light})) << "G and S mean the same";
    EXPECT_TRUE(in("CD{2,3}L", {LPE_DIFFUSE, LPE_SUBSURFACE, Light}));
    EXPECT_FALSE(in("CD{2,3}L", {LPE_DIFFUSE, Light}));
}

TEST(Lpe, TellsWhatIsWrong) {
    EXPECT_EQ(problemOf(""), "nothing to match at character 1");
    EXPECT_EQ(problemOf("C(D"), "a ')' is missing at character 4");
    EXPECT_EQ(problemOf("CX"), "an unknown 'X' at character 2");
    EXPECT_EQ(problemOf("C<RD"), "a label in quotes is missing at character 5");
    EXPECT_EQ(problemOf("C<L.'key>"), "a label without its second quote at character 6");
    EXPECT_EQ(problemOf("CD{3,2}L"), "a count that ends before it begins at character 8");
    EXPECT_EQ(problemOf("CD{99}L"), "a count above 32 at character 6");
    EXPECT_EQ(problemOf("CD)"), "a lone ')' at character 3");
    EXPECT_EQ(problemOf("C[DS"), "the end comes too soon at character 5");
    EXPECT_EQ(problemOf("unoccluded;C<RD>L"), "the prefix 'unoccluded;' is not supported");
}

TEST(Lpe, HasLimits) {
    std::vector<PathExpression> many(PathAutomaton::MostExpressions + 1, parsed("CL"));
    PathAutomaton automaton;
    EXPECT_FALSE(buildAutomaton(many, automaton));
    many.pop_back();
    EXPECT_TRUE(buildAutomaton(many, automaton));
    EXPECT_FALSE(buildAutomaton({parsed("C.*D.{20}L")}, automaton)) << "a million states";
    std::string labels = "C";
    for (int i = 0; i < 17; ++i)
        labels += "'" + std::to_string(i) + "'";
    EXPECT_FALSE(buildAutomaton({parsed(labels)}, automaton));
}

TEST(Lpe, StatesThatNoPathTellsApartAreOne) {
    PathAutomaton automaton;
    ASSERT_TRUE(buildAutomaton({parsed("C(D|S|D|[DS])L"), parsed("C[DS]L")}, automaton));
    EXPECT_EQ(automaton.states(), 4u) << "dead, at the camera, scattered, arrived";
    EXPECT_EQ(automaton.next[automaton.start * automaton.symbols + gpu::LPE_DIFFUSE],
              automaton.next[automaton.start * automaton.symbols + gpu::LPE_COAT]);
    for (uint32_t symbol = 0; symbol < automaton.symbols; ++symbol)
        EXPECT_EQ(automaton.next[symbol], 0u) << "nothing leaves state 0";
}
