/* base/units.c - dimensions and their units. */
/* SPDX-License-Identifier: MIT */
#include "base/units.h"

#include "base/constants.h"

#include <math.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct unit number_units[] = {
    {"", "", {1, 0}, 1, NULL, "plain number"},
};

/* Units of length, where the program's own one is 10^-p mm. */
#define NM(p) "nm", "nm", {1, (p)-6}, 1, "nanometer nanometers nanometre nanometres", "nanometre"
#define UM(p) "um", "um", {1, (p)-3}, 1, "\xc2\xb5m \xce\xbcm", "micrometre"
#define MM(p) "mm", "mm", {1, p}, 1, "millimeter millimeters millimetre millimetres", "millimetre"
#define CM(p)                                                                                      \
    "cm", "cm", {1, (p) + 1}, 1, "centimeter centimeters centimetre centimetres", "centimetre"
#define M(p)  "m", "m", {1, (p) + 3}, 1, "meter meters metre metres", "metre"
#define KM(p) "km", "km", {1, (p) + 6}, 1, NULL, "kilometre"
#define IN(p)                                                                                      \
    "in", "in", {254, (p)-1}, 1, "\" \xe2\x80\xb3 \xe2\x80\x9d inch inches", "inch, 25.4 mm"
#define FT(p)                                                                                      \
    "ft", "ft", {3048, (p)-1}, 1, "' \xe2\x80\xb2 \xe2\x80\x99 feet foot", "foot, 304.8 mm"
#define YD(p) "yd", "yd", {9144, (p)-1}, 1, "yard yards", "yard, 914.4 mm"
#define MI(p) "mi", "mi", {1609344, p}, 1, "mile miles", "mile, 1609.344 m"

static const struct unit length_units[] = {
    {MM(0)},
    {NM(0)},
    {UM(0)},
    {CM(0)},
    {M(0)},
    {KM(0)},
    {IN(0)},
    {FT(0)},
    {YD(0)},
    {MI(0)},
    /* the last is of focal lengths alone */
    {"mm-eq",
     "mm-eq",
     {1, 0},
     1,
     "mmeq mm-equiv mm-equivalent",
     "focal length with the same diagonal angle on 36 x 24 mm"},
};

/* For wavelengths that the program keeps in um. */
static const struct unit wavelength_units[] = {
    {UM(3)}, {NM(3)}, {MM(3)}, {CM(3)}, {M(3)}, {KM(3)}, {IN(3)}, {FT(3)}, {YD(3)}, {MI(3)},
};

static const struct unit angle_units[] = {
    {"rad", "rad", {1, 0}, 1, NULL, "radian"},
    {"mrad", "mrad", {1, -3}, 1, NULL, "milliradian"},
    {"deg", "deg", {1, 0}, RADIANS_PER_DEGREE, "\xc2\xb0 degree degrees", "degree"},
    {"arcmin", "arcmin", {1, 0}, RADIANS_PER_DEGREE / 60, NULL, "minute of arc"},
    {"arcsec", "arcsec", {1, 0}, RADIANS_PER_DEGREE / 3600, NULL, "second of arc"},
};

static const struct unit time_units[] = {
    {"s", "s", {1, 0}, 1, "sec secs second seconds", "second"},
    {"ns", "ns", {1, -9}, 1, NULL, "nanosecond"},
    {"us", "us", {1, -6}, 1, "\xc2\xb5s \xce\xbcs", "microsecond"},
    {"ms", "ms", {1, -3}, 1, NULL, "millisecond"},
    {"min", "min", {60, 0}, 1, "minute minutes mins", "minute, 60 s"},
    {"h", "h", {3600, 0}, 1, "hr hour hours", "hour, 3600 s"},
    {"d", "d", {86400, 0}, 1, "day days", "day, 24 h"},
};

static const struct unit iso_units[] = {
    {"", "", {1, 0}, 1, "ISO iso ASA asa", "arithmetic film speed"},
};

static const struct unit ev_units[] = {
    {"", "", {1, 0}, 1, "EV ev", "exposure value"},
};

static const struct unit ratio_units[] = {
    {"", "", {1, 0}, 1, "x X", "times"},
    {"percent", "%", {1, -2}, 1, "%", "hundredth"},
};

