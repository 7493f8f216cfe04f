"""Writes node_values.inl: what pattern nodes of MaterialX must give, computed here in double precision.

From the formulas of the MaterialX specification and its published node graphs; the noise from B. Jenkins' lookup3 and
the description of MaterialX's noise nodes. Shares nothing with the renderer. Run: node_values.py > node_values.inl
"""
import math


def spread(v, n=4):
    return tuple([v] * n) if not isinstance(v, (tuple, list)) else tuple(v)


def each(f, *a):
    a = [spread(x) for x in a]
    return tuple((f(*x) for x in zip(*a)))


rows = []


def row(id, ins, exp, out="out", text=()):
    rows.append((id, ins, exp, out, text))


LEFT = (0.3, -1.25, 2.5, 0.75)
RIGHT = (0.6, 0.5, -2.0, 4.0)
row("add_vector4", {"in1": LEFT, "in2": RIGHT}, each(lambda x, y: x + y, LEFT, RIGHT))
row("add_color3FA", {"in1": LEFT[:3], "in2": 0.5}, each(lambda x: x + 0.5, LEFT)[:3])
row("subtract_vector4", {"in1": LEFT, "in2": RIGHT}, each(lambda x, y: x - y, LEFT, RIGHT))
row("multiply_vector4", {"in1": LEFT, "in2": RIGHT}, each(lambda x, y: x * y, LEFT, RIGHT))
row("divide_vector4", {"in1": LEFT, "in2": RIGHT}, each(lambda x, y: x / y, LEFT, RIGHT))
row("divide_float", {"in1": 1.0, "in2": 0.0}, (0.0,))
row("modulo_vector4", {"in1": LEFT, "in2": RIGHT}, each(lambda x, y: x - y * math.floor(x / y), LEFT, RIGHT))
row("power_float", {"in1": 0.3, "in2": 2.2}, (0.3 ** 2.2,))
row("power_float", {"in1": -2.0, "in2": 3.0}, (-8.0,))
row("power_float", {"in1": 0.0, "in2": 2.0}, (0.0,))
row("safepower_float", {"in1": -2.0, "in2": 0.5}, (-math.sqrt(2),))
row("min_vector4", {"in1": LEFT, "in2": RIGHT}, each(min, LEFT, RIGHT))
row("max_vector4", {"in1": LEFT, "in2": RIGHT}, each(max, LEFT, RIGHT))
row("absval_vector4", {"in": LEFT}, each(abs, LEFT))
row("floor_vector4", {"in": LEFT}, each(math.floor, LEFT))
row("ceil_vector4", {"in": LEFT}, each(math.ceil, LEFT))
row("round_vector4", {"in": (0.3, -1.25, 2.7, 0.75)}, (0, -1, 3, 1))
row("fract_vector4", {"in": LEFT}, each(lambda x: x - math.floor(x), LEFT))
row("sign_vector4", {"in": (0.0, -1.25, 2.5, 0.0)}, (0, -1, 1, 0))
row("sin_vector4", {"in": LEFT}, each(math.sin, LEFT))
row("cos_vector4", {"in": LEFT}, each(math.cos, LEFT))
row("tan_vector4", {"in": LEFT}, each(math.tan, LEFT))
UNITS = (0.3, -0.7, 1.0, 0.0)
row("asin_vector4", {"in": UNITS}, each(math.asin, UNITS))
row("acos_vector4", {"in": UNITS}, each(math.acos, UNITS))
row("atan2_vector4", {"iny": LEFT, "inx": RIGHT}, each(math.atan2, LEFT, RIGHT))
row("atan2_float", {"in1": 0.5, "in2": -0.25}, (math.atan2(0.5, -0.25),))
row("sqrt_vector4", {"in": (0.3, 0.0, 2.5, 4.0)}, each(math.sqrt, (0.3, 0.0, 2.5, 4.0)))
row("ln_vector4", {"in": (0.3, 1.0, 2.5, 4.0)}, each(math.log, (0.3, 1.0, 2.5, 4.0)))
row("exp_vector4", {"in": LEFT}, each(math.exp, LEFT))
row("invert_color3", {"in": (0.2, 0.5, 0.9)}, (0.8, 0.5, 0.1))
row("invert_color3FA", {"in": (0.2, 0.5, 0.9), "amount": 2.0}, (1.8, 1.5, 1.1))
row("clamp_vector3FA", {"in": (-0.5, 0.5, 3.0), "low": 0.25, "high": 2.0}, (0.25, 0.5, 2.0))
row("trianglewave_float", {"in": 1.3}, (0.3,))
row("trianglewave_float", {"in": -0.8}, (0.2,))


