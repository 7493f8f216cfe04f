/// @file instancer.h
/// HdHiprInstancer: where the instances of a prototype are, and their primvars. Geometry is never copied.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "plugin/hdHipr/compat.h"
#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/sampling.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprInstancer final : public hdhipr::InstancerBase {
public:
    using InstancerBase::InstancerBase;

    /// All instances of a prototype through all levels of nesting. Instance i of the outermost level and j of
    /// this one has index i * (instances of this level) + j: the flat index that Hydra's picking decodes.
    struct Instances {
        std::vector<GfMatrix4d> transforms;  ///< prototype space to world, Gf convention
        std::vector<hipr::Primvar> primvars; ///< one value per instance; inner levels win over outer ones
        /// What each instance may be linked by, of all levels; empty where no light is linked.
        std::vector<std::vector<std::string>> categories;
    };
    Instances instances(SdfPath const& prototypeId);

    /// What an instance primvar is of an instance's transform.
    enum class Part { Translate, Rotate, Scale, Transform };
    static std::optional<Part> partOf(TfToken const& primvar);
    /// Every outer instance with every inner one.
    static std::vector<GfMatrix4d> nested(std::vector<GfMatrix4d> const& inner,
                                          std::vector<GfMatrix4d> const& outer);

    /// Where this instancer, or one it is nested in, places instances while the shutter is open.
    struct Level {
        HdHiprInstancer const* instancer;
        VtIntArray indices;
        hdhipr::Samples<GfMatrix4d> own;
        std::map<TfToken, hdhipr::Samples<VtValue>> parts;
    };
    /// Samples of all levels, this one first.
    std::vector<Level> sampleLevels(SdfPath const& prototypeId, hdhipr::Sampling const& sampling);
    /// Transforms at a time, as Instances has them, of levels from `level` outwards.
    static std::vector<GfMatrix4d> transformsAt(std::vector<Level> const& levels, float time,
                                                size_t level = 0);

protected:
    void syncPrimvars(HdDirtyBits dirtyBits) override;

private:
    std::map<TfToken, hdhipr::Samples<VtValue>> sampleParts(hdhipr::Sampling const& sampling);
    std::map<TfToken, hdhipr::Samples<VtValue>> partsByVelocity(hdhipr::Sampling const& sampling);
    VtValue primvarAtFrame(TfToken const& name);
    std::vector<GfMatrix4d> localTransforms(VtIntArray const& indices, GfMatrix4d const& instancerTransform,
                                            std::map<TfToken, VtValue> const& primvars) const;
    std::vector<hipr::Primvar> localPrimvars(VtIntArray const& indices) const;
    std::vector<std::vector<std::string>> localCategories(VtIntArray const& indices) const;

    std::map<TfToken, VtValue> _primvars;
};

namespace hdhipr {

/// The collections of lights that an rprim and its instances are in.
class LinkState {
public:
    /// Reads the rprim's where DirtyCategories says so. Returns whether those of its instances have to be
    /// read, too.
    bool sync(HdSceneDelegate& delegate, SdfPath const& id, SdfPath const& instancerId, HdDirtyBits bits);
    std::vector<std::string> const& names() const { return _names; }

private:
    std::vector<std::string> _names;
    bool _instancesLinked = false;
};

/// The motion of an rprim with an own transform, and of its instances if there are any levels.
hipr::InstanceMotion instanceMotion(Samples<GfMatrix4d> const& own,
                                    std::vector<HdHiprInstancer::Level> const& levels);

/// Where an rprim stands: once, or as its instancer says. Without the instancer that it names it stands
/// nowhere, which is told.
/// With an open shutter also where it is at other times.
hipr::InstancesDesc readInstances(HdSceneDelegate& delegate, SdfPath const& id, SdfPath const& instancerId,
                                  Sampling const& sampling);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
