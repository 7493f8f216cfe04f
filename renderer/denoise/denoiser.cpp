#include "renderer/api/denoise.h"

#include <algorithm>
#include <thread>

#include "renderer/denoise/oidn_api.h"

namespace hipr {
namespace {

constexpr char Advice[] =
    "; install libopenimagedenoise2, or let HIPR_OIDN_LIBRARY name the libOpenImageDenoise.so.2 of "
    "the Python package pyoidn";

class OidnDenoiser final : public Denoiser {
public:
    OidnDenoiser(const OidnApi& api, OidnApi::Device device) : _api(api), _device(device) {}
    ~OidnDenoiser() override { _api.releaseDevice(_device); }

    Outcome denoise(NoisyPicture& picture, const std::function<bool()>& stop, std::string* error) override;

private:
    void setImage(OidnApi::Filter filter, const char* name, float* pixels, const NoisyPicture& picture,
                  size_t floats) const;

    const OidnApi& _api;
    OidnApi::Device _device;
};

bool goOn(void* user, double) {
    return !(*static_cast<const std::function<bool()>*>(user))();
}

void OidnDenoiser::setImage(OidnApi::Filter filter, const char* name, float* pixels,
                            const NoisyPicture& picture, size_t floats) const {
    _api.setSharedFilterImage(filter, name, pixels, OidnApi::Float3, picture.width, picture.height, 0,
                              floats * sizeof(float), 0);
}

/// In place: the filter reads all of its input before it writes, or keeps what it still needs.
Denoiser::Outcome OidnDenoiser::denoise(NoisyPicture& picture, const std::function<bool()>& stop,
                                        std::string* error) {
    const size_t pixels = size_t(picture.width) * picture.height;
    if (pixels == 0) return Outcome::Done;
    const OidnApi::Filter filter = _api.newFilter(_device, "RT");
    if (filter) {
        setImage(filter, "color", picture.color.data(), picture, 4);
        setImage(filter, "output", picture.color.data(), picture, 4);
        if (picture.albedo.size() == 3 * pixels)
            setImage(filter, "albedo", picture.albedo.data(), picture, 3);
        if (picture.normal.size() == 3 * pixels)
            setImage(filter, "normal", picture.normal.data(), picture, 3);
        _api.setFilterBool(filter, "hdr", true);
        _api.setFilterProgressMonitorFunction(filter, goOn, const_cast<std::function<bool()>*>(&stop));
        _api.commitFilter(filter);
        _api.executeFilter(filter);
        _api.releaseFilter(filter);
    }
    const char* message = nullptr;
    const int code = _api.getDeviceError(_device, &message);
    if (code == 0 && filter) return Outcome::Done;
    if (code == OidnApi::Cancelled) return Outcome::Stopped;
    *error = std::string("Open Image Denoise: ") + (message ? message : "there is no filter");
    return Outcome::Failed;
}

const OidnApi* loadLibrary(std::string* error) {
    std::string reason;
    const OidnApi* api = loadOidn(oidnLibrary(), &reason);
    if (!api) *error = "Open Image Denoise is not there: " + reason + Advice;
    return api;
}

} // namespace

std::string Denoiser::missing() {
    std::string error;
    return loadLibrary(&error) ? "" : error;
}

std::unique_ptr<Denoiser> Denoiser::create(int threadLimit, std::string* error) {
    const OidnApi* api = loadLibrary(error);
    if (!api) return nullptr;
    const OidnApi::Device device = api->newDevice(OidnApi::CpuDevice);
    const char* message = nullptr;
    if (device) {
        const int all = std::max(1, int(std::thread::hardware_concurrency()));
        const int threads = threadLimit > 0 ? std::min(threadLimit, all) : std::max(1, all + threadLimit);
        api->setDeviceInt(device, "numThreads", threads);
        api->setDeviceBool(device, "setAffinity", false); // other threads of the host want those cores too
        api->commitDevice(device);
        if (api->getDeviceError(device, &message) == 0) return std::make_unique<OidnDenoiser>(*api, device);
    } else
        api->getDeviceError(nullptr, &message);
    *error = std::string("Open Image Denoise cannot be used: ") + (message ? message : "no reason is given");
    if (device) api->releaseDevice(device);
    return nullptr;
}

} // namespace hipr
