// Every dialect of 3DGS .ply gives the cloud it was made from.
#include "splat_kit.h"

namespace hipr::test {
namespace {

const char* const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

TEST(Ply, EveryDegreeAndFormatIsRead) {
    for (const char* format : formats)
        for (uint32_t degree = 0; degree <= 3; ++degree) {
            SCOPED_TRACE(std::string(format) + ", degree " + std::to_string(degree));
            const SplatCloud cloud = randomCloud(50, degree);
            const SplatCloud read = readQuietly(plyFile(columnsOf(cloud), {format}));
            expectNear(read, cloud);
            EXPECT_EQ(read.name, "/cloud");
        }
}

TEST(Ply, PropertiesMayStandInAnyOrderAmongOthers) {
    const SplatCloud cloud = randomCloud(20, 3);
    std::mt19937 random(7);
    for (const char* format : formats) {
        SCOPED_TRACE(format);
        std::vector<Column> columns = columnsOf(cloud);
        const std::vector<double> values(cloud.size(), 1);
        for (const char* name :
             {"nx", "ny", "nz", "filter_3D", "f_rest_", "f_rest_1x", "f_rest_-1", "segment"})
            columns.push_back({name, "float", values});
        columns.push_back({"red", "uchar", values});
        columns.push_back({"label", "short", values});
        columns.push_back({"time", "double", values});
        std::shuffle(columns.begin(), columns.end(), random);
        expectNear(readQuietly(plyFile(columns, {format})), cloud);
    }
}

TEST(Ply, NumbersMayHaveAnyType) {
    const SplatCloud cloud = randomCloud(20, 1);
    for (const char* format : formats) {
        SCOPED_TRACE(format);
        std::vector<Column> columns = columnsOf(cloud);
        for (Column& column : columns)
            column.type = "double";
        const char* const integers[] = {"char", "uchar", "short", "ushort", "int", "uint"};
        for (size_t n = 0; n < 6; ++n) {
            Column& column = columnNamed(columns, "f_rest_" + std::to_string(n));
            column.type = integers[n];
            const double least = n % 2 == 0 ? -100 : 0;
            for (size_t i = 0; i < column.values.size(); ++i)
                column.values[i] = least + double(7 * i);
        }
        const SplatCloud read = readQuietly(plyFile(columns, {format}));
        EXPECT_EQ(read.positions, cloud.positions);
        for (size_t i = 0; i < cloud.size(); ++i)
            for (int n = 0; n < 6; ++n)
                EXPECT_EQ(double(read.coefficients[i * 4 + 1 + size_t(n) % 3][n / 3]),
                          columnNamed(columns, "f_rest_" + std::to_string(n)).values[i]);
    }
}

TEST(Ply, OtherElementsAndListsAreSkipped) {
    const SplatCloud cloud = randomCloud(3, 2);
    for (const char* format : formats) {
        SCOPED_TRACE(format);
        PlyStyle style{format};
        style.before = "element camera 2\nproperty double fov\nproperty uchar id\n"
                       "element nothing 1000000000000\n"
                       "element face 2\nproperty list uchar int indices\nproperty float area\n";
        for (const double camera : {1.0, 2.0})
            style.bodyBefore += encoded(camera, "double", format) + encoded(7, "uchar", format);
        for (const int corners : {3, 4}) {
            style.bodyBefore += encoded(corners, "uchar", format);
            for (int i = 0; i < corners; ++i)
                style.bodyBefore += encoded(i, "int", format);
            style.bodyBefore += encoded(0.5, "float", format);
        }
        style.listAfter = "f_dc_2";
        expectNear(readQuietly(plyFile(columnsOf(cloud), style)), cloud);
    }
}

TEST(Ply, LinesMayEndLikeThoseOfWindows) {
    const SplatCloud cloud = randomCloud(3, 0);
    for (const char* format : formats) {
        PlyStyle style{format};
        style.lineEnd = "\r\n";
        expectNear(readQuietly(plyFile(columnsOf(cloud), style)), cloud);
    }
}

TEST(Ply, TextMayHaveSignsExponentsAndNoLastNewline) {
    std::string file = plyFile(columnsOf(randomCloud(1, 0)), {"ascii"});
    file.erase(file.find("end_header\n") + 11);
    file += "+1.5 -2e1 3E-1\t0 0\n0 1e-400 0 0 0 1 0 0 0";
    const SplatCloud cloud = readQuietly(file);
    EXPECT_EQ(cloud.positions[0], glm::vec3(1.5f, -20.f, 0.3f));
    EXPECT_EQ(cloud.opacities[0], 0.5f);
    EXPECT_EQ(cloud.scales[0], glm::vec3(1.f));
}

TEST(Ply, OrientationsAreScalarFirstAndBecomeUnitLength) {
    std::vector<Column> columns = columnsOf(randomCloud(1, 0));
    const double parts[] = {2, 4, 6, 8};
    for (int i = 0; i < 4; ++i)
        columnNamed(columns, "rot_" + std::to_string(i)).values = {parts[i]};
    const glm::quat q = readQuietly(plyFile(columns)).orientations[0];
    EXPECT_NEAR(glm::length(q), 1.f, 1e-6f);
    EXPECT_NEAR(q.x / q.w, 2.f, 1e-6f);
    EXPECT_NEAR(q.y / q.w, 3.f, 1e-6f);
    EXPECT_NEAR(q.z / q.w, 4.f, 1e-6f);
}

TEST(Ply, SplatsThatAreNoNumbersAreLeftOutAndCounted) {
    const SplatCloud cloud = randomCloud(10, 1);
    std::vector<Column> columns = columnsOf(cloud);
    columnNamed(columns, "y").values[2] = NAN;
    columnNamed(columns, "f_rest_5").values[4] = INFINITY;
    columnNamed(columns, "scale_1").values[7] = 1e30; // its exponential is none
    for (const char* format : formats) {
        SCOPED_TRACE(format);
        Messages messages;
        const std::string file = plyFile(columns, {format});
        const SplatCloud read = readPly(view(file), messages.options());
        EXPECT_EQ(messages.texts,
                  std::vector<std::string>{"/cloud: 3 of 10 splats hold numbers that are not finite, "
                                           "or no orientation, and are left out"});
        ASSERT_EQ(read.size(), 7u);
        EXPECT_EQ(read.positions[2], cloud.positions[3]);
        EXPECT_EQ(read.coefficients[6 * 4 + 3], cloud.coefficients[9 * 4 + 3]);
    }
}

TEST(Ply, InfiniteLogitsAreOpacitiesOfOneAndZero) {
    std::vector<Column> columns = columnsOf(randomCloud(2, 0));
    columnNamed(columns, "opacity").values = {INFINITY, -INFINITY};
    EXPECT_EQ(readQuietly(plyFile(columns)).opacities, (std::vector<float>{1.f, 0.f}));
}

TEST(Ply, WhatIsWrittenIsRead) {
    for (uint32_t degree = 0; degree <= 3; ++degree) {
        SplatCloud cloud = randomCloud(5000, degree); // more than a block
        cloud.opacities[0] = 0.f;
        cloud.opacities[1] = 1.f;
        cloud.scales[2].x = 0.f;
        std::ostringstream file;
        writePly(cloud, file);
        SplatCloud read = readQuietly(file.str());
        EXPECT_EQ(read.opacities[0], 0.f);
        EXPECT_EQ(read.opacities[1], 1.f);
        EXPECT_LT(read.scales[2].x, 1e-37f);
        read.scales[2].x = cloud.scales[2].x = 1.f;
        expectNear(read, cloud);
    }
}

TEST(Ply, DefaultsAreWrittenOut) {
    SplatCloud cloud;
    cloud.positions = {{1, 2, 3}};
    std::ostringstream file;
    writePly(cloud, file);
    const SplatCloud read = readQuietly(file.str());
    EXPECT_EQ(read.opacities[0], 1.f);
    EXPECT_EQ(read.scales[0], glm::vec3(1.f));
    EXPECT_EQ(read.orientations[0], glm::quat(1.f, 0.f, 0.f, 0.f));
    EXPECT_EQ(read.coefficients[0], glm::vec3(0.f));
}

TEST(Ply, ProgressGoesFromNothingToAll) {
    const std::string file = plyFile(columnsOf(randomCloud(10000, 0)));
    Messages messages;
    SplatReadOptions options = messages.options();
    std::vector<double> told;
    options.progress = [&](double fraction) { told.push_back(fraction); };
    readPly(view(file), options);
    ASSERT_GE(told.size(), 5u);
    EXPECT_LT(told.front(), 0.25);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1.0);
}

} // namespace
} // namespace hipr::test
