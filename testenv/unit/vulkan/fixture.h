/// @file fixture.h
/// A device with validation on; every test ends with the layer silent and all memory returned.
#pragma once

#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/vulkan/device.h"

namespace hipr::test {

struct Message {
    Severity severity;
    std::string subject, text;
};

class Messages {
public:
    MessageSink sink() {
        return [this](Severity severity, const std::string& subject, const std::string& text) {
            std::lock_guard lock(_mutex);
            _all.push_back({severity, subject, text});
        };
    }
    std::vector<Message> all() const {
        std::lock_guard lock(_mutex);
        return _all;
    }

private:
    mutable std::mutex _mutex;
    std::vector<Message> _all;
};

/// Sets an environment variable while it lives.
class Environment {
public:
    Environment(const char* name, const char* value) : _name(name) {
        if (const char* old = std::getenv(name)) _old = old, _had = true;
        setenv(name, value, 1);
    }
    ~Environment() { _had ? setenv(_name.c_str(), _old.c_str(), 1) : unsetenv(_name.c_str()); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::string _name, _old;
    bool _had = false;
};

/// A device whose messages, the validation layer's among them, go to `messages`; null fails the test.
inline std::unique_ptr<Device> validatedDevice(Messages& messages) {
    RendererOptions options;
    options.validation = true;
    options.messages = messages.sink();
    std::string error;
    std::unique_ptr<Device> device = Device::create(options, &error);
    EXPECT_TRUE(device) << error;
    return device;
}

/// The parameter is hostMemory(): lavapipe as it is, and treated as a GPU with memory of its own.
class DeviceTest : public ::testing::TestWithParam<bool> {
protected:
    void SetUp() override {
        const Environment environment("HIPR_NO_HOST_MEMORY", GetParam() ? "0" : "1");
        device = validatedDevice(messages);
        ASSERT_TRUE(device);
        if (GetParam() && !device->hostMemory()) GTEST_SKIP() << "the device has memory of its own";
        ASSERT_TRUE(device->validation()) << "VK_LAYER_KHRONOS_validation is not installed";
    }

    void TearDown() override {
        if (!device) return;
        for (const MemoryReport::Row& row : device->memory().rows)
            EXPECT_EQ(row.kind, "staging") << row.bytes << " bytes were not returned";
        EXPECT_EQ(device->validationErrors(), 0u);
        device.reset();
        for (const Message& m : messages.all())
            EXPECT_NE(m.subject, "Vulkan validation") << m.text;
    }

    Messages messages;
    std::unique_ptr<Device> device;
};

inline std::string memoryName(const ::testing::TestParamInfo<bool>& info) {
    return info.param ? "HostMemory" : "Staged";
}

} // namespace hipr::test
