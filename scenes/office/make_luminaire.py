#!/usr/bin/env python3
"""Writes luminaire.ies (LM-63-2002) and luminaire.ldt (EULUMDAT): one luminaire, two formats.

The luminaire is nobody's product: a recessed 600 x 600 mm LED panel of 3800 lm with a prismatic cover
that throws more light sideways than straight down (a "batwing") and little above 65 degrees, somewhat
narrower along C90 than along C0. Its flux is the exact integral of the table as readers interpolate it:
linear in both angles. Python's standard library only; the same bytes every time.
"""

from math import cos, exp, radians, sin
from pathlib import Path

NAME = "Stilb example panel 600"
FLUX_LM = 3800.0
POWER_W = 31.0
SIDE_M = 0.55  # the luminous opening
PLANES_DEG = [22.5 * k for k in range(5)]  # C0 to C90; the rest by symmetry
POLAR_DEG = [2.5 * k for k in range(37)]


def shape(plane_deg, polar_deg):
    """Intensity in any unit: a cosine, raised at middle angles and cut off towards the horizon."""
    across = cos(radians(plane_deg)) ** 2  # 1 in C0, 0 in C90
    batwing = 0.55 + 0.35 * across
    cutoff_deg = 63 + 3 * across
    gamma = radians(polar_deg)
    cutoff = 1 / (1 + exp((polar_deg - cutoff_deg) / 5))
    return cos(gamma) * (1 + batwing * sin(gamma) ** 2) * cutoff


def zone_lm_per_cd(low_deg, high_deg):
    """The weights of a zone's two ends: integrals of (1 - t) sin(gamma) and t sin(gamma), t from 0 to 1."""
    low, high = radians(low_deg), radians(high_deg)
    whole = cos(low) - cos(high)
    rising = (sin(high) - sin(low)) / (high - low) - cos(high)
    return whole - rising, rising


def flux_lm(table):
    """Exact integral over the sphere of the table [plane][polar] of one quarter, linear in both angles."""
    total = 0.0
    for k, (left, right) in enumerate(zip(table, table[1:])):
        quarter_width = radians(PLANES_DEG[k + 1] - PLANES_DEG[k])
        for j, (low, high) in enumerate(zip(POLAR_DEG, POLAR_DEG[1:])):
            at_low, at_high = zone_lm_per_cd(low, high)
            ends = (left[j] + right[j]) * at_low + (left[j + 1] + right[j + 1]) * at_high
            total += quarter_width / 2 * ends
    return 4 * total


def make_table():
    """Candela [plane][polar], written to a tenth, of FLUX_LM."""
    table = [[shape(plane, polar) for polar in POLAR_DEG] for plane in PLANES_DEG]
    factor = FLUX_LM / flux_lm(table)
    return [[round(factor * value, 1) for value in row] for row in table]


def wrapped(values, form):
    """Lines of at most eleven numbers: LM-63 allows 132 characters."""
    words = [form.format(value) for value in values]
    return [" ".join(words[k:k + 11]) for k in range(0, len(words), 11)]


def ies(table):
    lines = [
        "IESNA:LM-63-2002",
        "[TEST] computed, not measured",
        "[TESTLAB] none",
        "[ISSUEDATE] 2026",
        "[MANUFAC] The Stilb authors",
        f"[LUMINAIRE] {NAME}, recessed, prismatic cover",
        "TILT=NONE",
        f"1 {FLUX_LM:.0f} 1 {len(POLAR_DEG)} {len(PLANES_DEG)} 1 2 {SIDE_M} {SIDE_M} 0",
        f"1 1 {POWER_W}",
        *wrapped(POLAR_DEG, "{:.1f}"),
        *wrapped(PLANES_DEG, "{:.1f}"),
    ]
    for row in table:
        lines += wrapped(row, "{:.1f}")
    return "\r\n".join(lines) + "\r\n"


def eulumdat(table):
    planes_of_circle = 4 * (len(PLANES_DEG) - 1)
    plane_step = PLANES_DEG[1] - PLANES_DEG[0]
    side_mm = f"{1000 * SIDE_M:.0f}"
    lines = [
        "The Stilb authors",
        "3",  # type indicator: neither linear nor of rotational symmetry
        "4",  # symmetry about C0-C180 and C90-C270
        f"{planes_of_circle}", f"{plane_step}",
        f"{len(POLAR_DEG)}", f"{POLAR_DEG[1] - POLAR_DEG[0]}",
        "computed, not measured",
        NAME, "600", "luminaire.ldt", "2026",
        "595", "595", "15",  # housing, mm
        side_mm, side_mm, "0", "0", "0", "0",  # luminous area, mm
        "100.0",  # downward flux fraction, percent
        "100.0",  # light output ratio, percent
        "1.0",  # conversion factor
        "0",  # tilt
        "1",  # sets of lamps
        "1", "LED", f"{FLUX_LM:.0f}", "4000", "80", f"{POWER_W}",
        *["0.00"] * 10,  # direct ratios: to be computed by those who need them
        *(f"{plane_step * k:.1f}" for k in range(planes_of_circle)),
        *(f"{polar:.1f}" for polar in POLAR_DEG),
    ]
    for row in table:
        lines += [f"{value * 1000 / FLUX_LM:.3f}" for value in row]  # cd per klm
    return "\r\n".join(lines) + "\r\n"


def main(folder):
    table = make_table()
    (folder / "luminaire.ies").write_bytes(ies(table).encode("ascii"))
    (folder / "luminaire.ldt").write_bytes(eulumdat(table).encode("ascii"))
    print(f"luminaire.ies, luminaire.ldt: {flux_lm(table):.1f} lm, peak {max(map(max, table)):.0f} cd")


if __name__ == "__main__":
    main(Path(__file__).resolve().parent)
