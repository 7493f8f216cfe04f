"""The usdrecord of the OpenUSD install draws through the delegate."""

import os
import sys
import tempfile

import usd_tool


def expect(image, name, x, y, colour):
    pixel = image.pixelColor(int(x * image.width()), int(y * image.height()))
    got = usd_tool.colour_name(pixel.red(), pixel.green(), pixel.blue())
    if got != colour:
        sys.exit("%s at (%g, %g): %s, expected %s (%d %d %d, alpha %d)" % (
            name, x, y, got, colour, pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()))


def record(scene, camera, width, frames=None):
    """Records a scene; returns the pictures, one a frame, and what the tool printed."""
    tool = usd_tool.require("usdrecord")
    from PySide2.QtGui import QImage
    with tempfile.TemporaryDirectory() as folder:
        arguments = [tool, "--renderer", usd_tool.RENDERER, "--camera", camera, "--imageWidth", str(width)]
        names = ["out.%d.png" % frame for frame in frames] if frames else ["out.png"]
        if frames:
            arguments += ["--frames", "%d:%d" % (frames[0], frames[-1])]
        output = os.path.join(folder, "out.#.png" if frames else "out.png")
        code, text = usd_tool.run(arguments + [scene, output])
        print(text)
        if code != 0:
            sys.exit("usdrecord failed with %d for %s" % (code, scene))
        return [QImage(os.path.join(folder, name)) for name in names], text


def check_frames():
    images, _ = record(usd_tool.SCENE, "Front", 64, (1, 2))
    for index, image in enumerate(images):
        name = "frame %d" % (index + 1)
        if image.width() != 64 or image.height() != 64:
            sys.exit("%s is %d x %d" % (name, image.width(), image.height()))
        expect(image, name, 0.25, 0.5, "red")
        expect(image, name, 0.5, 0.125, "blue")
        expect(image, name, 0.05, 0.05, "grey")
    expect(images[0], "frame 1", 0.75, 0.45, "green")
    expect(images[0], "frame 1", 0.75, 0.75, "grey")
    expect(images[1], "frame 2", 0.75, 0.45, "grey")
    expect(images[1], "frame 2", 0.75, 0.75, "green")


def check_cyclic_material():
    """Shaders that feed each other in a circle: one message about them, and everything else is drawn."""
    if not os.path.isdir(os.path.join(os.environ["HIPR_USD_PREFIX"], "share", "hipr")):
        print("not checked: this OpenUSD was not built by ./hipr, and cyclic materials may end 20.08's own recursion")
        return
    scene = os.path.join(usd_tool.HERE, "..", "scenes", "bad_input", "cyclic_material", "scene.usda")
    (image,), text = record(scene, "Camera", 96)
    expect(image, "cyclic material", 1 / 6, 0.5, "red")
    expect(image, "cyclic material", 0.5, 0.5, "blue")
    expect(image, "cyclic material", 5 / 6, 0.5, "mixed")  # the texture's pale red at (0, 0)
    told = [line for line in text.splitlines() if "/World/Looks/Broken" in line and "has a cycle" in line]
    if len(told) != 1:
        sys.exit("the circle is named in %d lines instead of 1" % len(told))


def main():
    check_frames()
    check_cyclic_material()


if __name__ == "__main__":
    main()
