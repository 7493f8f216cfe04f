/// @file cards.h
/// Models drawn as cards (UsdGeomModelAPI, `model:drawMode = "cards"`), as UsdImaging up to 22 hands them
/// over: a mesh of up to six quads, and a material that ends in a GLSL shader of Storm's.
#pragma once

#include "pxr/imaging/hd/material.h"
#include "pxr/pxr.h"
#include "renderer/api/mesh.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Whether a surface is Storm's shader for cards.
bool isCardShader(HdMaterialNode const& surface);

/// The network with a UsdPreviewSurface in place of Storm's shader: it shows on each card the picture (or
/// colour) of the side that the primvar `cardsTexAssign` names, and is not there where that is transparent.
HdMaterialNetwork cardNetwork(HdMaterialNetwork const& network, HdMaterialNode const& surface);

/// Whether a mesh is a model's cards. The two pictures of a card lie on one another: each is to be seen from
/// its side alone, also in mirrors.
bool isCards(hipr::MeshDesc const& mesh);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
