#include "renderer/hipr/schedule_log.h"

#include <cstdlib>
#include <ctime>

namespace hipr {

ScheduleLog::ScheduleLog() : _start(std::chrono::steady_clock::now()) {
    const char* path = std::getenv("HIPR_SCHEDULE_LOG");
    if (path && *path) _file.reset(std::fopen(path, "w"));
}

void ScheduleLog::begin(const char* event) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count();
    std::fprintf(_file.get(), "{\"event\": \"%s\", \"edit\": %u, \"seconds\": %.6f, \"processor\": %.6f",
                 event, _edit, seconds, double(std::clock()) / CLOCKS_PER_SEC);
}

void ScheduleLog::end() {
    std::fputs("}\n", _file.get());
    std::fflush(_file.get());
}

void ScheduleLog::restart(const char* kind, const TileGrid& grid) {
    ++_edit;
    if (!_file) return;
    begin("restart");
    std::fprintf(_file.get(), ", \"kind\": \"%s\", \"width\": %u, \"height\": %u, \"tileSize\": %u", kind,
                 grid.width, grid.height, grid.tileSize);
    end();
}

void ScheduleLog::survey(uint32_t paths) {
    if (!_file) return;
    begin("survey");
    std::fprintf(_file.get(), ", \"paths\": %u", paths);
    end();
}

void ScheduleLog::order(const TileSchedule& schedule) {
    if (!_file) return;
    begin("order");
    std::fputs(", \"tiles\": [", _file.get());
    const char* comma = "";
    for (uint32_t i = 0; i < schedule.grid().count(); ++i) {
        const float priority = schedule.tiles()[i].priority;
        const TileRect r = schedule.grid().rect(i);
        if (!(priority > 0.f)) continue;
        std::fprintf(_file.get(), "%s[%u, %u, %.9g]", comma, r.x, r.y, double(priority));
        comma = ", ";
    }
    std::fputs("]", _file.get());
    end();
}

void ScheduleLog::batch(const std::vector<gpu::TileWork>& work, uint32_t paths,
                        const TileSchedule& schedule) {
    if (!_file) return;
    begin("batch");
    std::fprintf(_file.get(), ", \"paths\": %u, \"tiles\": [", paths);
    for (size_t i = 0; i < work.size(); ++i) {
        const gpu::TileWork& w = work[i];
        const TileState& state = schedule.tiles()[schedule.grid().at(w.x, w.y)];
        std::fprintf(_file.get(), "%s[%u, %u, %u, %u, %u, %u, %d, %d]", i ? ", " : "", w.x, w.y, w.width,
                     w.height, w.firstSample, w.sampleCount, int(!state.keepsOld), int(state.foreseen));
    }
    std::fputs("]", _file.get());
    end();
}

void ScheduleLog::splats(const char* depths) {
    if (!_file) return;
    begin("splats");
    std::fprintf(_file.get(), ", \"depths\": \"%s\"", depths);
    end();
}

} // namespace hipr
