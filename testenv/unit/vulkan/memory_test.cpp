#include <cstring>
#include <random>
#include <thread>

#include "testenv/unit/vulkan/fixture.h"

namespace hipr::test {
namespace {

using Memory = DeviceTest;
INSTANTIATE_TEST_SUITE_P(, Memory, ::testing::Bool(), memoryName);

TEST_P(Memory, BuffersDoNotOverlapAndAreAligned) {
    std::mt19937 random(11);
    std::vector<Buffer> live;
    uint64_t bytes = 0;
    for (int step = 0; step < 2000; ++step) {
        if (live.empty() || random() % 100 < 60) {
            const uint64_t size = random() % 50 == 0 ? random() % (4u << 20) : random() % 5000;
            live.push_back(device->createBuffer(size, MemoryUse::Device, "test"));
            EXPECT_EQ(live.back().address() % 256, 0u);
            EXPECT_EQ(live.back().bytes(), std::max<uint64_t>(size, 16));
            EXPECT_EQ(live.back().mapped() != nullptr, GetParam());
        } else {
            std::swap(live[random() % live.size()], live.back());
            live.pop_back();
        }
    }
    std::map<uint64_t, uint64_t> ranges;
    for (const Buffer& b : live) {
        ASSERT_TRUE(ranges.emplace(b.address(), b.bytes()).second);
        bytes += b.bytes();
    }
    uint64_t end = 0;
    for (const auto& [address, size] : ranges) {
        EXPECT_GE(address, end);
        end = address + size;
    }
    ASSERT_EQ(device->memory().rows.size(), 1u);
    EXPECT_EQ(device->memory().rows[0].kind, "test");
    EXPECT_GE(device->memory().total(), bytes);
    EXPECT_LE(device->memory().total(), bytes + live.size() * 256) << "what the driver rounds up";
    EXPECT_GE(device->reservedBytes(), device->memory().total());
}

TEST_P(Memory, MappedWhenAskedFor) {
    const Buffer up = device->createBuffer(64, MemoryUse::Upload, "a");
    const Buffer down = device->createBuffer(64, MemoryUse::Readback, "b");
    EXPECT_NE(up.mapped(), nullptr);
    EXPECT_NE(down.mapped(), nullptr);
}

TEST_P(Memory, CountsByKindAndMoves) {
    Buffer a = device->createBuffer(1 << 20, MemoryUse::Device, "positions");
    Buffer b = device->createBuffer(3 << 20, MemoryUse::Device, "textures");
    Buffer c = device->createBuffer(1 << 20, MemoryUse::Device, "positions");
    const MemoryReport report = device->memory();
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.rows[0].kind, "textures");
    EXPECT_EQ(report.rows[0].bytes, uint64_t(3) << 20);
    EXPECT_EQ(report.rows[1].bytes, uint64_t(2) << 20);
    const VkBuffer handle = a.handle();
    c = std::move(a);
    EXPECT_FALSE(a);
    EXPECT_EQ(c.handle(), handle);
    EXPECT_EQ(device->memory().total(), uint64_t(4) << 20);
}

TEST_P(Memory, LargeBuffersReturnToTheDriver) {
    const Buffer small = device->createBuffer(16, MemoryUse::Device, "small");
    const uint64_t before = device->reservedBytes();
    Buffer large = device->createBuffer(200ull << 20, MemoryUse::Device, "large");
    EXPECT_GE(device->reservedBytes(), before + (200ull << 20));
    large = Buffer();
    EXPECT_EQ(device->reservedBytes(), before);
}

TEST_P(Memory, ExhaustionIsReportedAndSurvived) {
    for (const uint64_t bytes : {uint64_t(1) << 62, device->info().memoryBytes + 1}) {
        try {
            device->createBuffer(bytes, MemoryUse::Device, "film");
            ADD_FAILURE() << bytes;
        } catch (const OutOfMemory& e) {
            EXPECT_THAT(e.what(), ::testing::HasSubstr(std::to_string(bytes) + " bytes wanted (film)"));
        }
    }
    std::vector<Buffer> all;
    EXPECT_THROW(while (all.size() < 1000)
                     all.push_back(device->createBuffer(1ull << 30, MemoryUse::Device, "film")),
                 OutOfMemory);
    all.clear();
    const int value = 42;
    int back = 0;
    device->download(device->createFrom(&value, 1, "film"), &back, sizeof back);
    EXPECT_EQ(back, 42);
}

TEST_P(Memory, ThreadsShareTheDevice) {
    const auto work = [&](unsigned seed) {
        std::mt19937 random(seed);
        std::vector<std::pair<Buffer, unsigned>> live;
        for (int step = 0; step < 400; ++step) {
            const unsigned value = random();
            Buffer b = device->createBuffer(4 + random() % 20000, MemoryUse::Device, "thread");
            device->upload(b, &value, sizeof value);
            live.emplace_back(std::move(b), value);
            auto& other = live[random() % live.size()];
            unsigned back = 0;
            device->download(other.first, &back, sizeof back);
            EXPECT_EQ(back, other.second);
            if (live.size() > 20) live.erase(live.begin());
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < 4; ++i)
        threads.emplace_back(work, i);
    for (std::thread& t : threads)
        t.join();
}

} // namespace
} // namespace hipr::test