static const struct unit vergence_units[] = {
    {"per_mm", "1/mm", {1, 0}, 1, "/mm", "per millimetre"},
    {"per_m", "1/m", {1, -3}, 1, "/m", "per metre"},
    {"diopter", "dpt", {1, -3}, 1, "dpt D dioptre dioptres diopters", "dioptre, 1/m"},
};

static const struct unit stops_units[] = {
    {"stops", "stops", {1, 0}, 1, "stop EV ev", "factor of two in light"},
};

static const struct unit luminance_units[] = {
    {"cd_m2", "cd/m2", {1, 0}, 1, "cd/m2 cd/m^2 nt nit nits", "candela per square metre"},
    {"kcd_m2", "kcd/m2", {1, 3}, 1, "kcd/m2 kcd/m^2", "kilocandela per square metre"},
    {"mcd_m2", "mcd/m2", {1, -3}, 1, "mcd/m2 mcd/m^2", "millicandela per square metre"},
    {"fL", "fL", {1, 0}, 3.4262590996353905, "ftL ft-L fl ftl", "foot-lambert"},
};

static const struct unit illuminance_units[] = {
    {"lx", "lx", {1, 0}, 1, "lux", "lux"},
    {"klx", "klx", {1, 3}, 1, "klux", "kilolux"},
    {"mlx", "mlx", {1, -3}, 1, NULL, "millilux"},
    {"fc", "fc", {1, 0}, 10.763910416709722, "ftc", "foot-candle, lumen per square foot"},
};

static const struct unit exposure_units[] = {
    {"lx_s", "lx s", {1, 0}, 1, "lxs", "lux second"},
};

static const struct unit speed_units[] = {
    {"mm_s", "mm/s", {1, 0}, 1, "mm/s", "millimetre per second"},
    {"m_s", "m/s", {1, 3}, 1, "m/s", "metre per second"},
    {"km_h", "km/h", {1, 3}, 1 / 3.6, "km/h kph kmh", "kilometre per hour"},
    {"mph", "mph", {44704, -2}, 1, NULL, "mile per hour"},
    {"kn", "kn", {1852, 3}, 1 / 3600.0, "knot knots", "knot, 1852 m per hour"},
    {"ft_s", "ft/s", {3048, -1}, 1, "ft/s", "foot per second"},
};

static const struct unit rotation_units[] = {
    {"rad_s", "rad/s", {1, 0}, 1, "rad/s", "radian per second"},
    {"deg_s", "deg/s", {1, 0}, RADIANS_PER_DEGREE, "deg/s \xc2\xb0/s", "degree per second"},
    {"deg_h", "deg/h", {1, 0}, RADIANS_PER_DEGREE / 3600, "deg/h \xc2\xb0/h", "degree per hour"},
    {"arcmin_s",
     "arcmin/s",
     {1, 0},
     RADIANS_PER_DEGREE / 60,
     "arcmin/s",
     "minute of arc per second"},
    {"arcsec_s",
     "arcsec/s",
     {1, 0},
     RADIANS_PER_DEGREE / 3600,
     "arcsec/s",
     "second of arc per second"},
    {"rpm", "rpm", {6, 0}, RADIANS_PER_DEGREE, "1/min", "turn per minute"},
};

static const struct unit frequency_units[] = {
    {"per_mm", "1/mm", {1, 0}, 1, "/mm lp/mm cycles/mm", "cycle or line pair per millimetre"},
};

static const struct unit rate_units[] = {
    {"fps", "fps", {1, 0}, 1, NULL, "frame per second"},
    {"Hz", "Hz", {1, 0}, 1, "hz", "per second"},
    {"kHz", "kHz", {1, 3}, 1, "khz", "thousand per second"},
};

/* Pixels along a length of the subject. */
static const struct unit pixel_density_units[] = {
    {"px_mm", "px/mm", {1, 0}, 1, "px/mm pixel/mm pixels/mm", "pixel per millimetre"},
    {"px_m", "px/m", {1, -3}, 1, "px/m pixel/m pixels/m ppm PPM", "pixel per metre"},
    {"px_cm", "px/cm", {1, -1}, 1, "px/cm", "pixel per centimetre"},
    {"px_in", "px/in", {1, 0}, 1 / 25.4, "px/in ppi", "pixel per inch"},
    {"px_ft", "px/ft", {1, 0}, 1 / 304.8, "px/ft ppf PPF", "pixel per foot"},
};

