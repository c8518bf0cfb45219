"""tests/bench/paraxial.py - the first-order engine: time against error, beside plain doubles."""
# SPDX-License-Identifier: MIT

import subprocess

from common import entry


def paraxial(bench):
    words = [bench.tool("paraxial", *bench.objects()), "double-gauss"]
    output = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    first, *others = output.splitlines()
    name, surfaces = first.split()[:2]
    plain, trace, portable, figures, lens = map(float, first.split()[2:])
    yield entry(f"paraxial: trace, {surfaces} surfaces", trace, "ns",
                f"{trace / plain:.1f} x plain doubles, {plain:.0f} ns; without FMA {portable:.0f}")
    yield entry("paraxial: trace and all figures", figures, "ns",
                f"{figures / plain:.1f} x the plain trace of {name}")
    yield entry("paraxial: from the lens", lens, "ns",
                "compiled at its wavelength, with the indices of its media")
    for line in others:
        power, doubles, ours = map(float, line.split()[1:])
        # off by 1e-15 mm, an ulp of the gap is a hundredth: what the decimals say is still met
        yield entry(f"paraxial: error at power {power:.0e}/mm", ours, "rel.",
                    f"plain doubles {doubles:.1g}")


SECTIONS = {"paraxial": paraxial}