def norm(v):
    l = math.sqrt(sum((x * x for x in v)))
    return tuple((x / l for x in v))


row("normalize_vector3", {"in": (1.0, -2.0, 2.0)}, (1 / 3, -2 / 3, 2 / 3))
row("normalize_vector2", {"in": (3.0, 4.0)}, (0.6, 0.8))
row("magnitude_vector3", {"in": (1.0, -2.0, 2.0)}, (3.0,))
row("magnitude_vector2", {"in": (3.0, 4.0)}, (5.0,))
row("distance_vector3", {"in1": (1.0, 1.0, 1.0), "in2": (2.0, 3.0, 3.0)}, (3.0,))
row("dotproduct_vector2", {"in1": (1.0, 2.0), "in2": (3.0, 4.0)}, (11.0,))
row("dotproduct_vector4", {"in1": (1.0, 2.0, 3.0, 4.0), "in2": (3.0, 4.0, 5.0, 6.0)}, (50.0,))
row("crossproduct_vector3", {"in1": (1.0, 2.0, 3.0), "in2": (-2.0, 0.5, 4.0)}, (2 * 4 - 3 * 0.5, 3 * -2 - 1 * 4,
    1 * 0.5 + 2 * 2))


th = math.radians(30)
row("rotate2d_vector2", {"in": (1.0, 2.0), "amount": 30.0}, (math.cos(th) + 2 * math.sin(th),
    -math.sin(th) + 2 * math.cos(th)))


def turned(v, deg, ax):
    a = norm(ax)
    t = math.radians(deg)
    C = math.cos(t)
    S = math.sin(t)
    x, y, z = a
    M = [[C + x * x * (1 - C), x * y * (1 - C) - z * S, x * z * (1 - C) + y * S], [y * x * (1 - C) + z * S,
        C + y * y * (1 - C), y * z * (1 - C) - x * S], [z * x * (1 - C) - y * S, z * y * (1 - C) + x * S,
            C + z * z * (1 - C)]]
    return tuple((sum((v[i] * M[i][j] for i in range(3))) for j in range(3)))


row("rotate3d_vector3", {"in": (1.0, 2.0, 3.0), "amount": 50.0, "axis": (1.0, 1.0, 0.5)}, turned((1, 2, 3), 50, (1,
    1, 0.5)))


n = norm((1.0, 2.0, 3.0))
I = (1.0, -1.0, 0.5)
dd = sum((a * b for a, b in zip(I, n)))
row("reflect_vector3", {"in": I, "normal": n}, tuple((i - 2 * dd * k for i, k in zip(I, n))))
row("remap_color3", {"in": (0.2, 0.5, 0.9), "inlow": (0.1, 0.1, 0.1), "inhigh": (0.6, 0.6, 0.6), "outlow": (1.0,
    1.0, 1.0), "outhigh": (3.0, 3.0, 3.0)}, tuple(((x - 0.1) / 0.5 * 2 + 1 for x in (0.2, 0.5, 0.9))))


def smooth(x, l, h):
    t = min(max((x - l) / (h - l), 0), 1)
    return t * t * (3 - 2 * t)


row("smoothstep_vector3FA", {"in": (0.1, 0.5, 0.95), "low": 0.2, "high": 0.9}, tuple((smooth(x, 0.2, 0.9)
    for x in (0.1, 0.5, 0.95))))


