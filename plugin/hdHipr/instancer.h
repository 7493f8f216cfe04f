/// @file instancer.h
/// HdHiprInstancer: where the instances of a prototype are, and their primvars. Geometry is never copied.
#pragma once

#include <map>
#include <vector>

#include "plugin/hdHipr/compat.h"
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

    /// Whether an instance primvar of this name is part of the instances' transforms.
    static bool placesInstances(TfToken const& primvar);

protected:
    void syncPrimvars(HdDirtyBits dirtyBits) override;

private:
    std::vector<GfMatrix4d> localTransforms(VtIntArray const& indices,
                                            GfMatrix4d const& instancerTransform) const;
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

/// Where an rprim stands: once, or as its instancer says. Without the instancer that it names it stands
/// nowhere, which is told.
hipr::InstancesDesc readInstances(HdSceneDelegate& delegate, SdfPath const& id, SdfPath const& instancerId);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
