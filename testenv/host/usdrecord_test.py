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


def main():
    tool = usd_tool.require("usdrecord")
    from PySide2.QtGui import QImage
    with tempfile.TemporaryDirectory() as folder:
        code, output = usd_tool.run([tool, "--renderer", usd_tool.RENDERER, "--camera", "Front", "--imageWidth", "64",
                                     "--frames", "1:2", usd_tool.SCENE, os.path.join(folder, "out.#.png")])
        print(output)
        if code != 0:
            sys.exit("usdrecord failed with %d" % code)
        images = [QImage(os.path.join(folder, "out.%d.png" % frame)) for frame in (1, 2)]
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


if __name__ == "__main__":
    main()
