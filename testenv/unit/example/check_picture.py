"""Checks the picture of docs/example.cpp: a lit red ball on a grey floor, its shadow to the left, black above."""
import sys


def read_ppm(path):
    with open(path, "rb") as file:
        magic, size, depth = (file.readline().split() for _ in range(3))
        assert magic == [b"P6"] and depth == [b"255"], "not an 8-bit PPM"
        width, height = map(int, size)
        data = file.read()
    assert len(data) == 3 * width * height, "truncated"
    return width, height, data


def mean(picture, x0, y0, x1, y1):
    """Mean colour of a rectangle given in fractions of the picture, from its top left corner."""
    width, height, data = picture
    total, count = [0, 0, 0], 0
    for y in range(int(y0 * height), int(y1 * height)):
        for x in range(int(x0 * width), int(x1 * width)):
            offset = 3 * (y * width + x)
            total = [t + c for t, c in zip(total, data[offset : offset + 3])]
            count += 1
    return [t / count for t in total]


picture = read_ppm(sys.argv[1])
assert picture[:2] == (320, 240), f"size {picture[:2]}"
sky = mean(picture, 0.0, 0.0, 1.0, 0.02)
ball = mean(picture, 0.5, 0.38, 0.56, 0.46)
floor = mean(picture, 0.7, 0.75, 0.9, 0.9)
shadow = mean(picture, 0.3, 0.62, 0.36, 0.66)
print(f"sky {sky}\nball {ball}\nfloor {floor}\nshadow {shadow}")
assert max(sky) < 1, "nothing lights the sky"
assert ball[0] > 60 and ball[0] > 1.5 * ball[1] > 0, "the ball is red and lit"
assert min(floor) > 60 and max(floor) - min(floor) < 12, "the floor is lit and grey"
assert max(shadow) < 0.75 * max(floor), "the ball casts a shadow away from the light"
