#!/usr/bin/env python3
"""What texture filtering does to noise and to sharpness, and what it costs.

Usage: texture_filter.py HIPRRECORD [SAMPLES ...]

Needs NumPy and OpenEXR. Four pictures of 160 x 90 pixels: `plane`, a floor of black and white squares of two texels up to
the horizon, lit by a sky; `text`, a sheet of lines seen from so near that a texel is a pixel or more; `grazing`, the sheet seen along the ground; `mirrors`, balls,
smooth and rough, over the floor. The error is that against 1024 samples without filtering, relative to the mean.
"""
import os
import resource
import subprocess
import sys
import tempfile

REFERENCE = 1024
SIZE = "160x90"

STAGE = """#usda 1.0
(
    upAxis = "Z"
)
def Xform "World"
{{
    def Camera "Camera"
    {{
        float focalLength = 28
        float2 clippingRange = (0.01, 100000)
        double3 xformOp:translate = {eye}
        float xformOp:rotateX = {tilt}
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
    }}
    def DomeLight "Sky"
    {{
        float inputs:intensity = {sky}
    }}
    def Mesh "Floor"
    {{
        rel material:binding = </World/Paper>
        uniform token subdivisionScheme = "none"
        point3f[] points = [(-{side}, -{side}, 0), ({side}, -{side}, 0), ({side}, {side}, 0), (-{side}, {side}, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        texCoord2f[] primvars:st = [(0, 0), ({repeat}, 0), ({repeat}, {repeat}), (0, {repeat})] (
            interpolation = "vertex"
        )
    }}
    def Material "Paper"
    {{
        token outputs:surface.connect = </World/Paper/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            float inputs:roughness = 1
            color3f inputs:{input}.connect = </World/Paper/Picture.outputs:rgb>
            token outputs:surface
        }}
        def Shader "Picture"
        {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @{picture}@
            token inputs:sourceColorSpace = "raw"
            token inputs:wrapS = "repeat"
            token inputs:wrapT = "repeat"
            float2 inputs:st.connect = </World/Paper/Coordinates.outputs:result>
            float3 outputs:rgb
        }}
        def Shader "Coordinates"
        {{
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }}
    }}
{more}}}
"""

BALL = """    def Sphere "Ball{i}"
    {{
        rel material:binding = </World/Metal{i}>
        double radius = 1
        double3 xformOp:translate = ({x}, 4, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def Material "Metal{i}"
    {{
        token outputs:surface.connect = </World/Metal{i}/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            float inputs:roughness = {roughness}
            float inputs:metallic = 1
            token outputs:surface
        }}
    }}
"""


def write_pictures(folder):
    import numpy
    from PIL import Image
    squares = (((numpy.indices((64, 64)) // 2).sum(0)) % 2 * 200 + 20).astype(numpy.uint8)
    Image.fromarray(squares).convert("RGB").save(os.path.join(folder, "squares.png"))
    random = numpy.random.default_rng(1)
    lines = numpy.full((256, 256), 230, numpy.uint8)
    for row in range(4, 252, 8):
        for column in range(4, 252, 5):
            glyph = random.integers(0, 2, (5, 3), numpy.uint8) * 210
            lines[row:row + 5, column:column + 3] -= glyph
    Image.fromarray(lines).convert("RGB").save(os.path.join(folder, "text.png"))


def stages(folder):
    balls = "".join(BALL.format(i=i, x=2.4 * (i - 1), roughness=r) for i, r in enumerate((0.02, 0.2, 0.5)))
    return {
        "plane": STAGE.format(eye="(0, 0, 1.5)", tilt=80, side=2000, repeat=1000, picture="squares.png", input="emissiveColor", sky=0, more=""),
        "text": STAGE.format(eye="(0, 0, 1.5)", tilt=20, side=1, repeat=1, picture="text.png", input="emissiveColor", sky=0, more=""),
        "grazing": STAGE.format(eye="(0, 0, 0.25)", tilt=78, side=2, repeat=4, picture="text.png", input="emissiveColor", sky=0,
                                more=""),
        "mirrors": STAGE.format(eye="(0, -3, 2)", tilt=80, side=40, repeat=40, picture="squares.png", input="diffuseColor", sky=1, more=balls),
    }


def render(recorder, stage, picture, samples, filtering):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([recorder, stage, "--camera", "/World/Camera", "--size", SIZE, "--samples", str(samples), "-o", picture,
                    "--set", f"hipr:textureFiltering={filtering}"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def pixels(picture):
    import OpenEXR
    with OpenEXR.File(picture) as file:
        channels = file.channels()
        return (channels["RGBA"] if "RGBA" in channels else channels["RGB"]).pixels[..., :3].astype("float64")


def main():
    recorder, counts = sys.argv[1], [int(n) for n in sys.argv[2:]] or [1, 4, 16, 64, 256]
    keep = os.environ.get("TEXTURE_FILTER_OUT")
    with tempfile.TemporaryDirectory() as temporary:
        folder = keep or temporary
        write_pictures(folder)
        for name, text in stages(folder).items():
            stage = os.path.join(folder, name + ".usda")
            with open(stage, "w") as file:
                file.write(text)
            reference = os.path.join(folder, f"{name}.reference.exr")
            if not os.path.exists(reference):
                render(recorder, stage, reference, REFERENCE, "false")
            truth = pixels(reference)
            print(f"{name:10}{'samples':>8}{'error off':>11}{'on':>8}{'mean off':>11}{'on':>8}{'s off':>8}{'on':>8}")
            for samples in counts:
                row = {}
                for filtering in ("false", "true"):
                    picture = os.path.join(folder, f"{name}.{samples}.{filtering}.exr")
                    seconds = render(recorder, stage, picture, samples, filtering)
                    seen = pixels(picture)
                    row[filtering] = (((seen - truth) ** 2).mean() ** 0.5 / truth.mean(), seen.mean() / truth.mean(), seconds)
                (e0, m0, s0), (e1, m1, s1) = row["false"], row["true"]
                print(f"{'':10}{samples:8}{e0:11.4f}{e1:8.4f}{m0:11.4f}{m1:8.4f}{s0:8.2f}{s1:8.2f}", flush=True)


if __name__ == "__main__":
    main()
