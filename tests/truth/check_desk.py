#!/usr/bin/env python3
"""tests/truth/check_desk.py - the photographer's desk against numbers from outside.

Each row is a command line, the column that answers, the outside number, its tolerance and where the
number comes from. Tables of several rows have checks of their own.
"""
# SPDX-License-Identifier: MIT

import csv
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT, Checks, Program

AIRY = 2 * 3.8317059702075123 / math.pi  # first zero of J1 over pi, twice

LECTURE = "lecture, exposure and high dynamic range"

# sources of tests/truth/sources.tsv by what their rows begin with; the others are formulas
PRINTED = {"iso12232": "ISO 12232", "iso5": "ISO 5-1", "apex": "APEX", "asc": "ASC",
           "films": ("Ilford", "Gainer", "Kodak", "Fujifilm"), "wikipedia": "Wikipedia"}
UNITS = {name: name for name in ("s", "mm", "um", "m", "deg", "stops", "lx")} | {"m2": "cd/m2"}

# command line, column, expected, tolerance, source
LIGHT = [
    ("exposure --scene sunny-16 -N 16", "ev100", math.log2(25600), 2e-4,
     "f/16 at 1/S s: log2(100 16^2)"),
    ("exposure --scene sunny-16 -N 16", "time_s", 1 / 100, 5e-6, "the rule sunny 16 itself"),
    ("exposure --scene sunny-16 -N 16 --iso 400", "time_s", 1 / 400, 1e-17, "exactly 1/ISO"),
    ("exposure --scene sunny-16 -N 8 --iso 125", "time_s", 1 / 500, 1e-17, "two stops from it"),
    ("exposure -N 22 --ev 5 --film HP5_Plus", "time_s", 22**2 / 2**5 / 4, 1e-12,
     "a film of ISO 400 takes a quarter of the time"),
    ("exposure -N 22 --ev 5 --film HP5_Plus", "iso", 400, 0, "what is on the box"),
    ("exposure -N 4 --ev 10 --film Ektar_100", "iso", 100, 0, "one of three in a row"),
    ("exposure -N 4 --ev 10 --film Portra_160", "iso", 160, 0, "another"),
    ("exposure -N 22 --ev 5 --film HP5_Plus --iso 800", "iso", 800, 0, "pushed: as given"),
    ("exposure -N 8 -t 1/125", "residual_stops", 0, 0, "these settings are on the dial"),
    ("exposure -N 5.6 -t 1/30 --series full", "residual_stops", 0, 0, "and these"),
    ("exposure -N 8 -t 1/125 --focal-plane", "glass_transmittance", 0.9, 0, "ISO 12232"),
    ("exposure -N 8 -t 1/125 --focal-plane", "vignetting", 0.98, 0, "ISO 12232"),
    ("exposure -N 8 -t 1/125 --focal-plane", "off_axis_deg", 10, 1e-14, "ISO 12232"),
    ("exposure -N 8 -t 1/125 --focal-plane --transmittance 0.8", "glass_transmittance", 0.8, 0,
     "as given"),
    ("dof -f 100 -N 2.8 -s 200mm -c airy", "coc_mm", AIRY * 550e-6 * 5.6, 1e-16,
     "Airy disc at 1:1: f/2.8 works as f/5.6"),
    ("dof -f 100 -N 2.8 -s 200mm -c airy -P 2", "coc_mm", AIRY * 550e-6 * 4.2, 1e-16,
     "N (1 + m/P)"),
    ("dof -f 100 -N 2.8 -s inf -c airy", "coc_mm", AIRY * 550e-6 * 2.8, 1e-16, "at infinity"),
    ("dof -f 50 -N 8 --magnification 1 -c airy", "coc_mm", AIRY * 550e-6 * 16, 1e-15,
     "the distance is the unknown"),
    # c = a N (1 + N c/f) at the hyperfocal distance, a = 2.44 times the wavelength
    ("hyperfocal -f 5 -N 11 -c airy", "coc_mm",
     AIRY * 550e-6 * 11 / (1 - AIRY * 550e-6 * 11**2 / 5), 1e-15, "solved for c by hand"),
    ("equivalent -f 50 -N 4 -m 1 --to mft -c airy --columns coc", "coc_mm", AIRY * 550e-6 * 8,
     1e-16, "life size"),
    ("diffraction -N 16 -m 1:1 -c airy", "coc_mm", AIRY * 550e-6 * 32, 1e-15, "life size"),
    ("dof -f 50 -N 8 -s 2m --print 30in --viewing 1m", "coc_mm",
     1000 / 250 / (5 * 30 * 25.4 / 36), 1e-15, "5 lp/mm at 25 cm, 1.25 at 1 m, enlarged 21 times"),
    ("dof -f 50 -N 8 -s 2m --acuity 8", "coc_mm", 1 / (8 * 254 / 36), 1e-15,
     "10 inches at 25 cm"),
    ("hyperfocal -f 50 -N 8 --pitch 4um", "coc_mm", 0.008, 1e-17, "two pixels"),
    ("dof -f 50 -N 8 -s 2m --pitch 4um -c 3px", "coc_mm", 0.012, 1e-17, "three"),
    ("flash -g 36 -s 4.5 --power 1/16..1/16", "fnumber", 2, 1e-12, "four stops less light"),
    ("exposure -N 1 -t 1", "luminance_cd_m2", 0.125, 0, "EV 0 with K 12.5: 0.125 cd/m2"),
    ("exposure -N 1 -t 1", "illuminance_lx", 2.5, 0, "EV 0 with C 250: 2.5 lx"),
    ("exposure -N 1 -t 1 --iso 100", "sv", 5, 1e-12, "APEX: ISO 100 is Sv 5"),
    ("exposure -N 8 -t 1/64 --iso 100", "av", 6, 1e-12, "APEX: f/8 is Av 6"),
    ("exposure -N 8 -t 1/64 --iso 100", "tv", 6, 1e-12, "APEX: 1/64 s is Tv 6"),
    ("exposure -N 8 --ev 12 --filter ND3.0", "loss_stops", 3 / math.log10(2), 1e-12,
     "ISO 5-1: D/log10 2"),
    ("exposure -N 8 --ev 12 --filter ND3.0", "loss_stops", 9.966, 5e-4, "9.966 stops, not 10"),
    ("exposure -N 8 --ev 12 --filter ND8", "loss_stops", 3, 0, "factor 8 is 3 stops"),
    ("exposure -N 2 --ev 12 --transmittance 75%", "t_stop", 2.309, 5e-4,
     "Wikipedia, F-number: T-stop"),
    ("exposure -N 8 --ev 12 -m 1", "loss_stops", 2, 0, "bellows rule: 2 stops at 1:1"),
    ("exposure --shutter-angle 180deg --frame-rate 24 --ev 9", "time_s", 1 / 48, 1e-15,
     "180 deg at 24 fps is 1/48 s"),
    ("exposure --shutter-angle 172.8deg --frame-rate 24 --ev 9", "time_s", 1 / 50, 1e-15,
     "172.8 deg at 24 fps is 1/50 s"),
    ("exposure -t 10s --film Ilford_HP5_Plus", "corrected_time_s", 20.4, 0.05, "Ilford: 10^1.31"),
    ("exposure -t 100s --film HP5_Plus", "corrected_time_s", 417, 0.5, "Ilford: 100^1.31"),
    ("exposure -t 100s --film HP5_Plus_(Gainer)", "corrected_time_s", 275, 0.6,
     "Gainer: 100 + 0.101 100^1.62"),
    ("exposure -t 100s --film Tri-X_400", "corrected_time_s", 1200, 1e-9, "Kodak F-4017: 12 times"),
    ("exposure -t 200s --film Acros_100_II", "reciprocity_stops", 0.5, 1e-12,
     "Fujifilm: +1/2 stop from 120 s"),
    ("exposure -N 8 -t 1/125 --focal-plane", "lens_q", 0.6516, 1e-4, "ISO 12232: q 0.65"),
    ("flash -g 36m -s 4.5m", "fnumber", 8, 1e-12, "guide number 36: f/8 at 4.5 m"),
    ("flash -g 36m -N 8 --iso 400", "distance_m", 9, 1e-12,
     "four times the speed, twice the distance"),
    ("flash -g 30 --second 40 -s 5", "joint_guide_number_m", 50, 1e-12, "flashes add in squares"),
    ("flash --key-to-fill 1", "lighting_ratio", 3, 1e-12, "ASC: one stop is 3:1"),
    ("flash --key-to-fill 2", "lighting_ratio", 5, 1e-12, "ASC: two stops are 5:1"),
    ("motion -f 100 -s 10.1 -v 10m/s -t 1/1000", "blur_um", 100, 1e-9, "m = 1/100: 10 mm of path"),
    ("motion -f 500 -s 50 -v 1m/s", "handheld_s", 1 / 500, 1e-15, "one over focal length"),
    ("stars -f 50", "rule_of_thumb_s", 10, 0, "500 over focal length"),
    ("stars -f 24 -N 2.8 --pitch 4.35um", "npf_simple_s", (35 * 2.8 + 30 * 4.35) / 24, 1e-12,
     "NPF rule"),
    ("stars -f 24", "four_minus_crop_s", 12.5, 0, "4 - crop rule: 300/f on 35 mm"),
    ("stars -f 50 -t 1", "linear_trail_um", 50e3 * 7.2921e-5, 1e-4, "f w t, w = 7.2921e-5 rad/s"),
    ("stars -f 1000 -t 86164.098903691 --declination 60deg", "rotation_deg", 360, 1e-9,
     "a stellar day"),
]


