// The results of splat_bench.h as tables for people and as JSON for machines.
#include <ostream>

#include "testenv/bench/splat_bench.h"

namespace hipr::bench {

namespace {

using bench::text; // what follows would hide it

std::string text(const Spread& s) {
    return text(s, 1);
}

std::string text(glm::uvec2 size) {
    return std::to_string(size.x) + "x" + std::to_string(size.y);
}

std::string share(double part) {
    return text(100 * part, 1) + " %";
}

std::string stages(const SplatStatistics& s) {
    std::string all;
    for (const SplatStatistics::Stage& stage : s.stages)
        all += (all.empty() ? "" : ", ") + std::string(stage.name) + " " + text(stage.processorMs, 1);
    return all;
}

void printMove(std::ostream& out, const SplatMoveRow& m) {
    out << "\nA prim in " << share(m.covered) << " of the macro-tiles moves (" << m.mode << ", "
        << text(m.size) << "): " << share(m.drawn) << " drawn again, " << text(m.movedMs) << " ms against "
        << text(m.wholeMs) << " for a whole frame: " << text(m.movedMs.median / m.wholeMs.median, 2)
        << "; processor " << text(m.movedProcessorMs) << " against " << text(m.wholeProcessorMs) << ": "
        << text(m.movedProcessorMs.median / m.wholeProcessorMs.median, 2) << "\n";
}

} // namespace

void printSplats(std::ostream& out, const SplatReport& r) {
    const double splats = double(std::max<size_t>(r.splats, 1));
    out << "\n" << r.scene << ": " << r.splats << " splats of degree " << r.degree << "; ";
    if (r.loadSeconds > 0) out << "read in " << text(r.loadSeconds, 2) << " s, ";
    out << "copied to the device in " << text(r.storeSeconds, 2) << " s, "
        << text(double(r.storeBytes) / splats, 0) << " bytes a splat there, "
        << text(double(r.deviceBytes) / splats, 0) << " with all buffers ("
        << text(double(r.deviceBytes) / MiB, 0) << " MiB); peak memory " << text(r.peakMiB, 0) << " MiB\n\n"
        << "| size | mode | visible | pairs | longest list | sorting moves MB | blends tried, done M | frame "
           "ms | processor ms "
           "| stages, processor ms |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const SplatRow& row : r.rows) {
        const SplatStatistics& s = row.statistics;
        out << "| " << text(row.size) << " | " << row.mode << " | " << s.visible << " | " << s.pairs << " | "
            << s.largestList << " | " << text(double(s.sortBytes) / 1e6, 1) << " | "
            << text(double(s.blendsTried) / 1e6, 1) << ", " << text(double(s.blendsDone) / 1e6, 1) << " | "
            << text(row.frameMs) << " | " << text(row.processorMs) << " | " << stages(s) << " |\n";
    }
    if (r.moved) printMove(out, *r.moved);
}

namespace {

nlohmann::json toJson(glm::uvec2 size) {
    return {size.x, size.y};
}

nlohmann::json toJson(const SplatRow& row) {
    const SplatStatistics& s = row.statistics;
    nlohmann::json stages = nlohmann::json::object();
    for (const SplatStatistics::Stage& stage : s.stages)
        stages[stage.name] = {{"ms", stage.ms}, {"processorMs", stage.processorMs}};
    return {{"mode", row.mode},
            {"size", toJson(row.size)},
            {"frameMs", bench::toJson(row.frameMs)},
            {"processorMs", bench::toJson(row.processorMs)},
            {"visible", s.visible},
            {"pairs", s.pairs},
            {"largestList", s.largestList},
            {"batches", s.batches},
            {"sortBytes", s.sortBytes},
            {"partialBytes", s.partialBytes},
            {"blendsTried", s.blendsTried},
            {"blendsDone", s.blendsDone},
            {"stages", stages}};
}

nlohmann::json toJson(const SplatMoveRow& m) {
    return {{"mode", m.mode},
            {"size", toJson(m.size)},
            {"covered", m.covered},
            {"drawn", m.drawn},
            {"wholeMs", bench::toJson(m.wholeMs)},
            {"movedMs", bench::toJson(m.movedMs)},
            {"wholeProcessorMs", bench::toJson(m.wholeProcessorMs)},
            {"movedProcessorMs", bench::toJson(m.movedProcessorMs)}};
}

} // namespace

nlohmann::json toJson(const SplatReport& r) {
    nlohmann::json rows = nlohmann::json::array();
    for (const SplatRow& row : r.rows)
        rows.push_back(toJson(row));
    nlohmann::json all = {{"scene", r.scene},
                          {"splats", r.splats},
                          {"degree", r.degree},
                          {"loadSeconds", r.loadSeconds},
                          {"storeSeconds", r.storeSeconds},
                          {"storeBytes", r.storeBytes},
                          {"deviceBytes", r.deviceBytes},
                          {"peakMiB", r.peakMiB},
                          {"rows", rows}};
    if (r.moved) all["moved"] = toJson(*r.moved);
    return all;
}

} // namespace hipr::bench
