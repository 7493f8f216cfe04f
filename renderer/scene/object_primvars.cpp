// The primvars of instances, in device memory.
#include <algorithm>

#include "renderer/scene/buffer_pack.h"
#include "renderer/scene/instance_diff.h"
#include "renderer/scene/object_table.h"

namespace hipr {

void ObjectTable::uploadPrimvars(Entry& entry) {
    entry.primvars = Buffer();
    entry.primvarCount = 0;
    if (!entry.instances || entry.instances->primvars.empty() || entry.usable.empty()) return;

    BufferPack pack;
    std::vector<const Primvar*> used;
    std::vector<uint64_t> offsets;
    for (const Primvar& primvar : entry.instances->primvars) {
        const bool complete = primvar.components >= 1 && primvar.components <= 4 &&
                              std::all_of(entry.usable.begin(), entry.usable.end(),
                                          [&](uint32_t i) { return instanceValue(primvar, i) >= 0; });
        if (!complete) {
            _device.messages()(Severity::Warning, entry.desc->name,
                               "instance primvar '" + primvar.name +
                                   "' has no value for some instances; ignored");
            continue;
        }
        used.push_back(&primvar);
        offsets.push_back(pack.add(primvar.values));
    }
    const uint64_t table = pack.reserve(used.size() * entry.usable.size() * sizeof(gpu::PrimvarRecord));
    entry.primvars = _device.createBuffer(pack.bytes(), MemoryUse::Device, "Instance primvars");
    std::vector<gpu::PrimvarRecord> records;
    for (uint32_t instance : entry.usable)
        for (size_t i = 0; i < used.size(); ++i)
            records.push_back(
                {entry.primvars.address() + offsets[i] +
                     uint64_t(instanceValue(*used[i], instance)) * used[i]->components * sizeof(float),
                 _names.intern(used[i]->name), gpu::INTERPOLATION_CONSTANT, used[i]->components, 0});
    pack.write(table, records);
    pack.upload(_device, entry.primvars);
    entry.primvarCount = uint32_t(used.size());
    entry.primvarTable = entry.primvars.address() + table;
}

} // namespace hipr
