#include "renderer/shading/names.h"

namespace hipr {

NameTable::NameTable()
    : _ids{{"displayColor", DisplayColor}, {"displayOpacity", DisplayOpacity}, {"st", St}} {}

uint32_t NameTable::intern(const std::string& name) {
    std::lock_guard lock(_mutex);
    return _ids.emplace(name, uint32_t(_ids.size())).first->second;
}

} // namespace hipr
