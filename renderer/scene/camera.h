/// @file camera.h
/// Camera matrices -> the record camera rays are made from.
#pragma once

#include <optional>

#include "renderer/api/scene.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// Works in double precision. Returns nothing when a matrix is not finite or the projection cannot be
/// inverted (a view of no width, near and far planes that coincide). A far plane at infinity and reversed
/// depth are fine.
std::optional<gpu::CameraRecord> cameraRecord(const CameraDesc& camera);

} // namespace hipr
