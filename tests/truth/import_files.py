"""tests/truth/import_files.py - other programs' lens files, read independently of lenscalc.

Just enough of .zmx, .seq and .len to follow the axis: curvatures, distances, media, mirrors. Decimal
arithmetic throughout. Used by check_import.py.
"""
# SPDX-License-Identifier: MIT

from decimal import Decimal, getcontext

getcontext().prec = 50
INFINITE = Decimal("1e9")  # an object as far as that


def text_of(data):
    if data[:2] == b"\xff\xfe" or data[1:2] == b"\0":
        return data.decode("utf-16-le").lstrip("\ufeff")
    return data.decode("cp1252")


class Surface:
    def __init__(self):
        self.c, self.t, self.medium = Decimal(0), Decimal(0), None  # None = air, "mirror", a name


def zmx(text):
    """(object distance, surfaces without the image, primary wavelength in um, factor to mm)"""
    all_surfaces, waves, primary, unit = [], {}, 1, 1
    for words in (line.split() for line in text.splitlines()):
        if not words:
            continue
        key = words[0]
        if key == "SURF":
            all_surfaces.append(Surface())
        elif key == "CURV":
            all_surfaces[-1].c = Decimal(words[1])
        elif key == "DISZ":
            all_surfaces[-1].t = Decimal(words[1])
        elif key == "GLAS":
            model = words[1] == "___BLANK" or words[2] == "1"
            all_surfaces[-1].medium = ("mirror" if words[1] == "MIRROR" else
                                       (Decimal(words[4]), Decimal(words[5])) if model else
                                       words[1])
        elif key == "PARM" and words[1] == "1" and Decimal(words[2]) != 0:
            raise ValueError("A2 is not followed")
        elif key == "WAVM":
            waves[int(words[1])] = Decimal(words[2])
        elif key == "WAVL":
            waves = {i + 1: Decimal(word) for i, word in enumerate(words[1:])}
        elif key == "PWAV":
            primary = int(words[1])
        elif key == "UNIT":
            unit = {"MM": 1, "CM": 10, "IN": Decimal("25.4"), "METER": 1000}[words[1]]
    return all_surfaces[0].t, all_surfaces[1:-1], waves[primary], unit


def seq(text):
    waves, reference, radii, unit, all_surfaces = [], 1, True, 1, []
    pickups = []
    text = text.replace("&\n", " ").replace(";", "\n")
    for words in (line.split("!")[0].split() for line in text.splitlines()):
        if not words:
            continue
        key = words[0].upper()
        if key == "RDM":
            radii = len(words) == 1 or words[1].upper() != "N"
        elif key == "WL":
            waves = [Decimal(word) for word in words[1:]]
        elif key == "REF":
            reference = int(words[1])
        elif key == "DIM":
            unit = {"M": 1, "MM": 1, "C": 10, "I": Decimal("25.4")}[words[1].upper()]
        elif key in ("S", "SO", "SI"):
            one = Surface()
            value = Decimal(words[1])
            one.c = value if not radii else 1 / value if value != 0 else value
            one.t = Decimal(words[2])
            if len(words) > 3:
                one.medium = "mirror" if words[3].upper() == "REFL" else words[3].upper()
            all_surfaces.append(one)
        elif key == "PIK":
            pickups.append(words[1:])
    for what, to, _, _, source, _, *factor in pickups:
        target, one = all_surfaces[int(to[1:])], all_surfaces[int(source[1:])]
        scale = Decimal(factor[0]) if factor else 1
        if what == "RDY":
            target.c = one.c * scale
        else:
            target.t = one.t * scale
    all_surfaces[-2].image_t = all_surfaces[-1].t
    return all_surfaces[0].t, all_surfaces[1:-1], waves[reference - 1] / 1000, unit


def len_file(text):
    waves, all_surfaces, indices = [], [Surface()], []
    for words in (line.split() for line in text.splitlines()):
        if not words:
            continue
        key = words[0]
        if key == "NXT":
            all_surfaces.append(Surface())
        elif key == "RD":
            value = Decimal(words[1])
            all_surfaces[-1].c = 1 / value if value != 0 else value
        elif key == "TH":
            all_surfaces[-1].t = Decimal(words[1])
        elif key == "RFL":
            all_surfaces[-1].medium = "mirror"
        elif key == "GLA":
            # "GLA 1.573000 1.573 1.573": indices at the wavelengths of the file
            number = words[1].replace(".", "").isdigit()
            all_surfaces[-1].medium = ("index", Decimal(words[2])) if number else words[1]
        elif key == "WV":
            waves = [Decimal(word) for word in words[1:]]
    return all_surfaces[0].t, all_surfaces[1:-1], waves[0], 1


READERS = {"zmx": zmx, "seq": seq, "len": len_file}


def index_of(glass, l):
    """A row of glass.tsv at l um."""
    x, formula = l * l, glass["formula"]
    c = [Decimal(word) for word in glass["coeffs"].split()]
    pairs = list(zip(c[0::2], c[1::2]))
    if formula == "sellmeier":
        return (1 + sum(b * x / (x - r) for b, r in pairs)).sqrt()
    if formula == "sellmeier_sq":
        return (1 + c[0] + sum(b * x / (x - r * r) for b, r in zip(c[1::2], c[2::2]))).sqrt()
    if formula == "schott":
        return (c[0] + c[1] * x + sum(a / x ** (i + 1) for i, a in enumerate(c[2:]))).sqrt()
    if formula == "power":
        return (c[0] + sum(a * l ** int(p) for a, p in zip(c[1::2], c[2::2]))).sqrt()
    raise ValueError(formula)


def model_index(nd, Vd, l):
    """n = A + B/l^2 with nd and (nd - 1)/(nF - nC) = Vd."""
    d, F, C = (1 / Decimal(line) ** 2 for line in ("0.5875618", "0.4861327", "0.6562725"))
    return nd + (nd - 1) / Vd / (F - C) * (1 / l**2 - d)


def first_order(surfaces, l, unit, glasses):
    """(efl, bfl) in mm by one ray parallel to the axis; a mirror turns the sign of the index."""
    y, v, n = Decimal(1), Decimal(0), Decimal(1)
    for i, one in enumerate(surfaces):
        medium = one.medium
        if medium == "mirror":
            after = -n
        else:
            if medium is None:
                after = Decimal(1)
            elif isinstance(medium, tuple):
                after = medium[1] if medium[0] == "index" else model_index(*medium, l)
            else:
                after = index_of(glasses[medium], l)
            after = after.copy_sign(n)
        v -= y * (after - n) * one.c
        n = after
        if i + 1 < len(surfaces):
            y += one.t * v / n
    return -unit / v, -y * n / v * unit
