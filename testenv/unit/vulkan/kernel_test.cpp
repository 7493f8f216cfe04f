#include <numeric>
#include <thread>

#include "hipr_vulkan_test_kernels.h"
#include "renderer/vulkan/background_kernels.h"
#include "testenv/unit/vulkan/fixture.h"

namespace hipr::test {
namespace {

using Kernels = DeviceTest;
INSTANTIATE_TEST_SUITE_P(, Kernels, ::testing::Bool(), memoryName);

struct ScalePush {
    VkDeviceAddress source, target;
    uint32_t count;
    float factor;
};

Kernel scaleKernel(Device& device) {
    return Kernel(device, spirv::scale_spv, spirv::scale_spv_size, sizeof(ScalePush), "scale");
}

struct Scale {
    static constexpr uint32_t Count = 1000;
    explicit Scale(Device& device) : device(device), values(Count) {
        std::iota(values.begin(), values.end(), 0.f);
        source = device.createFrom(values.data(), Count, "source");
        target = device.createBuffer(Count * 4, MemoryUse::Device, "target");
        push = {source.address(), target.address(), Count, 3.f};
    }
    void expectResult() {
        device.download(target, values.data(), Count * 4);
        for (uint32_t i = 0; i < Count; ++i)
            ASSERT_EQ(values[i], 4.f * float(i));
    }
    Device& device;
    std::vector<float> values;
    Buffer source, target;
    ScalePush push;
};

TEST_P(Kernels, Dispatch) {
    const Kernel kernel = scaleKernel(*device);
    Scale scale(*device);
    device->run([&](VkCommandBuffer cmd) { kernel.dispatch(cmd, &scale.push, 8, 2); });
    scale.expectResult();
}

TEST_P(Kernels, DispatchIndirect) {
    Kernel kernel = scaleKernel(*device);
    Kernel moved = std::move(kernel);
    Scale scale(*device);
    const uint32_t arguments[] = {0, 0, 0, 16, 1, 1};
    const Buffer buffer = device->createFrom(arguments, 6, "arguments");
    device->run([&](VkCommandBuffer cmd) { moved.dispatchIndirect(cmd, &scale.push, buffer, 12); });
    scale.expectResult();
}

TEST_P(Kernels, BarrierOrdersDispatches) {
    const Kernel kernel = scaleKernel(*device);
    Scale scale(*device);
    ScalePush again = scale.push;
    again.source = again.target;
    again.factor = 1.f;
    device->run([&](VkCommandBuffer cmd) {
        kernel.dispatch(cmd, &scale.push, 16);
        computeBarrier(cmd);
        kernel.dispatch(cmd, &again, 16);
    });
    device->download(scale.target, scale.values.data(), Scale::Count * 4);
    for (uint32_t i = 0; i < Scale::Count; ++i)
        ASSERT_EQ(scale.values[i], 5.f * float(i));
}

TEST_P(Kernels, WarmOnSeveralThreads) {
    std::vector<std::thread> threads;
    std::vector<Kernel> kernels(4);
    for (Kernel& k : kernels)
        threads.emplace_back([&] {
            k = scaleKernel(*device);
            k.warm();
        });
    for (std::thread& t : threads)
        t.join();
    for (const Kernel& k : kernels) {
        Scale scale(*device);
        device->run([&](VkCommandBuffer cmd) { k.dispatch(cmd, &scale.push, 16); });
        scale.expectResult();
    }
}

/// Before the scene exists there is nothing to bind.
TEST_P(Kernels, WarmWithoutAccelerationStructure) {
    if (!device->info().rayQuery) GTEST_SKIP() << "the device has no ray query";
    const Kernel kernel(*device, spirv::traceTlas_spv, spirv::traceTlas_spv_size, 8, "traceTlas", true);
    kernel.warm();
}

TEST_P(Kernels, TooManyPushConstantsAreRefusedByName) {
    try {
        const Kernel kernel(*device, spirv::scale_spv, spirv::scale_spv_size, 65536, "greedy");
        FAIL() << "accepted";
    } catch (const std::runtime_error& e) {
        EXPECT_THAT(e.what(), ::testing::HasSubstr("kernel greedy has 65536 bytes"));
    }
}

KernelSource scaleSource() {
    return {spirv::scale_spv, spirv::scale_spv_size, sizeof(ScalePush), "scale", false};
}

TEST_P(Kernels, SetCompilesInTheBackground) {
    for (const int patience : {0, 10000}) { // with help from other devices, and without
        BackgroundKernels set(*device, std::vector<KernelSource>(6, scaleSource()),
                              std::chrono::milliseconds(patience));
        set.wait();
        EXPECT_TRUE(set.ready(std::chrono::milliseconds(0)));
        for (size_t i = 0; i < 6; ++i) {
            Scale scale(*device);
            device->run([&](VkCommandBuffer cmd) { set.get(i).dispatch(cmd, &scale.push, 16); });
            scale.expectResult();
        }
    }
}

TEST_P(Kernels, SetMayGoBeforeItIsDone) {
    BackgroundKernels(*device, std::vector<KernelSource>(6, scaleSource()), std::chrono::milliseconds(0));
    BackgroundKernels(*device, {});
}

TEST_P(Kernels, SetReportsTheKernelThatFailed) {
    KernelSource greedy = scaleSource();
    greedy.pushBytes = 65536;
    greedy.name = "greedy";
    BackgroundKernels set(*device, {scaleSource(), greedy, scaleSource()});
    EXPECT_NO_THROW(set.get(0));
    EXPECT_THROW(set.get(1), std::runtime_error);
    EXPECT_NO_THROW(set.get(2));
    EXPECT_THROW(set.wait(), std::runtime_error);
}

} // namespace
} // namespace hipr::test