def rows_of(program, command):
    """The rows of a command line; '_' in a film's name stands for a blank."""
    words = command.split()
    if "--film" in words:
        at = words.index("--film") + 1
        words[at] = words[at].replace("_", " ")
    result = program.run(*words, "--csv")
    if result.returncode != 0:
        return []
    return list(csv.DictReader(result.stdout.decode().splitlines()))


def check_value(checks, program, row):
    command, column, expected, tolerance, source = row
    extra = f" --columns {column}" if column in ("av", "tv", "sv", "t_stop") else ""
    words = command + extra
    rows = rows_of(program, words)
    value = float(rows[0][column]) if rows and rows[0].get(column) else ""
    named = [name for name, start in PRINTED.items() if source.startswith(start)]
    checks.against((named + ["algebra"])[0], f"{command} ({source})", column, value, expected,
                   tolerance, UNITS.get(column.rpartition("_")[2], ""))


def check_sixteen_shots(checks, program):
    """30 s to 1/1000 s in one-stop steps."""
    labels = "30 15 8 4 2 1 0.5 1/4 1/8 1/15 1/30 1/60 1/125 1/250 1/500 1/1000".split()
    for more in ("", " --nominal"):
        rows = rows_of(program, "bracket --from 30s --to 1/1000s" + more)
        checks.check(len(rows) == 16, f"bracket{more}: {len(rows)} shots, expected 16 ({LECTURE})")
        checks.check([row["nominal_time"] for row in rows] == labels,
                     f"bracket{more}: labels {[row['nominal_time'] for row in rows]}")
        for i, row in enumerate(rows):
            exact = (32 if more else 30) * 2.0 ** -i
            checks.check(float(row["time_s"]) == exact, f"bracket{more}: shot {i + 1} has "
                                                        f"{row['time_s']} s, expected {exact}")