def curved(x, il, ih, g, ol, oh, cl):
    r = (x - il) / (ih - il)
    r = math.copysign(abs(r) ** (1 / g), r)
    o = r * (oh - ol) + ol
    return min(max(o, ol), oh) if cl else o


row("range_float", {"in": 0.35, "inlow": 0.2, "inhigh": 0.8, "gamma": 2.2, "outlow": 1.0, "outhigh": 3.0},
    (curved(0.35, 0.2, 0.8, 2.2, 1, 3, 0),))


row("range_float", {"in": -0.3, "gamma": 2.0, "outlow": 0.0, "outhigh": 2.0}, (curved(-0.3, 0, 1, 2, 0, 2, 0),))
row("range_float", {"in": 1.7, "gamma": 2.0, "outlow": 0.0, "outhigh": 2.0, "doclamp": 1.0}, (2.0,))
row("contrast_color3FA", {"in": (0.2, 0.5, 0.9), "amount": 1.5, "pivot": 0.4}, tuple(((x - 0.4) * 1.5 + 0.4
    for x in (0.2, 0.5, 0.9))))


LUMA = (0.2722287, 0.6740818, 0.0536895)
col = (0.8, 0.3, 0.1)
luma = sum((a * b for a, b in zip(LUMA, col)))
row("luminance_color3", {"in": col}, (luma, luma, luma))
row("luminance_color4", {"in": col + (0.4,)}, (luma, luma, luma, 0.4))
row("saturate_color3", {"in": col, "amount": 0.25}, tuple((luma + (x - luma) * 0.25 for x in col)))
import colorsys
row("rgbtohsv_color3", {"in": col}, colorsys.rgb_to_hsv(*col))
row("hsvtorgb_color3", {"in": (0.7, 0.6, 0.9)}, colorsys.hsv_to_rgb(0.7, 0.6, 0.9))
row("rgbtohsv_color4", {"in": (0.1, 0.3, 0.8, 0.5)}, colorsys.rgb_to_hsv(0.1, 0.3, 0.8) + (0.5,))


def adjusted(col, am):
    h, s, v = colorsys.rgb_to_hsv(*col)
    return colorsys.hsv_to_rgb((h + am[0]) % 1, s * am[1], v * am[2])


row("hsvadjust_color3", {"in": col, "amount": (0.3, 0.5, 1.2)}, adjusted(col, (0.3, 0.5, 1.2)))


def corrected(col, hue, sat, gam, lift, gain, con, piv, exp):
    x = adjusted(col, (hue, 1, 1))
    l = sum((a * b for a, b in zip(LUMA, x)))
    x = [l + (v - l) * sat for v in x]
    x = [v ** (1 / gam) for v in x]
    x = [v * (1 - lift) + lift for v in x]
    x = [v * gain for v in x]
    x = [(v - piv) * con + piv for v in x]
    return tuple((v * 2 ** exp for v in x))


row("colorcorrect_color3", {"in": col, "hue": 0.1, "saturation": 0.8, "gamma": 1.4, "lift": 0.05, "gain": 1.1,
    "contrast": 1.2, "contrastpivot": 0.4, "exposure": 0.5}, corrected(col, 0.1, 0.8, 1.4, 0.05, 1.1, 1.2, 0.4, 0.5))


FRONT = (0.8, 0.3, 0.1, 0.6)
BACK = (0.2, 0.7, 0.9, 0.5)
row("premult_color4", {"in": FRONT}, (0.48, 0.18, 0.06, 0.6))
row("unpremult_color4", {"in": FRONT}, (0.8 / 0.6, 0.5, 0.1 / 0.6, 0.6))


def blend(name, f, mixv=0.75):
    row(name, {"fg": FRONT, "bg": BACK, "mix": mixv}, tuple((f(a, b) * mixv + b * (1 - mixv) for a, b in zip(FRONT,
        BACK))))


