#include "testenv/common/vdb_kit.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

namespace hipr::test {
namespace {

using Kind = VdbGrid::Kind;

openvdb::Coord coord(const glm::ivec3& p) {
    return {p.x, p.y, p.z};
}

/// The grid is made by OpenVDB's own factory: a constructor here would compile every virtual function of its
/// tree.
template <class Grid, class Convert> openvdb::GridBase::Ptr fill(const VdbGrid& from, Convert convert) {
    const openvdb::GridBase::Ptr made = openvdb::GridBase::createGrid(Grid::gridType());
    auto& tree = static_cast<Grid&>(*made).tree();
    for (int z = from.lo.z; z <= from.hi.z; ++z)
        for (int y = from.lo.y; y <= from.hi.y; ++y)
            for (int x = from.lo.x; x <= from.hi.x; ++x)
                tree.touchLeaf({x, y, z})->setValueOn({x, y, z}, convert(from.value({x, y, z})));
    return made;
}

openvdb::GridBase::Ptr fillAtOnce(const VdbGrid& from) {
    const openvdb::GridBase::Ptr made = openvdb::GridBase::createGrid(openvdb::FloatGrid::gridType());
    static_cast<openvdb::FloatGrid&>(*made).fill({coord(from.lo), coord(from.hi)},
                                                 float(from.value(from.lo)));
    return made;
}

template <class T> T number(double v) {
    return T(v);
}

openvdb::GridBase::Ptr make(const VdbGrid& from) {
    if (from.tile) return fillAtOnce(from);
    switch (from.kind) {
    case Kind::Double:
        return fill<openvdb::DoubleGrid>(from, number<double>);
    case Kind::Int:
        return fill<openvdb::Int32Grid>(from, number<int>);
    case Kind::Bool:
        return fill<openvdb::BoolGrid>(from, number<bool>);
    case Kind::Vec3:
        return fill<openvdb::Vec3SGrid>(from, [](double v) { return openvdb::Vec3s(v, 2 * v, 3 * v); });
    case Kind::Mask:
        return fill<openvdb::MaskGrid>(from, number<bool>);
    default:
        return fill<openvdb::FloatGrid>(from, number<float>);
    }
}

openvdb::math::Transform::Ptr transformOf(const VdbGrid& from) {
    if (from.kind == Kind::Frustum)
        return openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {8, 8, 8}), 0.5,
                                                                2.0);
    auto transform = openvdb::math::Transform::createLinearTransform();
    transform->preScale({from.spacing.x, from.spacing.y, from.spacing.z});
    transform->postRotate(glm::radians(from.degrees), openvdb::math::Y_AXIS);
    transform->postTranslate({from.offset.x, from.offset.y, from.offset.z});
    return transform;
}

} // namespace

void writeVdb(const std::string& path, const std::vector<VdbGrid>& grids) {
    openvdb::initialize();
    openvdb::GridPtrVec made;
    for (const VdbGrid& from : grids) {
        const openvdb::GridBase::Ptr grid = make(from);
        grid->setName(from.name);
        grid->setTransform(transformOf(from));
        grid->setSaveFloatAsHalf(from.kind == Kind::Half);
        grid->setGridClass(from.kind == Kind::LevelSet ? openvdb::GRID_LEVEL_SET : openvdb::GRID_FOG_VOLUME);
        made.push_back(grid);
    }
    openvdb::io::File(path).write(made);
}

std::vector<float> sampleVdb(const std::string& path, const std::vector<glm::dvec3>& points) {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open();
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(file.beginName().gridName()));
    const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*grid);
    std::vector<float> values;
    for (const glm::dvec3& p : points)
        values.push_back(sampler.wsSample({p.x, p.y, p.z}));
    return values;
}

} // namespace hipr::test