def check_equal_exposures(checks, program):
    """f/16 1/8 s = f/4 1/125 s = f/2 1/500 s: exact as steps, 0.034 stop apart as labels."""
    rows = rows_of(program, "exposure -N 16 -t 1/8 --equivalent --series full")
    pairs = {row["nominal_fnumber"]: row for row in rows}
    for fnumber, time, label in (("16", "1/8", 0), ("4", "1/125", math.log2(128 / 125)),
                                 ("2", "1/500", math.log2(512 / 500))):
        row = pairs.get(fnumber, {})
        found = row.get("nominal_time")
        checks.check(found == time, f"f/{fnumber} goes with {found}, expected {time} ({LECTURE})")
        checks.check(abs(float(row.get("residual_stops", "nan"))) <= 1e-12,
                     f"f/{fnumber}: residual {row.get('residual_stops')}, expected 0")
        residual = float(row.get("label_residual_stops", "nan"))
        checks.check(abs(residual - label) <= 1e-12,
                     f"f/{fnumber}: labels differ by {residual} stops, expected {label}")


def check_put_back(checks, program):
    """Every solved unknown, put back, gives what it was solved from."""
    for unknown, column in (("-N", "fnumber"), ("-t", "time_s"), ("--iso", "iso")):
        given = {"-N": "5.6", "-t": "1/90", "--iso": "320", "--ev": "11.3"}
        del given[unknown]
        words = " ".join(f"{name} {value}" for name, value in given.items())
        answer = rows_of(program, f"exposure {words}")[0][column]
        back = rows_of(program, f"exposure {words} {unknown} {answer}")[0]
        checks.check(abs(float(back["deviation_stops"] or "nan")) <= 1e-12,
                     f"exposure {words}: {unknown} {answer} put back is off by "
                     f"{back['deviation_stops']} stops")


def main():
    os.chdir(ROOT)
    checks, program = Checks(), Program(sys.argv[1])
    for row in LIGHT:
        check_value(checks, program, row)
    check_sixteen_shots(checks, program)
    check_equal_exposures(checks, program)
    check_put_back(checks, program)
    checks.finish()


main()
