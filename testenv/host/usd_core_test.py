"""Our splats through the schema classes of OpenUSD 26.03 and later, and theirs through ours.

HIPR_USD_CORE_PYTHON names a Python that has usd-core 26.3 or later (a venv of its own: `pip install usd-core`); the
test is skipped without it. The same file is the worker that runs there.
"""

import os
import subprocess
import sys
import tempfile

SKIP = 77  # ctest's SKIP_RETURN_CODE of this test
WORDS = ("object", "splats")  # what of a scene dump is compared

PLY = """ply
format ascii 1.0
element vertex 2
{}
end_header
1 2 3  0.5 0.25 -0.5  -1 -2 -3  0 1 0 0  0.5  {}
-1 0 0.5  0 0 1  -1 -1 -1  1 0 0 0  -2  {}
"""


def worker_check(path):
    """Reads a file of ours with UsdVol's own classes."""
    from pxr import Usd, UsdGeom, UsdVol
    stage = Usd.Stage.Open(path)
    prim = stage.GetDefaultPrim()
    assert prim.IsA(UsdVol.ParticleField3DGaussianSplat), prim.GetTypeName()
    definition = prim.GetPrimDefinition()
    for attribute in prim.GetAuthoredAttributes():
        known = definition.GetSchemaAttributeSpec(attribute.GetName())
        assert known, "%s is no attribute of the schema" % attribute.GetName()
        assert known.typeName == attribute.GetTypeName(), attribute.GetName()
        authored = stage.GetRootLayer().GetAttributeAtPath(attribute.GetPath())
        assert known.variability == authored.variability, attribute.GetName()
    positions = UsdVol.ParticleFieldPositionAttributeAPI(prim).GetPositionsAttr().Get()
    assert [tuple(p) for p in positions] == [(1, 2, 3), (-1, 0, 0.5)], positions
    orientations = UsdVol.ParticleFieldOrientationAttributeAPI(prim).GetOrientationsAttr().Get()
    assert orientations[0].real == 0 and tuple(orientations[0].imaginary) == (1, 0, 0), orientations
    assert len(UsdVol.ParticleFieldScaleAttributeAPI(prim).GetScalesAttr().Get()) == 2
    opacities = UsdVol.ParticleFieldOpacityAttributeAPI(prim).GetOpacitiesAttr().Get()
    assert abs(opacities[0] - 0.6224593) < 1e-6, opacities
    harmonics = UsdVol.ParticleFieldSphericalHarmonicsAttributeAPI(prim)
    assert harmonics.GetRadianceSphericalHarmonicsDegreeAttr().Get() == 1
    coefficients = harmonics.GetRadianceSphericalHarmonicsCoefficientsAttr().Get()
    assert len(coefficients) == 8 and tuple(coefficients[0]) == (0.5, 0.25, -0.5), coefficients
    assert tuple(coefficients[1]) == (1, 4, 7), coefficients  # channel by channel in the capture
    box = UsdGeom.BBoxCache(0, ["default"]).ComputeWorldBound(prim).ComputeAlignedRange()
    assert box.Contains((1, 2, 3)) and box.Contains((-1, 0, 0.5)), box


