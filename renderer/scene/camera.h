/// @file camera.h
/// Camera matrices -> the record camera rays are made from.
#pragma once

#include <optional>
#include <vector>

#include "renderer/api/scene.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// Works in double precision. Returns nothing when a matrix is not finite or the projection cannot be
/// inverted (a view of no width, near and far planes that coincide). A far plane at infinity and reversed
/// depth are fine.
std::optional<gpu::CameraRecord> cameraRecord(const CameraDesc& camera);

/// The places of a camera that moves while `shutter` is open, as keys (shaders/shared/motion.h): each takes a
/// point relative to CameraRecord::origin to where it is in the world. Empty when it stands still.
std::vector<glm::mat4x3> cameraKeys(const CameraDesc& camera, const gpu::CameraRecord& record,
                                    const Shutter& shutter);

} // namespace hipr