blend("plus_color4", lambda f, b: f + b)
blend("minus_color4", lambda f, b: b - f)
blend("difference_color4", lambda f, b: abs(b - f))
blend("burn_color4", lambda f, b: 1 - (1 - b) / f)
blend("dodge_color4", lambda f, b: b / (1 - f))
blend("screen_color4", lambda f, b: 1 - (1 - f) * (1 - b))
blend("overlay_color4", lambda f, b: 2 * f * b if b < 0.5 else 1 - 2 * (1 - f) * (1 - b))
row("burn_float", {"fg": 0.0, "bg": 0.5, "mix": 0.5}, (0.0,))
row("dodge_float", {"fg": 1.0, "bg": 0.5, "mix": 0.5}, (0.0,))
blend("in_color4", lambda f, b: f * BACK[3])
blend("mask_color4", lambda f, b: b * FRONT[3])
blend("out_color4", lambda f, b: f * (1 - BACK[3]))
blend("over_color4", lambda f, b: f + b * (1 - FRONT[3]))
mt = [FRONT[i] * FRONT[3] + BACK[i] * (1 - FRONT[3]) for i in range(3)] + [FRONT[3] + BACK[3] * (1 - FRONT[3])]
row("matte_color4", {"fg": FRONT, "bg": BACK, "mix": 0.75}, tuple((a * 0.75 + b * 0.25 for a, b in zip(mt, BACK))))
x = (1 - FRONT[3]) / BACK[3]
dj = [FRONT[i] + BACK[i] * x for i in range(3)] + [1.0]
row("disjointover_color4", {"fg": FRONT, "bg": BACK, "mix": 0.75}, tuple((a * 0.75 + b * 0.25 for a, b in zip(dj,
    BACK))))


THIN = FRONT[:3] + (0.3,)
row("disjointover_color4", {"fg": THIN, "bg": BACK, "mix": 1.0}, tuple((a + b for a, b in zip(THIN, BACK))))
row("inside_color3", {"in": col, "mask": 0.25}, tuple((x * 0.25 for x in col)))
row("outside_color3", {"in": col, "mask": 0.25}, tuple((x * 0.75 for x in col)))
row("mix_color3", {"fg": col, "bg": (0.0, 0.5, 1.0), "mix": 0.25}, tuple((a * 0.25 + b * 0.75 for a, b in zip(col,
    (0, 0.5, 1)))))


