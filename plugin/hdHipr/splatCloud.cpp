#include "plugin/hdHipr/splatCloud.h"

#include <set>

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"
#include "pxr/base/gf/half.h"
#include "pxr/base/gf/quatd.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "renderer/splats/tidy.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

constexpr int mostDegree = 3;
constexpr int defaultDegree = 3; ///< the schema's

std::vector<float> toFloats(VtValue const& value) {
    std::vector<float> out;
    const auto convert = [](auto number) { return float(number); };
    appendArray<float>(value, out, convert) || appendArray<GfHalf>(value, out, convert) ||
        appendArray<double>(value, out, convert);
    return out;
}

std::vector<glm::quat> toQuaternions(VtValue const& value) {
    std::vector<glm::quat> out;
    const auto convert = [](auto const& q) {
        auto const& v = q.GetImaginary();
        return glm::quat(float(q.GetReal()), float(v[0]), float(v[1]), float(v[2]));
    };
    appendArray<GfQuatf>(value, out, convert) || appendArray<GfQuath>(value, out, convert) ||
        appendArray<GfQuatd>(value, out, convert);
    return out;
}

/// One cloud's primvars.
class Reader {
public:
    Reader(std::string const& name, SplatValues const& values, hipr::SplatCloud& cloud)
        : _name(name), _values(values), _cloud(cloud) {}

    void read() {
        _cloud.name = _name;
        _cloud.positions = array(_tokens.positions, toVec3s);
        _cloud.orientations = fitted(_tokens.orientations, toQuaternions);
        _cloud.scales = fitted(_tokens.scales, toVec3s);
        _cloud.opacities = fitted(_tokens.opacities, toFloats);
        readCoefficients();
        readHints();
    }

private:
    void warn(TfToken const& name, std::string const& text) const {
        warnOnce(_name, "'" + name.GetString() + "' " + text);
    }

    template <class T> using Convert = std::vector<T> (*)(VtValue const&);

    template <class T> std::vector<T> array(TfToken const& name, Convert<T> convert) const {
        const VtValue value = _values(name);
        std::vector<T> result = convert(value);
        if (result.empty() && !value.IsEmpty() && !(value.IsArrayValued() && value.GetArraySize() == 0)) {
            warn(name, "is of type " + value.GetTypeName() + ", which is not understood; it is not used");
        }
        return result;
    }

    /// An array with `perSplat` values for each splat, or none.
    template <class T>
    std::vector<T> fitted(TfToken const& name, Convert<T> convert, size_t perSplat = 1) const {
        std::vector<T> values = array(name, convert);
        const size_t wanted = _cloud.size() * perSplat;
        if (values.size() != wanted && !values.empty()) {
            const bool enough = values.size() > wanted;
            warn(name, "has " + std::to_string(values.size()) + " values instead of " +
                           std::to_string(wanted) +
                           (enough ? "; the last ones are not used" : "; it is not used"));
            values.resize(enough ? wanted : 0);
        }
        return values;
    }

    void readCoefficients() {
        const VtValue value = VtValue::Cast<int>(_values(_tokens.degree));
        const int degree = value.IsHolding<int>() ? value.UncheckedGet<int>() : defaultDegree;
        if (degree < 0 || degree > mostDegree) {
            warn(_tokens.degree,
                 "is " + std::to_string(degree) + " instead of 0 to 3; the coefficients are not used");
            return;
        }
        _cloud.shDegree = uint32_t(degree);
        _cloud.coefficients = fitted(_tokens.coefficients, toVec3s, hipr::shCoefficients(uint32_t(degree)));
        if (_cloud.coefficients.empty()) {
            _cloud.shDegree = 0;
        }
    }

    TfToken hint(TfToken const& name) const {
        const VtValue value = _values(name);
        return value.IsHolding<TfToken>() ? value.UncheckedGet<TfToken>() : TfToken();
    }

    void readHints() {
        const TfToken sorting = hint(_tokens.sorting), projection = hint(_tokens.projection);
        if (sorting == "cameraDistance") {
            _cloud.sorting = hipr::SplatSorting::CameraDistance;
        } else if (sorting == "rayHitDistance") {
            _cloud.sorting = hipr::SplatSorting::RayHitDistance;
        }
        if (projection == "tangential") {
            _cloud.projection = hipr::SplatProjection::Tangential;
        }
    }

    std::string const& _name;
    SplatValues const& _values;
    hipr::SplatCloud& _cloud;
    const SplatTokens _tokens;
};

} // namespace

TfTokenVector const& splatPrimvarNames() {
    static const SplatTokens t;
    static const TfTokenVector names = {t.positions, t.orientations, t.scales,  t.opacities,
                                        t.degree,    t.coefficients, t.sorting, t.projection};
    return names;
}

std::shared_ptr<const hipr::SplatCloud> readSplatCloud(std::string const& name, SplatValues const& values) {
    const auto cloud = std::make_shared<hipr::SplatCloud>();
    Reader(name, values, *cloud).read();
    hipr::tidySplats(*cloud, report);
    return cloud;
}

std::shared_ptr<const hipr::SplatCloud> readSplatCloud(HdSceneDelegate& delegate, SdfPath const& id) {
    std::set<TfToken> listed;
    for (int i = 0; i < HdInterpolationCount; ++i) {
        for (HdPrimvarDescriptor const& primvar : delegate.GetPrimvarDescriptors(id, HdInterpolation(i))) {
            listed.insert(primvar.name);
        }
    }
    // Asking for what is not listed is an error in some hosts.
    return readSplatCloud(id.GetString(), [&](TfToken const& name) {
        return listed.count(name) > 0 ? delegate.Get(id, name) : VtValue();
    });
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
