/// @file documents.h
/// MaterialX documents of a test, opened as layers.
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pxr/base/plug/registry.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/layer.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_OPEN_SCOPE

class MtlxDocuments : public testing::Test {
protected:
    MtlxDocuments() {
        PlugRegistry::GetInstance().RegisterPlugins(HIPR_PLUGIN_DIR "/hiprMtlx/resources");
        _folder =
            std::filesystem::path(testing::TempDir()) / ("mtlx_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(_folder);
    }
    ~MtlxDocuments() override { std::filesystem::remove_all(_folder); }

    /// Writes a file and returns its path.
    std::string file(std::string const& name, std::string const& content) const {
        const std::filesystem::path path = _folder / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << content;
        return path.string();
    }
    /// Opens what stands between the tags of a document.
    SdfLayerRefPtr open(std::string const& elements,
                        std::string const& attributes = "version=\"1.38\"") const {
        return SdfLayer::FindOrOpen(file("a.mtlx", "<?xml version=\"1.0\"?>\n<materialx " + attributes + ">" +
                                                       elements + "</materialx>"));
    }
    static std::string textOf(SdfLayerRefPtr const& layer) {
        std::string text;
        EXPECT_TRUE(layer && layer->ExportToString(&text));
        return text;
    }
    /// The same of a layer that is written as text: another order of words is no difference.
    static std::string textOf(std::string const& usda) {
        const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous(".usda");
        EXPECT_TRUE(layer->ImportFromString("#usda 1.0\n" + usda)) << usda;
        return textOf(layer);
    }
    /// A layer with nothing below /MaterialX but these prims and /MaterialX/Materials.
    static std::string materialX(std::string const& graphs, std::string const& materials = "") {
        const std::string scope =
            graphs.empty() ? "" : "def NodeGraph \"NodeGraphs\"\n{\n" + graphs + "\n}\n";
        return textOf("(\n    defaultPrim = \"MaterialX\"\n)\ndef \"MaterialX\"\n{\n" + scope +
                      "def \"Materials\"\n{\n" + materials + "\n}\n}\n");
    }

private:
    std::filesystem::path _folder;
};

PXR_NAMESPACE_CLOSE_SCOPE
