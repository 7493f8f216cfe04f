#include "plugin/hdHipr/volume.h"

#include <optional>

#include "plugin/hdHipr/field.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/primvars.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// The field of the description that is meant by a name in `field:<name>`, or null.
hipr::FieldId* fieldOf(hipr::VolumeDesc& desc, std::string const& name) {
    if (name == "density") {
        return &desc.density;
    }
    if (name == "temperature") {
        return &desc.temperature;
    }
    if (name == "emission" || name == "flame" || name == "heat") {
        return &desc.emission;
    }
    return name == "color" || name == "albedo" || name == "Cd" ? &desc.color : nullptr;
}

} // namespace

HdHiprVolume::HdHiprVolume(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param)
    : ObjectPrim(id, instancerId, param), _volume(param.newId<hipr::VolumeId>()) {}

HdDirtyBits HdHiprVolume::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::InitRepr | objectBits | instanceBits | HdChangeTracker::DirtyVolumeField |
           HdChangeTracker::DirtyPrimvar;
}

/// There is one way to draw volumes.
void HdHiprVolume::_InitRepr(TfToken const&, HdDirtyBits*) {}

HdDirtyBits HdHiprVolume::_PropagateDirtyBits(HdDirtyBits bits) const {
    return bits;
}

void HdHiprVolume::Finalize(HdRenderParam* renderParam) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    removeObject(param);
    param.edit().removeVolume(_volume);
    HdVolume::Finalize(renderParam);
}

void HdHiprVolume::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
                        TfToken const&) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    const HdDirtyBits bits = syncBase(delegate, dirtyBits);
    if (bits & HdChangeTracker::DirtyVolumeField) {
        readFields(delegate, param);
    }
    if (bits & HdChangeTracker::DirtyPrimvar) {
        readLook(delegate);
    }
    if (bits & (HdChangeTracker::DirtyVolumeField | HdChangeTracker::DirtyPrimvar)) {
        param.edit().setVolume(_volume, _desc);
    }
    const bool relinked = syncLinks(*delegate, bits);
    if (bits & objectBits) {
        sendObject(*delegate, param);
    }
    if (relinked || (bits & instanceBits)) {
        sendInstances(standingAt(*delegate, param.sampling()), param);
    }
    *dirtyBits = HdChangeTracker::Clean;
}

void HdHiprVolume::readFields(HdSceneDelegate* delegate, HdHiprRenderParam& param) {
    hipr::VolumeDesc desc;
    desc.name = GetId().GetString();
    desc.look = _desc.look;
    for (HdVolumeFieldDescriptor const& field : delegate->GetVolumeFieldDescriptors(GetId())) {
        const std::string name = field.fieldName.GetString();
        hipr::FieldId* meant = fieldOf(desc, name);
        if (!meant) {
            warnOnce(desc.name, "its field '" + name + "' is not supported and has no effect");
        } else if (field.fieldPrimType != vdbFieldType()) {
            warnOnce(desc.name, "its field '" + name + "' is a '" + field.fieldPrimType.GetString() +
                                    "', which is not supported; only OpenVDB files are");
        } else {
            if (!delegate->GetRenderIndex().GetBprim(field.fieldPrimType, field.fieldId)) {
                warnOnce(desc.name, "the host does not hand over its field '" + name + "', <" +
                                        field.fieldId.GetString() + ">");
            }
            *meant = param.fieldId(field.fieldId);
        }
    }
    if (desc.density == hipr::FieldId::None && desc.emission == hipr::FieldId::None &&
        desc.temperature == hipr::FieldId::None) {
        warnOnce(desc.name, "it has no field 'density', 'emission' or 'temperature': nothing is seen of it");
    }
    _desc = desc;
}

void HdHiprVolume::readLook(HdSceneDelegate* delegate) {
    glm::vec3 albedo(0.8f);
    float density = 1.f;
    hipr::VolumeLook look;
    for (HdPrimvarDescriptor const& descriptor : GetPrimvarDescriptors(delegate, HdInterpolationConstant)) {
        VtIntArray indices;
        const std::string name = descriptor.name.GetString();
        if (name.rfind("hipr:volume:", 0) != 0) {
            continue;
        }
        const std::optional<glm::vec3> value =
            toColor(descriptor.name, readPrimvar(delegate, descriptor.name, &indices));
        const std::string meant = name.substr(name.rfind(':') + 1);
        if (!value) {
            warnOnce(GetId().GetString(), "'" + name + "' is no finite number and has no effect");
        } else if (meant == "density") {
            density = value->x;
        } else if (meant == "albedo") {
            albedo = *value;
        } else if (meant == "anisotropy") {
            look.anisotropy = value->x;
        } else if (meant == "emission") {
            look.emission = *value;
        } else if (meant == "temperatureScale") {
            look.temperatureScale = value->x;
        } else {
            warnOnce(GetId().GetString(), "there is no primvar '" + name + "' for volumes");
        }
    }
    look.scattering = density * glm::clamp(albedo, 0.f, 1.f);
    look.absorption = density - look.scattering;
    _desc.look = look;
}

void HdHiprVolume::describe(HdSceneDelegate&, HdHiprRenderParam& param, hipr::ObjectDesc& desc) {
    desc.volume = _volume;
    desc.materials = {param.materialId(GetMaterialId())};
}

PXR_NAMESPACE_CLOSE_SCOPE
