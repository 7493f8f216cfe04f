/// @file motion.h
/// What Hydra samples of motion, made motion of the renderer. Samples are of the interval in which the
/// shutter of the camera is open that the host has named to its scene delegate; times are in frames from the
/// current one.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <glm/glm.hpp>

#include "plugin/hdHipr/messages.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/pxr.h"
#include "renderer/api/mesh.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Values by rising time. None, one, or all equal: nothing moves.
template <class Value> struct Samples {
    std::vector<float> times;
    std::vector<Value> values;

    bool moves() const {
        return std::any_of(values.begin(), values.end(), [&](Value const& v) { return !(v == values[0]); });
    }
};

/// Calls read(most, times, values), which says how many samples there are, until all fit.
template <class Value, class Read> Samples<Value> readSamples(Read const& read) {
    constexpr size_t few = 8;
    std::vector<float> times(few);
    std::vector<Value> values(few);
    size_t count = read(times.size(), times.data(), values.data());
    if (count > times.size()) {
        times.resize(count);
        values.resize(count);
        count = std::min(count, read(count, times.data(), values.data()));
    }
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return times[a] < times[b]; });
    Samples<Value> samples;
    for (const size_t i : order) {
        if (samples.times.empty() || times[i] > samples.times.back()) {
            samples.times.push_back(times[i]);
            samples.values.push_back(std::move(values[i]));
        }
    }
    return samples;
}

Samples<GfMatrix4d> sampleTransform(HdSceneDelegate& delegate, SdfPath const& id);
Samples<GfMatrix4d> sampleInstancerTransform(HdSceneDelegate& delegate, SdfPath const& instancer);
Samples<VtValue> samplePrimvar(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& name);

/// Of a computed primvar. None where neither Hydra (before 21.05) nor the host has any: a host may answer
/// when it is asked for samples of the primvar "hipr:computed:<name>", as hiprrecord does for skinned points.
Samples<VtValue> sampleComputed(HdSceneDelegate& delegate, SdfPath const& id,
                                HdExtComputationPrimvarDescriptor const& primvar);

/// Adds the times of samples that differ.
template <class Value> void addTimes(Samples<Value> const& samples, std::vector<float>& times) {
    if (!samples.moves()) {
        return;
    }
    times.insert(times.end(), samples.times.begin(), samples.times.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
}

/// What a value is at a time; before the first sample and behind the last it stays. Matrices and arrays of
/// vectors, quaternions and matrices lie between samples where these are as long, other values are those of
/// the sample before. There must be a sample.
GfMatrix4d at(Samples<GfMatrix4d> const& samples, float time);
VtValue at(Samples<VtValue> const& samples, float time);
/// The same for placements.
std::vector<glm::mat4x3> at(hipr::InstanceMotion const& motion, float time);

/// `mesh` as it deforms: `shapeOf(points)` makes it with sampled points, or null where these do not shape it.
/// `mesh` itself when nothing moves, or, with a message, when the shapes are not of one topology.
template <class ShapeOf>
std::shared_ptr<const hipr::TriangleMesh> deforming(SdfPath const& id,
                                                    std::shared_ptr<const hipr::TriangleMesh> const& mesh,
                                                    Samples<VtValue> const& points, ShapeOf const& shapeOf) {
    std::vector<hipr::MeshShape> shapes;
    for (size_t i = 0; i < points.times.size() && points.moves(); ++i) {
        shapes.emplace_back(points.times[i], shapeOf(points.values[i]));
        if (!shapes.back().second) {
            return mesh;
        }
    }
    if (shapes.empty()) {
        return mesh;
    }
    const auto moving = hipr::withMotion(*mesh, shapes);
    if (!moving) {
        warnOnce(id.GetString(), "its topology changes while the shutter is open; it does not deform");
    }
    return moving ? moving : mesh;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
