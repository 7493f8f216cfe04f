#include "renderer/trace/machine.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace hipr {
namespace {

std::mutex poolMutex;
int reuses = 0;                             ///< living MachineReuse objects
std::vector<std::unique_ptr<Machine>> idle; ///< guarded by poolMutex, like `reuses`

/// Paths a batch can hold: enough to fill the device, not more than its caches and memory like.
uint32_t batchCapacity(const DeviceInfo& device) {
    return device.cpu ? 1u << 16 : 1u << 20;
}

std::unique_ptr<Machine> takeIdle(const std::string& key) {
    const std::lock_guard<std::mutex> lock(poolMutex);
    const auto found = std::find_if(idle.begin(), idle.end(), [&](const auto& m) { return m->key == key; });
    if (found == idle.end()) return nullptr;
    std::unique_ptr<Machine> machine = std::move(*found);
    idle.erase(found);
    return machine;
}

} // namespace

void MachineReturn::operator()(Machine* machine) const {
    std::unique_ptr<Machine> owned(machine);
    const std::lock_guard<std::mutex> lock(poolMutex);
    if (reuses > 0) idle.push_back(std::move(owned));
}

MachinePtr makeMachine(const RendererOptions& options, uint32_t paths, std::string* error) {
    const std::string key =
        options.device + '\n' + (options.validation ? "validated " : "") + std::to_string(paths);
    if (std::unique_ptr<Machine> machine = takeIdle(key)) return MachinePtr(machine.release());
    std::unique_ptr<Device> device = Device::create(options, error);
    if (!device) return nullptr;
    Device& used = *device;
    return MachinePtr(new Machine{
        key, std::move(device), PathTracer(used, std::max(batchCapacity(used.info()), paths)), {}});
}

MachineReuse::MachineReuse() {
    const std::lock_guard<std::mutex> lock(poolMutex);
    ++reuses;
}

MachineReuse::~MachineReuse() {
    std::vector<std::unique_ptr<Machine>> gone;
    const std::lock_guard<std::mutex> lock(poolMutex);
    if (--reuses == 0) gone.swap(idle);
}

} // namespace hipr
