#include "testenv/bench/report.h"

#include <ostream>

namespace hipr::bench {

namespace {

using bench::text; // what follows would hide it

std::string text(const Spread& s) {
    return text(s, 2);
}

void printRow(std::ostream& out, std::initializer_list<std::string> cells) {
    for (const std::string& cell : cells)
        out << "| " << cell << " ";
    out << "|\n";
}

void printHeader(std::ostream& out, std::initializer_list<std::string> cells) {
    out << "\n";
    printRow(out, cells);
    for (size_t i = 0; i < cells.size(); ++i)
        out << "|---";
    out << "|\n";
}

void printTraversals(std::ostream& out, const TraversalReport& report) {
    printHeader(out, {"traversal", "triangles", "rays", "Mray/s", "bare Embree", "ratio",
                      "ratio, processor time", "other answers"});
    for (const TraversalRow& r : report.rows)
        printRow(out, {r.traversal, std::to_string(r.triangles), r.rays, text(r.mraysPerSecond),
                       text(r.bareMraysPerSecond), text(r.ratio), text(r.processorRatio),
                       text(100 * r.disagreeing, 4) + " %"});
    printHeader(out, {"build", "triangles", "s", "MiB"});
    for (const BuildRow& b : report.builds)
        printRow(out, {b.traversal, std::to_string(b.triangles), text(b.seconds, 3),
                       b.bytes ? text(double(b.bytes) / MiB, 1) : ""});
}

void printFrames(std::ostream& out, const std::vector<FrameRow>& frames) {
    printHeader(out, {"picture by", "triangles", "Msamples/s", "Mray/s", "rays/sample", "buffers MiB"});
    for (const FrameRow& f : frames)
        printRow(out,
                 {f.traversal, std::to_string(f.triangles), text(f.msamplesPerSecond), text(f.mraysPerSecond),
                  text(f.raysPerSample, 1), text(double(f.memory.total()) / MiB, 1)});
}

} // namespace

void printTables(std::ostream& out, const Report& report) {
    out << report.device << ", " << report.driver << ", " << report.threads << " threads, load before "
        << text(report.loadBefore, 2) << "; median (least-most) of " << report.repetitions << "\n";
    for (const TraversalReport& t : report.traversals)
        printTraversals(out, t);
    if (!report.frames.empty()) printFrames(out, report.frames);
    if (report.start)
        out << "\nfirst pixel: cold " << text(report.start->coldSeconds) << " s, warm "
            << text(report.start->warmSeconds) << " s; peak memory " << text(report.start->peakMiB, 0)
            << " MiB\n";
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
                                  {"processorRatio", toJson(r.processorRatio)},
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