row("constant_color3", {"value": col}, col)
row("dot_vector3", {"in": col}, col)
row("extract_color4", {"in": FRONT, "index": 3.0}, (FRONT[3],))
row("extract_vector3", {"in": col, "index": 1.0}, (col[1],))
row("swizzle_color3_vector3", {"in": col}, (0.1, 0.8, 0.0), "out", (("channels", "br0"),))
row("swizzle_vector2_float", {"in": (3.0, 4.0)}, (4.0,), "out", (("channels", "y"),))
row("separate2_vector2", {"in": (3.0, 4.0)}, (4.0,), "outy")
row("separate3_color3", {"in": col}, (col[1],), "outg")
row("separate4_vector4", {"in": FRONT}, (0.6,), "outw")
row("separate4_color4", {"in": FRONT}, (0.6,), "outa")
row("combine2_vector2", {"in1": 0.1, "in2": 0.2}, (0.1, 0.2))
row("combine2_color4CF", {"in1": col, "in2": 0.5}, col + (0.5,))
row("combine2_vector4VV", {"in1": (1.0, 2.0), "in2": (3.0, 4.0)}, (1, 2, 3, 4))
row("combine3_color3", {"in1": 0.1, "in2": 0.2, "in3": 0.3}, (0.1, 0.2, 0.3))
row("combine4_vector4", {"in1": 0.1, "in2": 0.2, "in3": 0.3, "in4": 0.4}, (0.1, 0.2, 0.3, 0.4))
row("convert_float_color3", {"in": 0.4}, (0.4, 0.4, 0.4))
row("convert_color3_color4", {"in": col}, col + (1,))
row("convert_vector2_vector3", {"in": (3.0, 4.0)}, (3, 4, 0))
row("convert_color4_color3", {"in": FRONT}, FRONT[:3])
row("ifgreater_float", {"value1": 1.0, "value2": 0.5, "in1": 2.0, "in2": 3.0}, (2.0,))
row("ifgreater_float", {"value1": 0.5, "value2": 0.5, "in1": 2.0, "in2": 3.0}, (3.0,))
row("ifgreatereq_color3", {"value1": 0.5, "value2": 0.5, "in1": col, "in2": (0.0, 0.0, 0.0)}, col)
row("ifgreatereq_float", {"value1": 0.4, "value2": 0.5, "in1": 2.0, "in2": 3.0}, (3.0,))
row("ifequal_floatI", {"value1": 2.0, "value2": 2.0, "in1": 5.0, "in2": 6.0}, (5.0,))
row("ifequal_float", {"value1": 2.0, "value2": 2.5, "in1": 5.0, "in2": 6.0}, (6.0,))
row("switch_float", {"in1": 1.0, "in2": 2.0, "in3": 3.0, "which": 2.0}, (3.0,))
row("switch_float", {"in1": 1.0, "in2": 2.0, "which": 0.0}, (1.0,))
row("switch_float", {"in1": 1.0, "which": 12.0}, (0.0,))
row("and", {"in1": 1.0, "in2": 0.0}, (0.0,))
row("or", {"in1": 1.0, "in2": 0.0}, (1.0,))
row("xor", {"in1": 1.0, "in2": 1.0}, (0.0,))
row("not", {"in": 0.0}, (1.0,))
UV = (0.3, 0.8)
row("ramplr_float", {"valuel": 1.0, "valuer": 3.0, "texcoord": UV}, (1.6,))
row("ramptb_float", {"valuet": 1.0, "valueb": 3.0, "texcoord": UV}, (3 + (1 - 3) * 0.8,))
row("ramp4_float", {"valuetl": 1.0, "valuetr": 2.0, "valuebl": 3.0, "valuebr": 5.0, "texcoord": UV},
    ((1 + 0.3) * 0.2 + (3 + 2 * 0.3) * 0.8,))


row("splitlr_float", {"valuel": 1.0, "valuer": 3.0, "center": 0.5, "texcoord": UV}, (1.0,))
row("splittb_float", {"valuet": 1.0, "valueb": 3.0, "center": 0.5, "texcoord": UV}, (1.0,))
row("checkerboard_color3", {"color1": (1.0, 0.0, 0.0), "color2": (0.0, 0.0, 1.0), "uvtiling": (2.0, 2.0),
    "texcoord": UV}, (1, 0, 0))


row("checkerboard_color3", {"color1": (1.0, 0.0, 0.0), "color2": (0.0, 0.0, 1.0), "uvtiling": (4.0, 4.0),
    "texcoord": (0.3, 0.3)}, (0, 0, 1))


row("ramp", {"texcoord": UV, "type": 0.0, "interpolation": 0.0, "num_intervals": 3.0, "interval1": 0.0,
    "color1": (0.0, 0.0, 0.0, 1.0), "interval2": 0.2, "color2": (1.0, 0.0, 0.0, 1.0), "interval3": 1.0,
        "color3": (0.0, 1.0, 0.0, 1.0)}, (1 - 0.125, 0.125, 0, 1))


row("ramp", {"texcoord": UV, "type": 2.0, "interpolation": 1.0, "num_intervals": 2.0, "color1": (0.0, 0.0, 0.0,
    1.0), "color2": (1.0, 1.0, 1.0, 1.0)}, (smooth(1.414 * math.hypot(0.2, 0.3), 0, 1),) * 3 + (1,))


row("ramp", {"texcoord": UV, "type": 1.0, "interpolation": 0.0}, (math.atan2(0.3, -0.2) / 6.28319 + 0.5,) * 3 + (1,))
row("ramp", {"texcoord": UV, "type": 3.0, "interpolation": 0.0}, (0.6,) * 3 + (1,))
row("ramp_gradient", {"x": 0.25, "interval1": 0.0, "interval2": 0.5, "color1": (1.0, 0.0, 0.0, 1.0), "color2": (0.0,
    1.0, 0.0, 1.0), "interpolation": 2.0}, (1, 0, 0, 1))


