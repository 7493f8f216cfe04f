/// @file gpu.h
/// Runs test kernels on the first Vulkan device, with validation on. What is tested is the GLSL that ships.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/vulkan/device.h"
#include "renderer/vulkan/kernel.h"

namespace hipr::test {

/// Messages of the device and of everything built on it, since the last clear().
struct MessageLog {
    struct Entry {
        Severity severity;
        std::string subject, text;
    };
    std::vector<Entry> entries;
    /// How many entries name `subject` and hold `text`.
    int count(const std::string& subject, const std::string& text) const;
};
MessageLog& messageLog();

/// One device for all tests of a program; made on first use.
Device& testDevice();

template <class T> Buffer toDevice(const std::vector<T>& values) {
    return testDevice().createFrom(values.data(), values.size(), "test");
}
template <class T> Buffer emptyBuffer(size_t count) {
    return testDevice().createBuffer(count * sizeof(T), MemoryUse::Device, "test");
}
template <class T> std::vector<T> toHost(const Buffer& buffer, size_t count) {
    std::vector<T> values(count);
    testDevice().download(buffer, values.data(), count * sizeof(T));
    return values;
}

/// Dispatches enough groups of 64 for `count` invocations and waits.
template <class Push> void dispatch(const Kernel& kernel, const Push& push, size_t count) {
    testDevice().run([&](VkCommandBuffer cmd) { kernel.dispatch(cmd, &push, uint32_t((count + 63) / 64)); });
}

} // namespace hipr::test
