/// @file splatAttributes.h
/// Which attributes of a ParticleField3DGaussianSplat prim count, and which other prims are as good as one.
#pragma once

#include <string>

#include "plugin/usdSplat/splatSchema.h"
#include "pxr/usd/usd/attribute.h"
#include "pxr/usd/usd/prim.h"

PXR_NAMESPACE_OPEN_SCOPE

/// The attribute that gives the primvar `name`: the one in single precision if it has a value, else the one
/// in half precision. Invalid when neither has one, and for other names.
UsdAttribute UsdSplatAttribute(UsdPrim const& prim, TfToken const& name);

/// Why the API schemas that a bare ParticleField prim applies do not make it a cloud of splats: "has ...", or
/// empty if they do. A cloud needs positions, the kernel of Gaussian ellipsoids and spherical harmonics.
std::string UsdSplatFieldFault(UsdPrim const& field);

/// Whether the prim's splats depend on this property.
bool UsdSplatIsProperty(TfToken const& property);

PXR_NAMESPACE_CLOSE_SCOPE
