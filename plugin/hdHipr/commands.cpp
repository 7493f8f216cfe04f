#include "plugin/hdHipr/commands.h"

#include <algorithm>
#include <fstream>

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/renderParam.h"
#include "renderer/vulkan/cachefolder.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

bool reloadTextures(HdHiprRenderParam& param, VtDictionary const&) {
    hipr::SceneEdit edit; // its own: prims may be filling that of `param`
    param.shownFields().readAgain(edit);
    param.loop()->submitEdit(edit);
    param.loop()->submitTextureReload();
    return true;
}

bool clearCaches(HdHiprRenderParam& param, VtDictionary const&) {
    reloadTextures(param, {});
    const bool cleared = hipr::clearKernelCaches();
    if (!cleared) {
        warnOnce("", "the kept kernels cannot all be deleted from '" + hipr::cacheFolder().string() + "'");
    }
    return cleared;
}

bool dumpScene(HdHiprRenderParam& param, VtDictionary const& arguments) {
    const std::string path = VtDictionaryGet<std::string>(arguments, "file", VtDefault = std::string());
    std::ofstream file(path);
    param.loop()->whenIdle([&](hipr::Renderer& renderer) { renderer.dumpScene(file); });
    file.close();
    if (!file) {
        warnOnce("", "the scene cannot be written to '" + path + "'");
    }
    return bool(file);
}

} // namespace

std::vector<Command> const& commands() {
    static const std::vector<Command> all = {
        {"reloadTextures",
         "Read all textures, light profiles and volumes again and start the picture anew",
         {},
         reloadTextures},
        {"clearCaches",
         "Delete the compiled kernels that are kept between runs, and do what reloadTextures does",
         {},
         clearCaches},
        {"dumpScene",
         "Write what the renderer holds of the scene to a text file",
         {{"file", VtValue(std::string("hipr_scene.txt"))}},
         dumpScene}};
    return all;
}

bool invokeCommand(HdHiprRenderParam& param, TfToken const& name, VtDictionary const& arguments) {
    const auto command = std::find_if(commands().begin(), commands().end(),
                                      [&](Command const& known) { return name == known.name; });
    if (command == commands().end()) {
        warnOnce("", "there is no command '" + name.GetString() + "'");
        return false;
    }
    return command->invoke(param, VtDictionaryOver(arguments, command->arguments));
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
