/// @file volume.h
/// Volumes: media that fill a part of space with a density that changes from place to place.
///
/// What a volume is made of at a point x of the world, per world unit of length:
///
///     extinction  = density(x) * (look.absorption + look.scattering)
///     scattering  = density(x) * look.scattering * color(x)
///     emission    = look.emission * e(x) * b(x)                    radiance
///
/// density, color, e and b are fields, which may have lattices and transforms of their own. Without a color
/// field color is 1. e is the emission field where there is one; without it density if look.emissionByDensity
/// is set, 1 if there is a temperature field, else 0. b is what a black body sends at the temperature there,
///
///     b = 1e-6 * sigma * T^4 / pi * blackbodyColor(T),   T = look.temperatureScale * temperature(x) in
///     kelvin,
///
/// sigma being the constant of Stefan and Boltzmann (radiance in MW m^-2 sr^-1, as other renderers have it),
/// or 1 without a temperature field. Negative values of fields count as 0.
#pragma once

#include <memory>

#include "renderer/api/types.h"

namespace hipr {

/// Values on a regular lattice of points, stored where they are not 0: bricks of 8 x 8 x 8 cells, each with
/// the values at the 9 x 9 x 9 corners of its cells, so that interpolating in a cell needs one brick alone.
/// Between points values are interpolated trilinearly; outside of the bricks they are 0.
struct FieldGrid {
    static constexpr int Cells = 8, Points = Cells + 1;
    static constexpr size_t BrickPoints = size_t(Points) * Points * Points;
    static constexpr uint32_t NoBrick = std::numeric_limits<uint32_t>::max();

    std::string name;            ///< for messages: of the file and of the grid in it
    uint32_t channels = 1;       ///< 1 or 3
    glm::ivec3 first{0};         ///< the lattice point that is the first of brick (0, 0, 0)
    glm::uvec3 bricks{0};        ///< along each axis; 0: the field is 0 everywhere
    std::vector<uint32_t> index; ///< x fastest: the brick's place in `values`, or NoBrick
    std::vector<float> largest;  ///< of every entry of `index`: its largest value, of any channel
    std::vector<float>
        values; ///< brick by brick, point by point (x fastest), channel by channel; none below 0
    glm::dmat4x3 latticeToObject{1.0}; ///< from lattice points to the space that the volume is placed in

    size_t brickCount() const { return values.size() / (BrickPoints * channels); }
};

/// What a medium of density 1 does, and how it glows. See the top of this file.
struct VolumeLook {
    glm::vec3 absorption{0.2f}, scattering{0.8f}; ///< per world unit, not below 0
    float anisotropy = 0.f;  ///< mean cosine of Henyey and Greenstein's phase function, -1..1
    glm::vec3 emission{1.f}; ///< not below 0
    float temperatureScale = 1.f;
    bool emissionByDensity = false;
    bool operator==(const VolumeLook& o) const {
        return absorption == o.absorption && scattering == o.scattering && anisotropy == o.anisotropy &&
               emission == o.emission && temperatureScale == o.temperatureScale &&
               emissionByDensity == o.emissionByDensity;
    }
};

/// A volume: its fields, and how it looks. A material of its object that has a look
/// (SceneEdit::setVolumeLook) comes before the volume's own.
struct VolumeDesc {
    std::string name; ///< the prim path in a Hydra host; tells its random numbers from those of other volumes
    FieldId density = FieldId::None, emission = FieldId::None, temperature = FieldId::None,
            color = FieldId::None; ///< None, or one without a grid: as if there were no such field
    VolumeLook look;
    bool operator==(const VolumeDesc& o) const {
        return name == o.name && density == o.density && emission == o.emission &&
               temperature == o.temperature && color == o.color && look == o.look;
    }
};

} // namespace hipr
