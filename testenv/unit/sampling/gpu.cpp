#include "testenv/unit/sampling/gpu.h"

#include <mutex>

namespace hipr::test {

int MessageLog::count(const std::string& subject, const std::string& text) const {
    int n = 0;
    for (const Entry& e : entries)
        if (e.subject == subject && e.text.find(text) != std::string::npos) ++n;
    return n;
}

MessageLog& messageLog() {
    static MessageLog log;
    return log;
}

Device& testDevice() {
    static const std::unique_ptr<Device> device = [] {
        RendererOptions options;
        options.validation = true;
        options.messages = [](Severity severity, const std::string& subject, const std::string& text) {
            static std::mutex mutex;
            std::lock_guard lock(mutex);
            messageLog().entries.push_back({severity, subject, text});
        };
        std::string error;
        auto made = Device::create(options, &error);
        if (!made) throw std::runtime_error("no Vulkan device: " + error);
        return made;
    }();
    return *device;
}

namespace {

/// Fails the run when the validation layers said anything.
class ValidationIsSilent : public ::testing::Environment {
public:
    void TearDown() override {
        EXPECT_EQ(testDevice().validationErrors(), 0u);
        for (const auto& e : messageLog().entries)
            EXPECT_NE(e.subject, "Vulkan validation") << e.text;
    }
};
const auto* const validation = ::testing::AddGlobalTestEnvironment(new ValidationIsSilent);

} // namespace
} // namespace hipr::test