row("circle_float", {"texcoord": UV, "center": (0.5, 0.5), "radius": 0.4}, (1.0,))
row("circle_float", {"texcoord": UV, "center": (0.5, 0.5), "radius": 0.3}, (0.0,))
row("line_float", {"texcoord": UV, "radius": 0.1, "point1": (0.0, 1.0), "point2": (1.0, 0.5)}, (1.0,))
row("line_float", {"texcoord": (0.3, 0.3), "radius": 0.1, "point1": (0.0, 1.0), "point2": (1.0, 0.5)}, (0.0,))
row("grid_color3", {"texcoord": (0.02, 0.5), "thickness": 0.1}, (1, 1, 1))
row("grid_color3", {"texcoord": (0.5, 0.5), "thickness": 0.1}, (0, 0, 0))
row("grid_color3", {"texcoord": (0.02, 1.5), "thickness": 0.1, "staggered": 1.0}, (0, 0, 0))
row("place2d_vector2", {"texcoord": UV, "pivot": (0.5, 0.5), "scale": (2.0, 4.0), "rotate": 90.0, "offset": (0.1,
    0.2)}, None)


def placed(UV, pv, sc, deg, of, order):
    r = lambda v: (math.cos(math.radians(deg)) * v[0] + math.sin(math.radians(deg)) * v[1],
        -math.sin(math.radians(deg)) * v[0] + math.cos(math.radians(deg)) * v[1])
    o = (UV[0] - pv[0], UV[1] - pv[1])
    if order == 0:
        q = r((o[0] / sc[0], o[1] / sc[1]))
        return (q[0] - of[0] + pv[0], q[1] - of[1] + pv[1])
    q = r((o[0] - of[0], o[1] - of[1]))
    return (q[0] / sc[0] + pv[0], q[1] / sc[1] + pv[1])


rows.pop()
for o in (0, 1):
    row("place2d_vector2", {"texcoord": UV, "pivot": (0.5, 0.5), "scale": (2.0, 4.0), "rotate": 40.0,
        "offset": (0.1, 0.2), "operationorder": float(o)}, placed(UV, (0.5, 0.5), (2, 4), 40, (0.1, 0.2), o))


row("UsdTransform2d", {"in": UV, "rotation": 90.0, "scale": (2.0, 3.0), "translation": (0.5, 0.25)}, (-2.4 + 0.5,
    0.6 + 0.25))


ang = [x * 2 - 1 for x in (0.7, 0.4, 0.9)]
nn = norm((ang[0] * 0.5, ang[1] * 0.5, ang[2]))
row("normalmap_float", {"in": (0.7, 0.4, 0.9), "scale": 0.5, "normal": (0.0, 0.0, 1.0), "tangent": (1.0, 0.0, 0.0),
    "bitangent": (0.0, 1.0, 0.0)}, nn)


MASK = 4294967295


def rotl(x, k):
    return (x << k | x >> 32 - k) & MASK


def lookup3(*k):
    s = 3735928559 + (len(k) << 2) + 13 & MASK
    a = b = cc_ = s
    k = [x & MASK for x in k]
    a = a + k[0] & MASK
    if len(k) > 1:
        b = b + k[1] & MASK
    if len(k) > 2:
        cc_ = cc_ + k[2] & MASK
    if len(k) > 3:
        a = a - cc_ & MASK
        a ^= rotl(cc_, 4)
        cc_ = cc_ + b & MASK
        b = b - a & MASK
        b ^= rotl(a, 6)
        a = a + cc_ & MASK
        cc_ = cc_ - b & MASK
        cc_ ^= rotl(b, 8)
        b = b + a & MASK
        a = a - cc_ & MASK
        a ^= rotl(cc_, 16)
        cc_ = cc_ + b & MASK
        b = b - a & MASK
        b ^= rotl(a, 19)
        a = a + cc_ & MASK
        cc_ = cc_ - b & MASK
        cc_ ^= rotl(b, 4)
        b = b + a & MASK
        a = a + k[3] & MASK
    for x, y, n_ in (("c", "b", 14), ("a", "c", 11), ("b", "a", 25), ("c", "b", 16), ("a", "c", 4), ("b", "a", 14),
        ("c", "b", 24)):
        v = {"a": a, "b": b, "c": cc_}
        v[x] ^= v[y]
        v[x] = v[x] - rotl(v[y], n_) & MASK
        a, b, cc_ = (v["a"], v["b"], v["c"])
    return cc_


