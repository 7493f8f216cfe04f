#include <sstream>

#include "testenv/unit/delegate/dirty_bits.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const char* const preamble = R"(# What Hydra's dirty bits become

Every bit that the headers of OpenUSD 20.08's pxr/imaging/hd name, what the delegate reads again when it is marked,
and which elements of the changed set (`hipr::ChangedSet`, the input of HiPR's schedule) come of it. The page is made
from the table in testenv/unit/delegate/dirty_bits_*.cpp, and the test that compares the two (`test_dirty_bits`)
checks each row against a live delegate: it makes the edit and marks the bit; marks the bit again, with all values
equal, after which the changed set is empty and the picture goes on; and takes the edit back, which changes the same
where nothing else is said.

A bit says what to read, not what has changed: values are compared with those of the last commit. What was changed
last is in the render statistics `hipr:lastChange`, `hipr:changedElements` and `hipr:changes`.

Kinds: added, removed, transform, geometry (points or topology), primvar (any other data of a mesh, and ids), material
(binding or content), emission, visibility, camera, setting, linking (the collections of lights that it is in).
)";

const char* kindOf(Target target) {
    switch (target) {
    case Target::View:
        return "view";
    case Target::Lamp:
        return "light";
    case Target::Red:
        return "material";
    case Target::Added:
        return "new element";
    default:
        return "object";
    }
}

/// ", instances 1 and 2"; nothing for whole elements.
std::string instancesInWords(Elements const& elements) {
    if (elements[0].instance == hipr::ChangedElement::AllInstances) {
        return "";
    }
    std::string text = elements.size() > 1 ? ", instances " : ", instance ";
    for (size_t i = 0; i < elements.size(); ++i) {
        const char* separator = i == 0 ? "" : i + 1 == elements.size() ? " and " : ", ";
        text += separator + std::to_string(elements[i].instance);
    }
    return text;
}

/// "object, instances 1 and 2: transform" for elements of one kind of change.
std::string sameInWords(Elements const& elements) {
    const std::string kind = kindOf(elements[0].target), instances = instancesInWords(elements);
    const bool several = instances.empty() && elements.size() > 1;
    return (several ? std::to_string(elements.size()) + " " + kind + "s" : kind + instances) + ": " +
           hipr::toString(elements[0].change);
}

std::string inWords(Elements const& elements) {
    std::map<hipr::Change, Elements> byChange;
    for (Element const& element : elements) {
        byChange[element.change].push_back(element);
    }
    std::string text;
    for (auto const& [change, same] : byChange) {
        text += (text.empty() ? "" : "; ") + sameInWords(same);
    }
    return text.empty() ? "nothing" : text;
}

std::string code(const char* bit) {
    return *bit ? "`" + std::string(bit) + "`" : "a setting";
}

void write(std::ostream& out, Section const& section) {
    const bool bits = *section.rows.front().bit;
    out << "\n## " << section.title << "\n\n" << section.text << "\n\n";
    out << (bits ? "| Bit " : "") << "| " << (bits ? "Read again" : "What") << " | Edit | Becomes |\n";
    out << (bits ? "|---" : "") << "|---|---|---|\n";
    for (Row const& row : section.rows) {
        out << (bits ? "| " + code(row.bit) + " " : "") << "| " << row.reads << " | "
            << (*row.edit ? row.edit : "none") << " | " << inWords(row.made);
        if (row.undone && !(*row.undone == row.made)) {
            out << "; taken back: " << inWords(*row.undone);
        }
        out << " |\n";
    }
}

} // namespace

std::string page() {
    std::ostringstream out;
    out << preamble;
    for (Section const& section : allSections()) {
        write(out, section);
    }
    out << "\n## Types that the delegate does not take\n\n"
           "Hydra makes no such prims for it, so their bits never come.\n\n| Type | Bits |\n|---|---|\n";
    for (Absent const& absent : absentTypes()) {
        out << "| " << absent.type << " | ";
        for (size_t i = 0; i < absent.bits.size(); ++i) {
            out << (i ? ", " : "") << code(absent.bits[i]);
        }
        out << (absent.bits.empty() ? "those of openvdbAsset" : "") << " |\n";
    }
    return out.str();
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