static const struct unit pixel_units[] = {
    {"px", "px", {1, 0}, 1, "pixel pixels", "pixel"},
};

static const struct unit luminous_flux_units[] = {
    {"lm", "lm", {1, 0}, 1, "lumen lumens", "lumen"},
    {"klm", "klm", {1, 3}, 1, NULL, "thousand lumens"},
};

static const struct unit temperature_units[] = {
    {"C", "C", {1, 0}, 1, "\xc2\xb0\x43", "degree Celsius"},
};

static const struct unit pressure_units[] = {
    {"Pa", "Pa", {1, 0}, 1, NULL, "pascal"},
    {"hPa", "hPa", {1, 2}, 1, "mbar", "hectopascal"},
    {"kPa", "kPa", {1, 3}, 1, NULL, "kilopascal"},
    {"bar", "bar", {1, 5}, 1, NULL, "bar, 100 kPa"},
    {"atm", "atm", {101325, 0}, 1, NULL, "standard atmosphere, 101.325 kPa"},
};

static const struct unit colour_units[] = {
    {"K", "K", {1, 0}, 1, "kelvin", "kelvin"},
};

static const struct unit mass_units[] = {
    {"g", "g", {1, 0}, 1, "gram grams gramme grammes", "gram"},
    {"mg", "mg", {1, -3}, 1, NULL, "milligram"},
    {"kg", "kg", {1, 3}, 1, NULL, "kilogram"},
};

static const struct unit volume_units[] = {
    {"mm3", "mm\xc2\xb3", {1, 0}, 1, NULL, "cubic millimetre"},
    {"cm3", "cm\xc2\xb3", {1, 3}, 1, "cc", "cubic centimetre"},
};

static const struct unit storage_units[] = {
    {"B", "B", {1, 0}, 1, "byte bytes", "byte"},
    {"kB", "kB", {1, 3}, 1, NULL, "1000 bytes"},
    {"MB", "MB", {1, 6}, 1, NULL, "10^6 bytes"},
    {"GB", "GB", {1, 9}, 1, NULL, "10^9 bytes, as cards are sold"},
    {"TB", "TB", {1, 12}, 1, NULL, "10^12 bytes"},
    {"MiB", "MiB", {1048576, 0}, 1, NULL, "2^20 bytes"},
    {"GiB", "GiB", {1048576, 0}, 1024, NULL, "2^30 bytes"},
};

#define UNITS(array) .units = (array), .unit_count = COUNT(array)

const struct dimension dimension_number = {.name = "number", UNITS(number_units)};
const struct dimension dimension_length = {.name = "length",
                                           .fraction = true,
                                           .units = length_units,
                                           .unit_count = COUNT(length_units) - 1};
const struct dimension dimension_focal_length = {
    .name = "length", .fraction = true, UNITS(length_units)};
const struct dimension dimension_angle = {.name = "angle", UNITS(angle_units)};
const struct dimension dimension_time = {
    .name = "time", .fraction = true, .series = "shutters.tsv", UNITS(time_units)};
const struct dimension dimension_fnumber = {.name = "f-number",
                                            .prefixes = "f/ f: f t/ t \xc6\x92/ \xc6\x92 1:",
                                            .series = "fstops.tsv",
                                            UNITS(number_units)};
const struct dimension dimension_ratio = {
    .name = "ratio", .fraction = true, .ratio = true, UNITS(ratio_units)};
const struct dimension dimension_vergence = {.name = "vergence", UNITS(vergence_units)};

const struct dimension dimension_iso = {
    .name = "ISO speed", .prefixes = "iso asa ei", .series = "iso.tsv", UNITS(iso_units)};
const struct dimension dimension_ev = {.name = "exposure value", .prefixes = "ev", UNITS(ev_units)};
const struct dimension dimension_stops = {
    .name = "number of stops", .fraction = true, UNITS(stops_units)};
const struct dimension dimension_luminance = {.name = "luminance", UNITS(luminance_units)};
const struct dimension dimension_illuminance = {.name = "illuminance", UNITS(illuminance_units)};
const struct dimension dimension_exposure = {.name = "exposure", UNITS(exposure_units)};
const struct dimension dimension_speed = {.name = "speed", UNITS(speed_units)};
const struct dimension dimension_rotation = {.name = "rate of rotation", UNITS(rotation_units)};
const struct dimension dimension_frequency = {.name = "spatial frequency", UNITS(frequency_units)};
const struct dimension dimension_rate = {.name = "frame rate", UNITS(rate_units)};