def fade(t):
    return t ** 3 * (t * (t * 6 - 15) + 10)


def grad(h, d):
    if len(d) == 2:
        h &= 7
        u, v = d if h < 4 else d[::-1]
        v *= 2
    else:
        h &= 15
        u = d[0] if h < 8 else d[1]
        v = d[1] if h < 4 else d[0] if h in (12, 14) else d[2]
    return (-u if h & 1 else u) + (-v if h & 2 else v)


def perlin3(p):
    n_ = len(p)
    base = [math.floor(x) for x in p]
    f = [x - y for x, y in zip(p, base)]
    r = [0, 0, 0]
    for k in range(1 << n_):
        cor = [k >> i & 1 for i in range(n_)]
        w = 1
        for i in range(n_):
            w *= fade(f[i]) if cor[i] else 1 - fade(f[i])
        h = lookup3(*[x + y for x, y in zip(base, cor)])
        d = [x - y for x, y in zip(f, cor)]
        for j in range(3):
            r[j] += w * grad(h >> 8 * j & 255, d)
    return [x * (0.6616 if n_ == 2 else 0.982) for x in r]


def octaves3(p, o, l, d):
    r = [0, 0, 0]
    a = 1
    for i in range(o):
        r = [x + a * y for x, y in zip(r, perlin3(p))]
        a *= d
        p = [x * l for x in p]
    return r


def cell(p):
    return lookup3(*[math.floor(x) for x in p]) / MASK


def cell3(c_):
    return [lookup3(*c_, i) / MASK for i in range(3)]


import itertools


def worley(p, j):
    n_ = len(p)
    b = [math.floor(x) for x in p]
    ds = []
    for off in itertools.product((-1, 0, 1), repeat=n_):
        ce = [x + y for x, y in zip(b, off)]
        q = cell3(ce)[:n_]
        pos = [(x - 0.5) * j + 0.5 + y for x, y in zip(q, ce)]
        ds.append((math.dist(pos, p), pos))
    ds.sort()
    return ds


PLACE = (2.35, -1.7, 0.45)
PLANE = PLACE[:2]
row("noise2d_float", {"amplitude": 2.0, "pivot": 0.25, "texcoord": PLANE}, (perlin3(PLANE)[0] * 2 + 0.25,))
row("noise3d_float", {"position": PLACE}, (perlin3(PLACE)[0],))
row("noise2d_color3", {"amplitude": (1.0, 2.0, 3.0), "texcoord": PLANE}, tuple((a * b for a,
    b in zip(perlin3(PLANE), (1, 2, 3)))))


row("noise3d_vector3FA", {"amplitude": 0.5, "pivot": 0.5, "position": PLACE}, tuple((x * 0.5 + 0.5
    for x in perlin3(PLACE))))


row("noise2d_vector2", {"texcoord": PLANE}, tuple(perlin3(PLANE)[:2]))
row("noise3d_color4", {"amplitude": (1.0, 1.0, 1.0, 1.0), "position": PLACE},
    tuple(perlin3(PLACE)) + (perlin3((PLACE[0] + 19, PLACE[1] + 73, PLACE[2] + 29))[0],))


row("noise2d_vector4", {"amplitude": (1.0, 1.0, 1.0, 1.0), "texcoord": PLANE},
    tuple(perlin3(PLANE)) + (perlin3((PLACE[0] + 19, PLACE[1] + 73))[0],))


row("fractal3d_float", {"octaves": 4.0, "lacunarity": 2.1, "diminish": 0.6, "amplitude": 1.5, "position": PLACE},
    (octaves3(PLACE, 4, 2.1, 0.6)[0] * 1.5,))


