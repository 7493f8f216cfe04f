/// @file categories.h
/// Light linking: which objects a light lights, and which cast its shadows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/vulkan/device.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// Objects are in categories; a light names one whose objects it lights, and one whose objects cast its
/// shadows. Names and sets of names get numbers, which they keep. Used by one thread.
class CategoryTable {
public:
    explicit CategoryTable(Device& device) : _device(device) {}

    /// The number of a category; gpu::NO_INDEX for no name, which stands for all objects.
    uint32_t category(const std::string& name);
    /// One of 31 bits, the same for a category whatever others there are; all 32 for no name. What is in a
    /// category has its bit in the mark of its set; so may what is not, but seldom.
    static uint32_t markOf(const std::string& name);
    /// The number of a set, whatever the order of its names; that of the empty one is 0.
    uint32_t set(std::vector<std::string> names);

    /// Uploads the table if names or sets have come. No submission may be reading it.
    void commit();
    /// Fills SceneRecord::categorySets and categoryWords.
    void describe(gpu::SceneRecord& scene) const;

private:
    Device& _device;
    std::map<std::string, uint32_t> _categories;
    std::map<std::vector<std::string>, uint32_t> _sets{{{}, 0}};
    bool _changed = true;
    uint32_t _words = 0;
    Buffer _table;
};

} // namespace hipr
