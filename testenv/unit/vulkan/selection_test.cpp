#include "renderer/vulkan/adapter.h"
#include "testenv/unit/vulkan/fixture.h"

namespace hipr::test {
namespace {

Adapter adapter(uint32_t index, const char* name, VkPhysicalDeviceType type, const char* missing = "") {
    Adapter a;
    a.info.index = index;
    a.info.name = name;
    a.info.missing = missing;
    a.info.usable = a.info.missing.empty();
    a.type = type;
    return a;
}

class Selection : public ::testing::Test {
protected:
    std::string choose(const std::string& selector) {
        error.clear();
        const Adapter* a = chooseAdapter(adapters, selector, &error);
        return a ? a->info.name : "";
    }
    std::vector<Adapter> adapters = {
        adapter(0, "llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
        adapter(1, "Old Discrete 9", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "shaderInt64"),
        adapter(2, "Venus", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU),
        adapter(3, "Integrated 2", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
        adapter(4, "Radical 7", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
        adapter(5, "Radical 8", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
    };
    std::string error;
    Environment environment{"HIPR_DEVICE", ""};
};

TEST_F(Selection, BestUsableClassFirst) {
    for (const char* name : {"Radical 7", "Radical 8", "Integrated 2", "Venus", "llvmpipe"}) {
        EXPECT_EQ(choose(""), name);
        for (Adapter& a : adapters)
            if (a.info.name == name) a.info.usable = false, a.info.missing = "test";
    }
    EXPECT_EQ(choose(""), "");
    EXPECT_THAT(error, ::testing::StartsWith("no usable Vulkan device: 'llvmpipe' lacks test;"));
    EXPECT_THAT(error, ::testing::HasSubstr("'Old Discrete 9' lacks shaderInt64"));
}

TEST_F(Selection, ByIndexOrPartOfTheName) {
    EXPECT_EQ(choose("3"), "Integrated 2");
    EXPECT_EQ(choose("LLVM"), "llvmpipe");
    EXPECT_EQ(choose("radical 8"), "Radical 8");
}

TEST_F(Selection, EnvironmentUnlessAskedOtherwise) {
    const Environment chosen("HIPR_DEVICE", "venus");
    EXPECT_EQ(choose(""), "Venus");
    EXPECT_EQ(choose("0"), "llvmpipe");
}

TEST_F(Selection, WrongChoicesSayWhatThereIs) {
    EXPECT_EQ(choose("42"), "");
    EXPECT_THAT(error, ::testing::HasSubstr("'42'; there are: 0 = llvmpipe, 1 = Old Discrete 9"));
    EXPECT_EQ(choose("99999999999999999999"), "");
    EXPECT_THAT(error, ::testing::HasSubstr("no Vulkan device matches"));
    EXPECT_EQ(choose("old"), "");
    EXPECT_EQ(error, "the Vulkan device 'Old Discrete 9' lacks shaderInt64");
    adapters.clear();
    EXPECT_EQ(choose(""), "");
    EXPECT_THAT(error, ::testing::StartsWith("no Vulkan device found"));
}

TEST_F(Selection, DeviceReportsTheReason) {
    RendererOptions options;
    options.device = "no such device";
    EXPECT_FALSE(Device::create(options, &error));
    EXPECT_THAT(error, ::testing::HasSubstr("'no such device'; there are: 0 = "));
}

TEST_F(Selection, NoDriverAtAllIsAReason) {
    const Environment drivers("VK_DRIVER_FILES", "/nonexistent.json"),
        old("VK_ICD_FILENAMES", "/nonexistent.json");
    EXPECT_FALSE(Device::create({}, &error));
    EXPECT_THAT(error, ::testing::HasSubstr("lavapipe"));
    EXPECT_TRUE(devices().empty());
}

TEST(MemoryTypes, OrderedByWish) {
    VkPhysicalDeviceMemoryProperties p{};
    const VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    for (const VkMemoryPropertyFlags flags :
         {local | visible, local, visible, visible | cached, local | VK_MEMORY_PROPERTY_PROTECTED_BIT})
        p.memoryTypes[p.memoryTypeCount++].propertyFlags = flags;
    using Types = std::vector<uint32_t>;
    EXPECT_EQ(memoryTypes(p, local, 0, visible), (Types{1, 0}));
    EXPECT_EQ(memoryTypes(p, visible, local, cached), (Types{0, 2, 3}));
    EXPECT_EQ(memoryTypes(p, visible, cached, local), (Types{3, 2, 0}));
}

} // namespace
} // namespace hipr::test
