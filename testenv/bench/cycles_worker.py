"""Renders a USD scene with Cycles; runs in the Python environment that has bpy. driven by compare_cycles.py.

Arguments: SCENE WIDTH HEIGHT DEPTH. Then one line a job on standard input, "SAMPLES SEED" or "SAMPLES SEED PICTURE.exr";
the answer is one line on standard output: "RESULT <seconds> <processor seconds>", and with a picture its mean luminance.
"""

import sys
import time

import bpy


def load(scene_path, width, height, depth):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=scene_path, import_usd_preview=True)
    scene = bpy.context.scene
    scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_persistent_data = False  # with it a second picture keeps the first one's number of samples
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    cycles.device = "CPU"
    # Plain path tracing: every sample is traced, nothing is clamped, filtered or guessed.
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_light_tree = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    # Cycles counts bounces behind the first surface; Russian roulette may end paths from the third on, as in HiPR.
    for limit in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, f"{limit}_bounces", depth - 1)
    cycles.transparent_max_bounces = 64
    cycles.min_light_bounces = 3
    return scene


def mean_luminance(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    pixels = image.pixels[:]
    count = len(pixels) // 4
    return sum(0.2126 * pixels[4 * i] + 0.7152 * pixels[4 * i + 1] + 0.0722 * pixels[4 * i + 2]
               for i in range(count)) / count


def main():
    scene = load(sys.argv[1], *map(int, sys.argv[2:5]))
    for line in sys.stdin:
        samples, seed, *picture = line.split(maxsplit=2)
        scene.cycles.samples, scene.cycles.seed = int(samples), int(seed)
        if picture:
            scene.render.filepath = picture[0].strip()
        start, start_cpu = time.perf_counter(), time.process_time()
        bpy.ops.render.render(write_still=bool(picture))
        answer = f"RESULT {time.perf_counter() - start} {time.process_time() - start_cpu}"
        if picture:
            answer += f" {mean_luminance(scene.render.filepath)}"
        print(answer, flush=True)


main()
