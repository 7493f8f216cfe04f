#include "renderer/geometry/cage.h"

#include <algorithm>
#include <cmath>

namespace hipr::geometry {

namespace {

const char* interpolationName(Interpolation interpolation) {
    switch (interpolation) {
    case Interpolation::Constant:
        return "constant";
    case Interpolation::Uniform:
        return "uniform";
    case Interpolation::Vertex:
        return "vertex";
    case Interpolation::FaceVarying:
        return "faceVarying";
    }
    return "unknown";
}

/// Elements of an interpolation's domain in authored numbering.
size_t elementCount(const MeshDesc& desc, Interpolation interpolation) {
    switch (interpolation) {
    case Interpolation::Constant:
        return 1;
    case Interpolation::Uniform:
        return desc.faceVertexCounts.size();
    case Interpolation::Vertex:
        return desc.points.size();
    case Interpolation::FaceVarying:
        return desc.faceVertexIndices.size();
    }
    return 0;
}

/// Judges one primvar of one mesh.
class PrimvarReader {
public:
    PrimvarReader(const MeshDesc& desc, const Primvar& primvar, const MessageSink& messages)
        : _desc(desc), _primvar(primvar), _messages(messages),
          _elements(elementCount(desc, primvar.interpolation)) {}

    /// True when `view` may be used.
    bool read(PrimvarView& view) {
        if (_primvar.components < 1 || _primvar.components > 4) {
            return drop(std::to_string(_primvar.components) + " components, 1 to 4 are supported");
        }
        _values = _primvar.values.size() / _primvar.components;
        if (!(_primvar.indices.empty() ? sizeFits(_values, "values") : indicesAreGood())) return false;
        view.name = _primvar.name;
        view.interpolation = _primvar.interpolation;
        view.components = _primvar.components;
        view.linear = _primvar.linear;
        view.values = _primvar.values.data();
        view.indices = _primvar.indices.empty() ? nullptr : _primvar.indices.data();
        repairValues(view);
        return true;
    }

private:
    bool drop(const std::string& reason) {
        say("dropped: " + reason);
        return false;
    }

    void say(const std::string& text) {
        warn(_messages, _desc.name, "primvar '" + _primvar.name + "' " + text);
    }

    bool sizeFits(size_t count, const char* what) {
        const std::string sizes = std::to_string(count) + " " + what + " for " + std::to_string(_elements) +
                                  " elements (" + interpolationName(_primvar.interpolation) + ")";
        if (count < _elements) return drop(sizes);
        if (count > _elements) say("truncated: " + sizes);
        return true;
    }

    bool indicesAreGood() {
        if (!sizeFits(_primvar.indices.size(), "indices")) return false;
        const size_t bad =
            size_t(std::count_if(_primvar.indices.begin(), _primvar.indices.begin() + long(_elements),
                                 [&](int i) { return i < 0 || size_t(i) >= _values; }));
        if (bad == 0) return true;
        return drop(std::to_string(bad) + " of " + std::to_string(_elements) + " indices outside its " +
                    std::to_string(_values) + " values");
    }

    /// A NaN in a primvar would blacken every pixel it reaches, so it becomes zero.
    void repairValues(PrimvarView& view) {
        const size_t used = (view.indices ? _values : _elements) * view.components;
        const auto isBad = [](float v) { return !std::isfinite(v); };
        const size_t bad = size_t(std::count_if(view.values, view.values + used, isBad));
        if (bad == 0) return;
        say("has " + std::to_string(bad) + " NaN or infinite numbers, replaced by 0");
        view.repaired.assign(view.values, view.values + used);
        std::replace_if(view.repaired.begin(), view.repaired.end(), isBad, 0.f);
        view.values = view.repaired.data();
    }

    const MeshDesc& _desc;
    const Primvar& _primvar;
    const MessageSink& _messages;
    const size_t _elements;
    size_t _values = 0;
};

} // namespace

std::vector<PrimvarView> validatePrimvars(const MeshDesc& desc, const MessageSink& messages) {
    std::vector<PrimvarView> views;
    views.reserve(desc.primvars.size());
    for (const Primvar& primvar : desc.primvars) {
        const auto sameName = [&](const PrimvarView& view) { return view.name == primvar.name; };
        if (std::any_of(views.begin(), views.end(), sameName)) {
            warn(messages, desc.name, "primvar '" + primvar.name + "' is given twice; the first is used");
            continue;
        }
        PrimvarView view;
        if (PrimvarReader(desc, primvar, messages).read(view)) views.push_back(std::move(view));
    }
    return views;
}

} // namespace hipr::geometry
