/// @file test_warnings.h
/// What a host's users read.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "pxr/base/tf/diagnosticMgr.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Collects Tf's warnings and errors while it lives.
class TestWarnings {
public:
    TestWarnings() { TfDiagnosticMgr::GetInstance().AddDelegate(&_route); }
    ~TestWarnings() { TfDiagnosticMgr::GetInstance().RemoveDelegate(&_route); }
    TestWarnings(TestWarnings const&) = delete;
    TestWarnings& operator=(TestWarnings const&) = delete;

    std::vector<std::string> texts() {
        std::lock_guard<std::mutex> lock(_route.mutex);
        return _route.texts;
    }

private:
    struct Route final : TfDiagnosticMgr::Delegate {
        void add(std::string const& text) {
            std::lock_guard<std::mutex> lock(mutex);
            texts.push_back(text);
        }
        void IssueError(TfError const& error) override { add(error.GetCommentary()); }
        void IssueFatalError(TfCallContext const&, std::string const& text) override { add(text); }
        void IssueStatus(TfStatus const&) override {}
        void IssueWarning(TfWarning const& warning) override { add(warning.GetCommentary()); }
        std::mutex mutex;
        std::vector<std::string> texts;
    };
    Route _route;
};

PXR_NAMESPACE_CLOSE_SCOPE
