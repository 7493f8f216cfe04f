#include <numeric>

#include "testenv/unit/vulkan/fixture.h"

namespace hipr::test {
namespace {

using DeviceTransfers = DeviceTest;
INSTANTIATE_TEST_SUITE_P(, DeviceTransfers, ::testing::Bool(), memoryName);

TEST_P(DeviceTransfers, DataReturnsAsItWent) {
    // More than the staging buffer holds, at an odd offset.
    std::vector<uint32_t> values((40u << 20) / 4), back(values.size());
    std::iota(values.begin(), values.end(), 17u);
    const uint64_t bytes = values.size() * 4, offset = 52;
    const Buffer buffer = device->createBuffer(bytes + offset, MemoryUse::Device, "data");
    device->upload(buffer, values.data(), bytes, offset);
    device->download(buffer, back.data(), bytes, offset);
    EXPECT_EQ(values, back);
}

TEST_P(DeviceTransfers, NothingIsAValidSize) {
    const Buffer buffer = device->createFrom<int>(nullptr, 0, "empty");
    EXPECT_TRUE(buffer);
    EXPECT_EQ(buffer.bytes(), 16u);
}

TEST_P(DeviceTransfers, AFailedRecordingLeavesTheDeviceUsable) {
    EXPECT_THROW(device->run([](VkCommandBuffer) { throw std::runtime_error("no"); }), std::runtime_error);
    const Buffer buffer = device->createBuffer(64, MemoryUse::Device, "data");
    device->run([&](VkCommandBuffer cmd) { vkCmdFillBuffer(cmd, buffer.handle(), 0, 64, 0x01020304); });
    uint32_t back[16] = {};
    device->download(buffer, back, sizeof back);
    EXPECT_THAT(back, ::testing::Each(0x01020304u));
}

/// The counter the other tests rely on has to count.
TEST(Validation, MistakesAreCountedAndReported) {
    Messages messages;
    const auto device = validatedDevice(messages);
    ASSERT_TRUE(device);
    const Buffer buffer = device->createBuffer(64, MemoryUse::Device, "data");
    device->run(
        [&](VkCommandBuffer cmd) { vkCmdFillBuffer(cmd, buffer.handle(), 0, 6, 0); }); // not a multiple of 4
    EXPECT_EQ(device->validationErrors(), 1u);
    ASSERT_EQ(messages.all().size(), 1u);
    EXPECT_EQ(messages.all()[0].severity, Severity::Error);
    EXPECT_THAT(messages.all()[0].text, ::testing::HasSubstr("vkCmdFillBuffer"));
}

TEST(Validation, IsOffByDefaultAndOnByEnvironment) {
    std::string error;
    for (const bool on : {false, true}) {
        const Environment environment("HIPR_VALIDATION", on ? "1" : "0");
        const auto device = Device::create({}, &error);
        ASSERT_TRUE(device) << error;
        EXPECT_EQ(device->validation(), on);
    }
}

TEST(Validation, AMissingLayerIsOneWarning) {
    const Environment path("VK_LAYER_PATH", "/nonexistent"), added("VK_ADD_LAYER_PATH", "/nonexistent");
    Messages messages;
    const auto device = validatedDevice(messages);
    ASSERT_TRUE(device);
    EXPECT_FALSE(device->validation());
    ASSERT_EQ(messages.all().size(), 1u);
    EXPECT_EQ(messages.all()[0].severity, Severity::Warning);
    EXPECT_THAT(messages.all()[0].text, ::testing::HasSubstr("not installed"));
}

TEST(Result, CodesBecomeExceptions) {
    EXPECT_NO_THROW(check(VK_SUCCESS, "x"));
    EXPECT_NO_THROW(check(VK_INCOMPLETE, "x"));
    EXPECT_THROW(check(VK_ERROR_DEVICE_LOST, "x"), DeviceLost);
    EXPECT_THROW(check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "x"), std::bad_alloc);
    EXPECT_STREQ(reasonOf(std::bad_alloc()), "out of memory");
    try {
        check(VK_ERROR_OUT_OF_HOST_MEMORY, "vkThing");
        FAIL();
    } catch (const std::bad_alloc& e) {
        EXPECT_STREQ(reasonOf(e),
                     "out of memory in the Vulkan driver (vkThing: VK_ERROR_OUT_OF_HOST_MEMORY)");
    }
    try {
        check(VK_ERROR_INITIALIZATION_FAILED, "vkThing");
        FAIL();
    } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "vkThing failed: VK_ERROR_INITIALIZATION_FAILED (-3)");
    }
}

} // namespace
} // namespace hipr::test