def worker_write(source, folder):
    """Writes stages with UsdVol's classes: the values of `source`; halves; and the same numbers as floats."""
    from pxr import Gf, Usd, UsdVol, Vt

    def define(name):
        stage = Usd.Stage.CreateNew(os.path.join(folder, name))
        prim = UsdVol.ParticleField3DGaussianSplat.Define(stage, "/Splats").GetPrim()
        stage.SetDefaultPrim(prim)
        return stage, prim

    stage, prim = define("theirs.usda")
    original = Usd.Stage.Open(source)
    for attribute in original.GetDefaultPrim().GetAuthoredAttributes():
        assert prim.GetAttribute(attribute.GetName()).Set(attribute.Get()), attribute.GetName()
    stage.Save()

    singles = {"positions": Vt.Vec3fArray([(1, 2, 3), (4, 5, 6)]),
               "orientations": Vt.QuatfArray([Gf.Quatf(0, 1, 0, 0), Gf.Quatf(1, 0, 0, 0)]),
               "scales": Vt.Vec3fArray([(0.5, 0.25, 1), (1, 1, 1)]), "opacities": Vt.FloatArray([0.5, 0.25]),
               "radiance:sphericalHarmonicsCoefficients": Vt.Vec3fArray([(0.5, 0, -0.5), (0.25, 1, 2)])}
    halves = {"positions": Vt.Vec3hArray([Gf.Vec3h(1, 2, 3), Gf.Vec3h(4, 5, 6)]),
              "orientations": Vt.QuathArray([Gf.Quath(0, 1, 0, 0), Gf.Quath(1, 0, 0, 0)]),
              "scales": Vt.Vec3hArray([Gf.Vec3h(0.5, 0.25, 1), Gf.Vec3h(1, 1, 1)]),
              "opacities": Vt.HalfArray([0.5, 0.25]),
              "radiance:sphericalHarmonicsCoefficients":
                  Vt.Vec3hArray([Gf.Vec3h(0.5, 0, -0.5), Gf.Vec3h(0.25, 1, 2)])}
    for file, values, suffix in (("singles.usda", singles, ""), ("halves.usda", halves, "h")):
        stage, prim = define(file)
        for name, value in values.items():
            assert prim.GetAttribute(name + suffix).Set(value), name + suffix
        prim.GetAttribute("radiance:sphericalHarmonicsDegree").Set(0)
        prim.GetAttribute("sortingModeHint").Set("cameraDistance")
        prim.GetAttribute("projectionModeHint").Set("tangential")
        stage.Save()


def run(arguments):
    result = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True)
    if result.returncode != 0:
        sys.exit("%s failed with %d:\n%s" % (" ".join(arguments), result.returncode, result.stdout))


def scene(stage, folder):
    """What our renderer holds of a stage."""
    dump = os.path.join(folder, "dump.txt")
    run([os.environ["HIPR_RECORD_PROGRAM"], stage, "-o", os.path.join(folder, "out.exr"), "--size", "16x16",
         "--samples", "1", "--dump-scene", dump])
    with open(dump) as lines:
        return [line for line in lines if line.startswith(WORDS)]


def main():
    os.environ.pop("PXR_PLUGINPATH_NAME", None)  # plugins of another OpenUSD are not for usd-core
    python = os.environ.get("HIPR_USD_CORE_PYTHON", "")
    probe = "import sys; from pxr import Usd; sys.exit(0 if Usd.GetVersion()[1:] >= (26, 3) else 1)"
    if not python or subprocess.run([python, "-c", probe], stderr=subprocess.DEVNULL).returncode != 0:
        print("skipped: HIPR_USD_CORE_PYTHON names no Python with usd-core 26.3 or later")
        sys.exit(SKIP)
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2",
             "rot_3", "opacity"] + ["f_rest_%d" % i for i in range(9)]
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        with open(path("in.ply"), "w") as out:
            out.write(PLY.format("\n".join("property float " + name for name in names),
                                 " ".join(str(i) for i in range(1, 10)), " ".join("0" * 9)))
        for name in ("ours.usda", "ours.usdc"):
            run([os.environ["HIPR_CONVERT_PROGRAM"], path("in.ply"), path(name)])
            run([python, __file__, "check", path(name)])
        run([python, __file__, "write", path("ours.usda"), folder])
        ours, theirs = scene(path("ours.usda"), folder), scene(path("theirs.usda"), folder)
        assert any(line.startswith("splats /Splats positions 2") for line in ours), ours
        assert ours == theirs, "theirs differs:\n" + "".join(ours + theirs)
        singles, halves = scene(path("singles.usda"), folder), scene(path("halves.usda"), folder)
        assert singles == halves, "halves differ:\n" + "".join(singles + halves)
        assert "splats /Splats sorting 1\n" in singles and "splats /Splats projection 1\n" in singles, singles
    print("ok")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        {"check": worker_check, "write": worker_write}[sys.argv[1]](*sys.argv[2:])
    else:
        main()
