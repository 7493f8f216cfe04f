#include "renderer/scene/culling.h"

#include "shaders/shared/scene.h"

namespace hipr {

uint32_t cullFlags(CullStyle style, bool doubleSided) {
    switch (style) {
    case CullStyle::Inherit:
    case CullStyle::Nothing:
        return 0;
    case CullStyle::Back:
        return gpu::INSTANCE_CULL_BACK;
    case CullStyle::Front:
        return gpu::INSTANCE_CULL_FRONT;
    case CullStyle::BackUnlessDoubleSided:
        return doubleSided ? 0 : gpu::INSTANCE_CULL_BACK;
    case CullStyle::FrontUnlessDoubleSided:
        return doubleSided ? 0 : gpu::INSTANCE_CULL_FRONT;
    case CullStyle::BackAndForLight:
        return gpu::INSTANCE_CULL_BACK | gpu::INSTANCE_CULL_FOR_LIGHT;
    }
    return 0;
}

} // namespace hipr
