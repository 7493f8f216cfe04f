// hiprdevices: lists the Vulkan devices and what each can do.
#include <cstring>
#include <iostream>

#include <nlohmann/json.hpp>

#include "renderer/api/renderer.h"

namespace {

const char* Help =
    "Usage: hiprdevices [--json]\n"
    "\n"
    "Lists the Vulkan devices and what HiPR can do with each. Choose one with HIPR_DEVICE=<index or\n"
    "part of the name>. Exits with 1 when no device is usable.\n"
    "\n"
    "  --json      print a JSON array\n"
    "  -h, --help  print this\n";

void printJson(const std::vector<hipr::DeviceInfo>& devices) {
    nlohmann::json list = nlohmann::json::array();
    for (const hipr::DeviceInfo& d : devices)
        list.push_back({{"index", d.index},
                        {"name", d.name},
                        {"driver", d.driver},
                        {"cpu", d.cpu},
                        {"rayQuery", d.rayQuery},
                        {"usable", d.usable},
                        {"missing", d.missing},
                        {"memoryBytes", d.memoryBytes}});
    std::cout << list.dump(2) << "\n";
}

void printText(const std::vector<hipr::DeviceInfo>& devices) {
    for (const hipr::DeviceInfo& d : devices) {
        std::cout << d.index << "  " << d.name << (d.usable ? "" : "  (not usable)") << "\n";
        if (!d.driver.empty()) std::cout << "   driver     " << d.driver << "\n";
        std::cout << "   memory     " << d.memoryBytes / (1 << 20) << " MiB\n";
        std::cout << "   traversal  GLSL BVH" << (d.cpu ? ", trees on the host, Embree" : "")
                  << (d.rayQuery ? ", ray query" : "") << "\n";
        if (!d.usable) std::cout << "   lacks      " << d.missing << "\n";
    }
    if (devices.empty())
        std::cout << "No Vulkan device. On a machine without a GPU install Mesa's lavapipe (Debian: "
                     "mesa-vulkan-drivers).\n";
}

} // namespace

int main(int argc, char** argv) {
    bool json = false;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "-h") == 0 || std::strcmp(argv[i], "--help") == 0) {
            std::cout << Help;
            return 0;
        }
        if (std::strcmp(argv[i], "--json") != 0) {
            std::cerr << "hiprdevices: unknown argument '" << argv[i] << "'\n\n" << Help;
            return 2;
        }
        json = true;
    }
    const std::vector<hipr::DeviceInfo> devices = hipr::devices();
    json ? printJson(devices) : printText(devices);
    for (const hipr::DeviceInfo& d : devices)
        if (d.usable) return 0;
    return 1;
}
