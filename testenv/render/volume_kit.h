/// @file volume_kit.h
/// Slabs of media seen straight on, for tests against closed forms.
#pragma once

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "renderer/volumes/field_builder.h"
#include "testenv/render/scene_kit.h"

namespace hipr::test {

using Values = std::function<float(glm::ivec3)>;

/// A field of values at the points lo..hi of a lattice with this spacing; 0 elsewhere.
inline std::shared_ptr<const FieldGrid> makeField(glm::ivec3 lo, glm::ivec3 hi, double spacing,
                                                  const Values& value) {
    FieldBuilder builder("field", 1, glm::dmat4x3(glm::scale(glm::dmat4(1), glm::dvec3(spacing))));
    const auto brickOf = [](int point) { return point >= 0 ? point / 8 : -((7 - point) / 8); };
    for (int z = brickOf(lo.z - 1); z <= brickOf(hi.z); ++z)
        for (int y = brickOf(lo.y - 1); y <= brickOf(hi.y); ++y)
            for (int x = brickOf(lo.x - 1); x <= brickOf(hi.x); ++x) {
                std::vector<float> values;
                for (int i = 0; i < int(FieldGrid::BrickPoints); ++i) {
                    const glm::ivec3 p = glm::ivec3(x, y, z) * 8 + glm::ivec3(i % 9, i / 9 % 9, i / 81);
                    const bool inside =
                        glm::all(glm::lessThanEqual(lo, p)) && glm::all(glm::lessThanEqual(p, hi));
                    values.push_back(inside ? value(p) : 0.f);
                }
                builder.add({x, y, z}, values);
            }
    return builder.finish();
}

/// Points -24..24 by x and y and 0..19 by z, a tenth apart: seen along z, its values integrate to a tenth of
/// their sum.
constexpr int Deep = 20;
constexpr double Spacing = 0.1;

inline std::shared_ptr<const FieldGrid> slab(const std::function<float(int)>& value) {
    return makeField({-24, -24, 0}, {24, 24, Deep - 1}, Spacing, [&](glm::ivec3 p) { return value(p.z); });
}
inline std::shared_ptr<const FieldGrid> slab(float value) {
    return slab([=](int) { return value; });
}

inline VolumeLook absorbing(glm::vec3 absorption) {
    VolumeLook look;
    look.absorption = absorption;
    look.scattering = glm::vec3(0.f);
    return look;
}
inline VolumeLook scattering(float extinction, float albedo, float anisotropy = 0.f) {
    VolumeLook look;
    look.scattering = glm::vec3(extinction * albedo);
    look.absorption = glm::vec3(extinction * (1.f - albedo));
    look.anisotropy = anisotropy;
    return look;
}

inline LightDesc sky(float radiance = 1.f) {
    LightDesc light;
    light.name = "/sky";
    light.kind = LightKind::Dome;
    light.intensity = radiance;
    return light;
}

inline Settings makeSettings(uint32_t samples, int depth = 1) {
    Settings settings;
    settings.samples = int(samples);
    settings.maxDepth = depth;
    settings.rouletteDepth = 64;
    return settings;
}

/// Volumes seen along -z from z = 10, so narrowly that all rays go straight.
class Box {
public:
    explicit Box(uint32_t samples = 256, int depth = 1)
        : stage(makeSettings(samples, depth)), samples(samples) {
        stage.edit.setCamera(lookAt({0.03, 0.02, 10}, {0.03, 0.02, 0}, 0.5));
        stage.film(Size, Size);
    }
    struct Fields {
        std::shared_ptr<const FieldGrid> density, emission = {}, temperature = {}, color = {};
    };
    ObjectId add(const Fields& fields, const VolumeLook& look,
                 std::vector<glm::mat4x3> transforms = {glm::mat4x3(1.f)}) {
        const uint32_t id = 10 * ++_volumes;
        VolumeDesc desc;
        desc.name = "/volume" + std::to_string(id);
        desc.look = look;
        uint32_t next = id;
        const auto set = [&](const std::shared_ptr<const FieldGrid>& grid, FieldId& field) {
            if (!grid) return;
            field = FieldId(next++);
            stage.edit.setField(field, grid);
        };
        set(fields.density, desc.density);
        set(fields.emission, desc.emission);
        set(fields.temperature, desc.temperature);
        set(fields.color, desc.color);
        stage.edit.setVolume(VolumeId(id), desc);
        ObjectDesc object;
        object.name = desc.name;
        object.volume = VolumeId(id);
        object.primId = int(id);
        stage.edit.setObject(ObjectId(1000 + id), object);
        stage.edit.setInstances(ObjectId(1000 + id), {std::move(transforms), {}, {}, {}});
        return ObjectId(1000 + id);
    }
    glm::vec4 shown() {
        stage.render();
        for (const Message& message : stage.messages())
            EXPECT_TRUE(message.severity == Severity::Info) << message.text;
        return mean(stage.color());
    }
    /// Three standard deviations of the mean of numbers that are 1 with this chance, else 0.
    float spread(float chance) const {
        return 3.f * std::sqrt(chance * (1.f - chance) / float(samples * Size * Size)) + 1e-5f;
    }

    static constexpr uint32_t Size = 8;
    Stage stage;
    const uint32_t samples;

private:
    uint32_t _volumes = 0;
};

/// The share that gets through the slab of these values.
inline float through(const std::function<float(int)>& value, float extinction) {
    double depth = 0.0;
    for (int i = 0; i < Deep; ++i)
        depth += Spacing * double(value(i));
    return float(std::exp(-depth * double(extinction)));
}

} // namespace hipr::test
