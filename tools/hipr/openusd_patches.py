"""What the OpenUSD 20.08 source of the `usd-cpp` crate needs to build on Debian 12, and why.

Each patch replaces one exact piece of text.  Applying a patch twice changes nothing, so that an interrupted
set-up can start over; a piece of text that is neither there nor replaced already is an error, because then
the source is not the one this list was written for.
"""

from dataclasses import dataclass
from pathlib import Path


class PatchError(Exception):
    """The source tree does not look as a patch expects."""


@dataclass(frozen=True)
class Patch:
    file: str     # relative to the root of the OpenUSD source
    reason: str
    old: str
    new: str


_LIBRARY_NAME = ("a precompiled header shared by libraries is read before any of them has a name, so the name must come "
                 "in where a registry function is defined; otherwise libraries that are loaded later register nothing")

PATCHES = (
    Patch(
        "pxr/base/arch/demangle.cpp",
        "<cxxabi.h> is included inside the pxr namespace, which GCC 12's header does not survive",
        "#define _AT_LEAST_GCC_THREE_ONE_OR_CLANG\n#endif\n",
        "#define _AT_LEAST_GCC_THREE_ONE_OR_CLANG\n#include <cxxabi.h>\n#endif\n"),
    Patch(
        "pxr/base/arch/defines.h",
        "TfHashMap would be one class for GCC and another for Clang, so that a delegate compiled by GCC could not link to "
        "libraries compiled by Clang; with a name nobody defines it is the standard container for both",
        "#if defined(ARCH_OS_LINUX) && defined(ARCH_COMPILER_GCC)\n",
        "#if defined(ARCH_OS_LINUX) && defined(HIPR_GNU_HASH_MAP)\n"),
    Patch(
        "pxr/base/work/singularTask.h",
        "size_t is used without a header that declares it",
        "#include <atomic>\n#include <functional>\n",
        "#include <atomic>\n#include <cstddef>\n#include <functional>\n"),
    Patch(
        "pxr/base/tf/registryManager.h",
        _LIBRARY_NAME,
        """struct Tf_RegistryStaticInit {
    Tf_RegistryStaticInit() {
        Tf_RegistryInitCtor(TF_PP_STRINGIZE(MFB_ALT_PACKAGE_NAME));
    }
    ~Tf_RegistryStaticInit() {
        Tf_RegistryInitDtor(TF_PP_STRINGIZE(MFB_ALT_PACKAGE_NAME));
    }
};
""",
        """template <const char* (*Library)()>
struct Tf_RegistryStaticInit {
    Tf_RegistryStaticInit() {
        Tf_RegistryInitCtor(Library());
    }
    ~Tf_RegistryStaticInit() {
        Tf_RegistryInitDtor(Library());
    }
};

#define HIPR_REGISTRY_LIBRARY(NAME)                                            \\
    static const char* NAME() { return TF_PP_STRINGIZE(MFB_ALT_PACKAGE_NAME); }\\
    _ARCH_ENSURE_PER_LIB_INIT(Tf_RegistryStaticInit<NAME>, _tfRegistryInit)
"""),
    Patch(
        "pxr/base/tf/registryManager.h",
        _LIBRARY_NAME,
        """    _ARCH_ENSURE_PER_LIB_INIT(Tf_RegistryStaticInit, _tfRegistryInit);         \\
    static void _Tf_RegistryFunction(KEY_TYPE*, TAG*)
""",
        """    HIPR_REGISTRY_LIBRARY(BOOST_PP_CAT(_Tf_RegistryLibrary, __COUNTER__));      \\
    static void _Tf_RegistryFunction(KEY_TYPE*, TAG*)
"""),
    Patch(
        "pxr/base/tf/registryManager.h",
        _LIBRARY_NAME,
        """    _ARCH_ENSURE_PER_LIB_INIT(Tf_RegistryStaticInit, _tfRegistryInit);         \\
    static void BOOST_PP_CAT(_Tf_RegistryFunction, NAME)(KEY_TYPE*, void*)
""",
        """    HIPR_REGISTRY_LIBRARY(BOOST_PP_CAT(_Tf_RegistryLibrary, __COUNTER__));      \\
    static void BOOST_PP_CAT(_Tf_RegistryFunction, NAME)(KEY_TYPE*, void*)
"""),
    Patch(
        "pxr/base/tf/pyTracing.cpp",
        "PyFrameObject is opaque in Python 3.11; PyFrame_GetCode returns a new reference",
        """    info.funcName = TfPyString_AsString(frame->f_code->co_name);
    info.fileName = TfPyString_AsString(frame->f_code->co_filename);
    info.funcLine = frame->f_code->co_firstlineno;
    info.what = what;

    _InvokeTraceFns(info);
""",
        """    PyCodeObject *code = PyFrame_GetCode(frame);
    info.funcName = TfPyString_AsString(code->co_name);
    info.fileName = TfPyString_AsString(code->co_filename);
    info.funcLine = code->co_firstlineno;
    info.what = what;

    _InvokeTraceFns(info);
    Py_DECREF(code);
"""),
    Patch(
        "pxr/base/arch/mallocHook.cpp",
        "glibc 2.34 dropped these hooks; weak and null they mean 'no hook', and a real allocator may still give them",
        """extern void* (*__MALLOC_HOOK_VOLATILE __malloc_hook)(size_t __size,  const void*);
extern void* (*__MALLOC_HOOK_VOLATILE __realloc_hook)(void* __ptr, size_t __size, const void*);
extern void* (*__MALLOC_HOOK_VOLATILE __memalign_hook)(size_t __alignment, size_t __size, const void*);
extern void (*__MALLOC_HOOK_VOLATILE __free_hook)(void* __ptr,  const void*);
""",
        """#define HIPR_WEAK __attribute__((weak))
HIPR_WEAK void* (*__MALLOC_HOOK_VOLATILE __malloc_hook)(size_t __size,  const void*) = nullptr;
HIPR_WEAK void* (*__MALLOC_HOOK_VOLATILE __realloc_hook)(void* __ptr, size_t __size, const void*) = nullptr;
HIPR_WEAK void* (*__MALLOC_HOOK_VOLATILE __memalign_hook)(size_t __alignment, size_t __size, const void*) = nullptr;
HIPR_WEAK void (*__MALLOC_HOOK_VOLATILE __free_hook)(void* __ptr,  const void*) = nullptr;
"""),
    Patch(
        "pxr/usdImaging/usdImaging/materialAdapter.cpp",
        "a node is marked as visited only after its inputs, so that shaders which feed each other in a circle overflow "
        "the stack of any host; marked before, the delegate receives the circle and reports it",
        """    if (visitedNodes->count(node.path) > 0) {
        return;
    }
""",
        """    if (!visitedNodes->insert(node.path).second) {
        return;
    }
"""),
    Patch(
        "pxr/base/tf/CMakeLists.txt",
        "the crate carries no tests, and these belong to one although they are listed with the Python modules",
        """        testenv/__init__.py
        testenv/testTfScriptModuleLoader_AAA_RaisesError.py
        testenv/testTfScriptModuleLoader_DepLoadsAll.py
        testenv/testTfScriptModuleLoader_LoadsAll.py
        testenv/testTfScriptModuleLoader_LoadsUnknown.py
        testenv/testTfScriptModuleLoader_Other.py
        testenv/testTfScriptModuleLoader_Test.py
        testenv/testTfScriptModuleLoader_Unknown.py
""",
        ""),
    Patch(
        "pxr/imaging/hdx/CMakeLists.txt",
        "the crate carries no images, so this one cannot be installed",
        "        textures/StinsonBeach.exr\n",
        ""),
    Patch(
        "CMakeLists.txt",
        "extras/ holds examples and tutorials, and one of them would be built whatever the options say",
        "add_subdirectory(extras)\n",
        ""),
    Patch(
        "cmake/defaults/Packages.cmake",
        "PySide2 and PyOpenGL are needed to run usdview, not to build it; set-up installs them when usdview is asked for",
        """    # --PySide
    find_package(PySide REQUIRED)
    # --PyOpenGL
    find_package(PyOpenGL REQUIRED)
""",
        """    message(STATUS "usdview's Python modules are looked up when it runs")
"""),
    Patch(
        "pxr/CMakeLists.txt",
        "export(PACKAGE) writes into the user's CMake registry, where other projects would pick this build up",
        "export(PACKAGE pxr)\n",
        ""),
)


def apply(patch: Patch, root: Path) -> bool:
    """Applies one patch below root. Returns whether the file changed."""
    path = root / patch.file
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise PatchError(f"{path}: {error.strerror}") from error
    if patch.new and patch.new in text:
        return False
    if patch.old not in text:
        if patch.new == "":
            return False
        raise PatchError(f"{path}: the text to patch is not there ({patch.reason})")
    path.write_text(text.replace(patch.old, patch.new, 1), encoding="utf-8")
    return True


def apply_all(root: Path) -> int:
    """Applies every patch below root. Returns how many files changed."""
    return sum(apply(patch, root) for patch in PATCHES)
