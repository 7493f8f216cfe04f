/// @file room.h
/// The scene every benchmark uses: a closed room with bumpy walls and balls, as one mesh of any number of
/// triangles.
#pragma once

#include "renderer/api/mesh.h"

namespace hipr::bench {

/// Half the edge of the room; it is centred on the origin.
constexpr float RoomHalf = 4.f;
/// Centre of the ceiling light that shadow rays aim at, and its radius. Below the bumps of the ceiling.
constexpr glm::vec3 LightCentre{0.f, 3.6f, 0.f};
constexpr float LightRadius = 1.f;
/// Where camera rays start, looking along -z.
constexpr glm::vec3 Eye{0.f, 0.f, 3.6f};

/// About `triangles` triangles, no two of them alike. The same for the same argument.
MeshDesc room(uint32_t triangles);

} // namespace hipr::bench
