#include "testenv/edit/edits.h"

#include "plugin/record/edits.h"
#include "plugin/record/failure.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/sdf/namespaceEdit.h"
#include "pxr/usd/sdf/primSpec.h"
#include "pxr/usd/usd/attribute.h"
#include "pxr/usd/usd/editContext.h"
#include "pxr/usd/usd/prim.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

[[noreturn]] void doesNotApply(const std::string& what) {
    throw record::Failure(record::ExitUsage, what);
}

void apply(Scene& scene, const record::Edit& edit) {
    record::applyEdit(scene.stage(), edit);
}

UsdPrim primAt(Scene& scene, const SdfPath& path) {
    const UsdPrim prim = scene.stage()->GetPrimAtPath(path);
    if (!prim || prim.IsInstanceProxy()) doesNotApply("no prim " + path.GetString());
    return prim;
}

} // namespace

Edit usda(const std::string& text) {
    return [text](Scene& scene) {
        record::Edit edit;
        edit.usda = text;
        apply(scene, edit);
    };
}

Edit in(const std::string& prim, const std::string& text) {
    std::string open, close;
    for (const SdfPath& path : SdfPath(prim).GetPrefixes()) {
        open += "over \"" + path.GetName() + "\" {\n";
        close += "\n}";
    }
    const Edit edit = usda(open + text + close);
    return [edit, path = SdfPath(prim)](Scene& scene) {
        primAt(scene, path);
        edit(scene);
    };
}

Edit set(const std::string& property, const VtValue& value) {
    return [path = SdfPath(property), value](Scene& scene) {
        const UsdAttribute attribute = scene.stage()->GetAttributeAtPath(path);
        if (!attribute) doesNotApply("no attribute " + path.GetString());
        const SdfPropertySpecHandleVector specs = attribute.GetPropertyStack();
        if (specs.empty()) doesNotApply("nothing authored at " + path.GetString());
        const UsdEditContext context(scene.stage(), UsdEditTarget(specs.front()->GetLayer()));
        if (!attribute.Set(value)) doesNotApply("cannot set " + path.GetString());
    };
}

Edit removePrim(const std::string& prim) {
    return [path = SdfPath(prim)](Scene& scene) {
        primAt(scene, path);
        SdfBatchNamespaceEdit removal;
        removal.Add(SdfNamespaceEdit::Remove(path));
        for (const SdfLayerHandle& layer : scene.stage()->GetLayerStack())
            if (layer->GetPrimAtPath(path)) layer->Apply(removal);
    };
}

Edit removeProperty(const std::string& property) {
    return [path = SdfPath(property)](Scene& scene) {
        bool found = false;
        for (const SdfLayerHandle& layer : scene.stage()->GetUsedLayers()) {
            const SdfPropertySpecHandle spec = layer->GetPropertyAtPath(path);
            if (!spec) continue;
            TfDynamic_cast<SdfPrimSpecHandle>(spec->GetOwner())->RemoveProperty(spec);
            found = true;
        }
        if (!found) doesNotApply("no property " + path.GetString());
    };
}

Edit rename(const std::string& from, const std::string& to) {
    return [from = SdfPath(from), to = SdfPath(to)](Scene& scene) {
        record::Edit edit;
        edit.rename.emplace_back(from, to);
        apply(scene, edit);
    };
}

Edit retype(const std::string& prim, const std::string& type) {
    return [path = SdfPath(prim), type](Scene& scene) {
        const SdfPrimSpecHandleVector specs = primAt(scene, path).GetPrimStack();
        specs.back()->SetTypeName(type);
    };
}

Edit activate(const std::string& prim, bool active) {
    return [path = SdfPath(prim), active](Scene& scene) {
        record::Edit edit;
        (active ? edit.activate : edit.deactivate).push_back(path);
        apply(scene, edit);
    };
}

Edit select(const std::string& prim, const std::string& set, const std::string& variant) {
    return [=](Scene& scene) {
        record::Edit edit;
        edit.variants.push_back({SdfPath(prim), set, variant});
        apply(scene, edit);
    };
}

Edit mute(const std::string& layer) {
    return [layer](Scene& scene) {
        record::Edit edit;
        edit.mute.push_back(layer);
        apply(scene, edit);
    };
}

Edit unmute(const std::string& layer) {
    return [layer](Scene& scene) {
        record::Edit edit;
        edit.unmute.push_back(layer);
        apply(scene, edit);
    };
}

Edit load(const std::string& prim, bool loaded) {
    return [path = SdfPath(prim), loaded](Scene& scene) {
        primAt(scene, path);
        if (loaded)
            scene.stage()->Load(path);
        else
            scene.stage()->Unload(path);
    };
}

Edit view(const std::function<void(View&)>& change) {
    return [change](Scene& scene) { change(scene.view); };
}

Edit time(double frame) {
    return view([frame](View& v) { v.time = frame; });
}

Edit setting(const std::string& name, const VtValue& value) {
    return view([=](View& v) { v.settings[name] = value; });
}

Edit all(std::vector<Edit> edits) {
    return [edits = std::move(edits)](Scene& scene) {
        for (const Edit& edit : edits)
            edit(scene);
    };
}

} // namespace hipr::test
