/// @file edits.h
/// Edits of a scene as values, and the table of all of them.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "pxr/base/vt/value.h"
#include "testenv/edit/scene.h"

namespace hipr::test {

/// Changes a scene. Throws record::Failure when the scene, after other edits, has not what it wants to
/// change.
using Edit = std::function<void(Scene&)>;

/// Opinions to add, authored over all others; see record::applyEdit.
Edit usda(const std::string& text);
/// `text` put into overs down to a prim: in("/World/Geo/Plain", "bool doubleSided = true").
Edit in(const std::string& prim, const std::string& text);
/// Sets the property in the layer that has the strongest opinion now, as a program with the file open does.
Edit set(const std::string& property, const PXR_NS::VtValue& value);
Edit removePrim(const std::string& prim);
Edit removeProperty(const std::string& property);
/// New name or new parent, or both.
Edit rename(const std::string& from, const std::string& to);
Edit retype(const std::string& prim, const std::string& type);
Edit activate(const std::string& prim, bool active);
Edit select(const std::string& prim, const std::string& set, const std::string& variant);
Edit mute(const std::string& layer);
Edit unmute(const std::string& layer);
Edit load(const std::string& prim, bool loaded);
Edit view(const std::function<void(View&)>& change);
Edit time(double frame);
Edit setting(const std::string& name, const PXR_NS::VtValue& value);
/// One after the other, in one go.
Edit all(std::vector<Edit> edits);

/// One line of the table.
struct Row {
    std::string name; ///< for gtest: letters and digits
    Edit edit;
    Edit before = {};  ///< another edit, shown first
    bool shows = true; ///< false: the edit must leave the picture as it is
    /// Why UsdImaging of OpenUSD 20.08 does not tell the delegate of this edit; empty: it does.
    std::string untold = {};
    /// The same for taking the edit back.
    std::string backUntold = {};
};
using Rows = std::vector<Row>;
/// For gtest's messages.
inline void PrintTo(const Row& row, std::ostream* out) {
    *out << row.name;
}

Rows meshRows();
Rows shapeRows(); ///< curves and points
Rows splatRows();
Rows volumeRows(); ///< none without OpenVDB
Rows primvarRows();
Rows materialRows();
Rows textureRows();
Rows lightRows();
Rows instanceRows();
Rows hierarchyRows();
Rows timeRows();
Rows viewRows();

/// All of the above, by unique name.
const Rows& allRows();

} // namespace hipr::test