const struct dimension dimension_pixel_density = {.name = "pixel density",
                                                  UNITS(pixel_density_units)};
const struct dimension dimension_pixels = {.name = "number of pixels", UNITS(pixel_units)};
const struct dimension dimension_luminous_flux = {.name = "luminous flux",
                                                  UNITS(luminous_flux_units)};

const struct dimension dimension_temperature = {.name = "temperature", UNITS(temperature_units)};
const struct dimension dimension_pressure = {.name = "pressure", UNITS(pressure_units)};
const struct dimension dimension_storage = {.name = "amount of data", UNITS(storage_units)};
const struct dimension dimension_colour = {.name = "colour temperature", UNITS(colour_units)};
const struct dimension dimension_mass = {.name = "mass", UNITS(mass_units)};
const struct dimension dimension_volume = {.name = "volume", UNITS(volume_units)};
const struct dimension dimension_wavelength = {.name = "wavelength", UNITS(length_units)};
const struct dimension dimension_wavelength_um = {.name = "wavelength", UNITS(wavelength_units)};

const struct dimension *const dimensions[] = {
    &dimension_length,    &dimension_angle,         &dimension_time,
    &dimension_fnumber,   &dimension_ratio,         &dimension_vergence,
    &dimension_number,    &dimension_iso,           &dimension_ev,
    &dimension_stops,     &dimension_luminance,     &dimension_illuminance,
    &dimension_exposure,  &dimension_speed,         &dimension_rotation,
    &dimension_frequency, &dimension_rate,          &dimension_pixel_density,
    &dimension_pixels,    &dimension_luminous_flux, &dimension_temperature,
    &dimension_pressure,  &dimension_storage,       &dimension_colour,
    &dimension_mass,      &dimension_volume,        NULL,
};

const struct unit *unit_find(const struct dimension *dimension, struct text name)
{
    for (size_t i = 0; i < dimension->unit_count; i++) {
        const struct unit *unit = &dimension->units[i];
        if (text_equal(name, unit->name) || text_lists(unit->spellings, name)) {
            return unit;
        }
    }
    return NULL;
}

/* 10^n for 0 <= n <= 12, exact. */
static double ten_to_the(int n)
{
    static const double powers[] = {1,   1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                    1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
    return powers[n];
}

bool unit_is_equivalent(const struct unit *unit)
{
    return unit == &length_units[COUNT(length_units) - 1];
}

bool unit_is_own(const struct unit *unit)
{
    return unit->scale.multiplier == 1 && unit->scale.power == 0 && unit->factor == 1;
}

double unit_to_own(const struct unit *unit, double value)
{
    int power = unit->scale.power;
    double scaled = value * unit->scale.multiplier;
    scaled = power >= 0 ? scaled * ten_to_the(power) : scaled / ten_to_the(-power);
    return scaled * unit->factor;
}

double unit_from_own(const struct unit *unit, double value)
{
    int power = unit->scale.power;
    double scaled = value / unit->factor;
    if (power < 0) {
        scaled *= ten_to_the(-power);
        return scaled / unit->scale.multiplier;
    }
    return scaled / (unit->scale.multiplier * ten_to_the(power));
}

bool unit_decimal_to_own(const struct unit *unit, double value, double slack, double *own)
{
    enum { PLACES = 9 };
    int places = PLACES;
    /* what is divided by a power of ten in the end is a whole number of 53 bits: one rounding */
    double size = fabs(value) * unit->scale.multiplier;
    while (places > 0 && !(size * ten_to_the(places) < 0x1p53)) {
        places--;
    }
    double whole = rint(value * ten_to_the(places));
    if (!(size * ten_to_the(places) < 0x1p53) ||
        !(fabs(whole / ten_to_the(places) - value) <= slack)) {
        return false;
    }
    double scaled = whole * unit->scale.multiplier;
    int power = unit->scale.power - places;
    if (power >= 0) {
        scaled *= ten_to_the(power);
    } else {
        int first = -power < PLACES ? -power : PLACES;
        scaled /= ten_to_the(first) * ten_to_the(-power - first);
    }
    *own = scaled * unit->factor + 0.0; /* -0 is 0 */
    return true;
}
