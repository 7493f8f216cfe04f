#include "testenv/bench/report.h"

#include <cstdarg>
#include <cstdio>
#include <ostream>

namespace hipr::bench {

namespace {

std::string text(const char* format, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    return line;
}

std::string text(const Spread& s) {
    return text("%.2f (%.2f-%.2f)", s.median, s.minimum, s.maximum);
}

void printTraversals(std::ostream& out, const TraversalReport& report) {
    out << "\n| traversal | triangles | rays | Mray/s | bare Embree | ratio | other answers |\n"
           "|---|---|---|---|---|---|---|\n";
    for (const TraversalRow& r : report.rows)
        out << text("| %s | %llu | %s | %s | %s | %s | %.4f %% |\n", r.traversal.c_str(),
                    static_cast<unsigned long long>(r.triangles), r.rays.c_str(),
                    text(r.mraysPerSecond).c_str(), text(r.bareMraysPerSecond).c_str(), text(r.ratio).c_str(),
                    100 * r.disagreeing);
    out << "\n| build | triangles | s | MiB |\n|---|---|---|---|\n";
    for (const BuildRow& b : report.builds)
        out << text("| %s | %llu | %.3f | %s |\n", b.traversal.c_str(),
                    static_cast<unsigned long long>(b.triangles), b.seconds,
                    b.bytes ? text("%.1f", double(b.bytes) / (1 << 20)).c_str() : "");
}

void printFrames(std::ostream& out, const std::vector<FrameRow>& frames) {
    out << "\n| picture by | triangles | Msamples/s | Mray/s | rays/sample | buffers MiB "
           "|\n|---|---|---|---|---|---|\n";
    for (const FrameRow& f : frames)
        out << text("| %s | %llu | %s | %s | %.1f | %.1f |\n", f.traversal.c_str(),
                    static_cast<unsigned long long>(f.triangles), text(f.msamplesPerSecond).c_str(),
                    text(f.mraysPerSecond).c_str(), f.raysPerSample, double(f.memory.total()) / (1 << 20));
}

} // namespace

void printTables(std::ostream& out, const Report& report) {
    out << text("%s, %s, %u threads, load before %.2f; median (least-most) of %d\n", report.device.c_str(),
                report.driver.c_str(), report.threads, report.loadBefore, report.repetitions);
    for (const TraversalReport& t : report.traversals)
        printTraversals(out, t);
    if (!report.frames.empty()) printFrames(out, report.frames);
    if (report.start)
        out << text("\nfirst pixel: cold %s s, warm %s s; peak memory %.0f MiB\n",
                    text(report.start->coldSeconds).c_str(), text(report.start->warmSeconds).c_str(),
                    report.start->peakMiB);
}

nlohmann::json toJson(const Report& report) {
    using nlohmann::json;
    json traversals = json::array(), builds = json::array(), frames = json::array();
    for (const TraversalReport& t : report.traversals) {
        for (const TraversalRow& r : t.rows)
            traversals.push_back({{"traversal", r.traversal},
                                  {"rays", r.rays},
                                  {"triangles", r.triangles},
                                  {"mraysPerSecond", toJson(r.mraysPerSecond)},
                                  {"bareEmbreeMraysPerSecond", toJson(r.bareMraysPerSecond)},
                                  {"ratio", toJson(r.ratio)},
                                  {"disagreeing", r.disagreeing}});
        for (const BuildRow& b : t.builds)
            builds.push_back({{"traversal", b.traversal},
                              {"triangles", b.triangles},
                              {"seconds", b.seconds},
                              {"bytes", b.bytes}});
    }
    for (const FrameRow& f : report.frames) {
        json memory = json::object();
        for (const MemoryReport::Row& row : f.memory.rows)
            memory[row.kind] = row.bytes;
        frames.push_back({{"traversal", f.traversal},
                          {"triangles", f.triangles},
                          {"msamplesPerSecond", toJson(f.msamplesPerSecond)},
                          {"mraysPerSecond", toJson(f.mraysPerSecond)},
                          {"raysPerSample", f.raysPerSample},
                          {"memory", memory}});
    }
    json all = {{"device", report.device},
                {"driver", report.driver},
                {"threads", report.threads},
                {"loadBefore", report.loadBefore},
                {"repetitions", report.repetitions},
                {"traversals", traversals},
                {"builds", builds},
                {"frames", frames}};
    if (report.start)
        all["firstPixel"] = {{"coldSeconds", toJson(report.start->coldSeconds)},
                             {"warmSeconds", toJson(report.start->warmSeconds)},
                             {"peakMiB", report.start->peakMiB}};
    return all;
}

} // namespace hipr::bench