row("fractal3d_color3", {"position": PLACE}, tuple(octaves3(PLACE, 3, 2, 0.5)))
row("fractal3d_vector2", {"position": PLACE}, (octaves3(PLACE, 3, 2, 0.5)[0], octaves3((PLACE[0] + 19,
    PLACE[1] + 193, PLACE[2] + 17), 3, 2, 0.5)[0]))


row("fractal2d_float", {"texcoord": PLANE}, (octaves3(PLANE, 3, 2, 0.5)[0],))
row("fractal3d_vector4", {"position": PLACE}, tuple(octaves3(PLACE, 3, 2, 0.5)) + (octaves3((PLACE[0] + 19,
    PLACE[1] + 193, PLACE[2] + 17), 3, 2, 0.5)[0],))


row("cellnoise2d_float", {"texcoord": PLANE}, (cell(PLANE),))
row("cellnoise3d_float", {"position": PLACE}, (cell(PLACE),))
for q, pn, nm in ((PLANE, "texcoord", "worleynoise2d"), (PLACE, "position", "worleynoise3d")):
    w = worley(q, 0.8)
    row(nm + "_vector3", {pn: q, "jitter": 0.8}, tuple((x[0] for x in w[:3])))
    row(nm + "_float", {pn: q}, (worley(q, 1.0)[0][0],))
    row(nm + "_vector2", {pn: q}, tuple((x[0] for x in worley(q, 1.0)[:2])))
    row(nm + "_float", {pn: q, "style": 1.0}, (cell(worley(q, 1.0)[0][1]),))
    row(nm + "_vector3", {pn: q, "style": 1.0}, tuple(cell3([math.floor(x) for x in worley(q, 1.0)[0][1]])))


UNIFIED = {"freq": (2.0, 2.0, 2.0), "offset": (0.1, 0.2, 0.3)}
moved = tuple((x * 2 + o for x, o in zip(PLACE, (0.1, 0.2, 0.3))))
row("unifiednoise3d_float", dict(UNIFIED, position=PLACE, type=0.0), (min(max(perlin3(moved)[0] * 0.5 + 0.5, 0), 1),))
row("unifiednoise3d_float", dict(UNIFIED, position=PLACE, type=1.0), (cell(moved),))
row("unifiednoise3d_float", dict(UNIFIED, position=PLACE, type=2.0), (worley(moved, 1.0)[0][0],))
row("unifiednoise3d_float", dict(UNIFIED, position=PLACE, type=3.0, clampoutput=0.0, outmin=1.0, outmax=3.0),
    (octaves3(moved, 3, 2, 0.5)[0] * 2 + 1,))


row("unifiednoise2d_float", dict(texcoord=PLANE, type=3.0, clampoutput=0.0), (octaves3(PLANE, 3, 2, 0.5)[0],))
row("randomfloat_float", {"in": 0.37, "min": 2.0, "max": 4.0, "seed": 5.0}, (2 + 2 * cell((0.37 * 4096, 5)),))
random_hsv = [cell((0.37 * 4096, math.ceil(5 + s))) for s in (413.3, 1522.4, 1813.8)]
row("randomcolor_float", {"in": 0.37, "seed": 5.0}, colorsys.hsv_to_rgb(random_hsv[0],
    0.825 + 0.175 * random_hsv[1], 1.0))


def num(x):
    s = "%.9g" % x
    return s + ("" if "." in s or "e" in s else ".") + "f"


def val(v):
    v = spread(v, 1) if not isinstance(v, (tuple, list)) else tuple(v)
    return "{" + ", ".join((num(x) for x in v)) + "}"


for id, ins, exp, out, text in rows:
    i = ", ".join(('{"%s", %s}' % (k, val(v)) for k, v in ins.items()))
    t = "" if not text and out == "out" else ', "%s"' % out
    if text:
        t += ', {"%s", "%s"}' % text[0]
    print('{"ND_%s", {%s}, %s%s},' % (id, i, val(exp), t))
