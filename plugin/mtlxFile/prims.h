/// @file prims.h
/// Prims and properties of a layer, in few words.
#pragma once

#include <string>
#include <vector>

#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/layer.h"
#include "pxr/usd/sdf/path.h"
#include "pxr/usd/sdf/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

class PrimWriter {
public:
    explicit PrimWriter(SdfLayerRefPtr const& layer) : _layer(layer) {}

    /// The path of a child whose name is made one that USD allows.
    static SdfPath child(SdfPath const& parent, std::string const& name);

    /// Whether there is a prim or a property at a path.
    bool has(SdfPath const& path) const { return bool(_layer->GetObjectAtPath(path)); }
    /// Makes a prim, in a parent that is there already; false if it is there too.
    bool define(SdfPath const& path, char const* type);
    /// Makes a prim that is defined by what it refers to.
    void over(SdfPath const& path);
    /// A reference to a prim of the same layer, weaker than those before.
    void reference(SdfPath const& path, SdfPath const& target);
    void apiSchema(SdfPath const& path, std::string const& schema);

    /// The attribute, which is made if it is not there.
    SdfAttributeSpecHandle attribute(SdfPath const& path, SdfValueTypeName const& type,
                                     SdfVariability variability = SdfVariabilityVarying);
    /// The same in finish(), if by then there is such a prim: for one that is still to be made.
    void attributeLater(SdfPath const& path, SdfValueTypeName const& type) {
        _later.emplace_back(path, type);
    }
    void uniform(SdfPath const& prim, char const* name, VtValue const& value);
    /// Connects an attribute that is there.
    void connect(SdfPath const& from, SdfPath const& to);
    /// Makes a relationship, which replaces weaker ones.
    void relate(SdfPath const& path, SdfPathVector const& targets);
    void finish();

    SdfLayerRefPtr const& layer() const { return _layer; }

private:
    SdfLayerRefPtr _layer;
    std::vector<std::pair<SdfPath, SdfValueTypeName>> _later;
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
