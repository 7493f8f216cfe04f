/// @file schedule_log.h
/// A record of what was rendered when, for measurements: HIPR_SCHEDULE_LOG=FILE in the environment.
///
/// One JSON object a line. Every line has `event`, `edit` (restarts so far), `seconds` (since the log began)
/// and `processor` (seconds of processor time of all threads so far).
///   restart  `kind`: picture, edit, camera, everything; `width`, `height`, `tileSize`
///   survey   `paths`: scouts of a batch
///   order    `tiles`: [x, y, priority] of discovered tiles; in mode paper first of the active ones alone
///   batch    `paths`, `tiles`: [x, y, width, height, firstSample, sampleCount, shown, foreseen]; shown is 0
///            where the tile keeps its old picture on display, which these samples did not change; foreseen
///            is 1 where the tile had been discovered when its first sample was handed out
///   splats   have been drawn; `depths` of what hides them: none, earlier (of before the edit, or carried to
///            the new camera) or current
#pragma once

#include <chrono>
#include <cstdio>
#include <memory>

#include "renderer/hipr/schedule.h"

namespace hipr {

class ScheduleLog {
public:
    ScheduleLog();

    void restart(const char* kind, const TileGrid& grid);
    void survey(uint32_t paths);
    void order(const TileSchedule& schedule);
    /// After TileSchedule::advance().
    void batch(const std::vector<gpu::TileWork>& work, uint32_t paths, const TileSchedule& schedule);
    void splats(const char* depths);

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void begin(const char* event);
    void end();

    std::unique_ptr<std::FILE, Close> _file;
    std::chrono::steady_clock::time_point _start;
    uint32_t _edit = 0;
};

} // namespace hipr
