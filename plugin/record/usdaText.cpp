#include "plugin/record/usdaText.h"

#include <cstddef>

namespace hipr::record {

namespace {

const char* const spaces = " \t\r\n";

struct Delimiters {
    const char *open, *close;
};
/// What may hold braces that are no blocks; the longer of two that begin alike comes first.
constexpr Delimiters opaque[] = {{"\"\"\"", "\"\"\""}, {"'''", "'''"}, {"\"", "\""}, {"'", "'"},
                                 {"@@@", "@@@"},       {"@", "@"},     {"<", ">"},   {"#", "\n"}};

/// Where the token that begins at `at` ends: behind a string, path or comment, else behind one character.
size_t tokenEnd(const std::string& text, size_t at) {
    for (const auto& [open, close] : opaque) {
        const std::string opening(open), closing(close);
        if (text.compare(at, opening.size(), opening) != 0) continue;
        const bool quoted = opening[0] == '"' || opening[0] == '\'';
        for (size_t i = at + opening.size(); i < text.size(); ++i) {
            if (quoted && text[i] == '\\')
                ++i;
            else if (text.compare(i, closing.size(), closing) == 0)
                return i + closing.size();
        }
        return text.size();
    }
    return at + 1;
}

bool endsItem(const std::string& text, size_t at) {
    const size_t next = text.find_first_not_of(spaces, at);
    return next == std::string::npos || (text[next] != ',' && text[next] != ';');
}

} // namespace

std::string completeUsda(const std::string& text) {
    const size_t start = text.find_first_not_of(spaces);
    if (start == std::string::npos) return "#usda 1.0\n";
    const bool hasHeader = text.compare(start, 5, "#usda") == 0;
    std::string result = hasHeader ? "" : "#usda 1.0\n";
    for (size_t at = start; at < text.size();) {
        const size_t end = tokenEnd(text, at);
        const bool closes = text[at] == '}';
        if (closes) result += '\n';
        result.append(text, at, end - at);
        if (closes && endsItem(text, end)) result += '\n';
        at = end;
    }
    return result + "\n";
}

} // namespace hipr::record
