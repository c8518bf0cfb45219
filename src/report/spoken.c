/* report/spoken.c - quantities that people write in several units, or as fractions. */
/* SPDX-License-Identifier: MIT */
#include "report/spoken.h"

#include "base/number.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double MM_A_FOOT = 304.8, MM_AN_INCH = 25.4;

/* Cameras have 1/4 s and 0.3 s: here between. */
static const double LONGEST_FRACTION = 0.28;

static void write_plain(char *to, double value, int digits)
{
    *number_write_plain(to, value, digits, false) = '\0';
}

/* 0.5 s is 1/2 s, 0.4 s is no fraction. */
static bool is_one_over_whole(double value)
{
    double whole = round(1 / value);
    return value < 1 && whole < 1e6 && fabs(whole * value - 1) < 1e-12;
}

static void write_fraction(char *to, double value, int digits)
{
    char number[NUMBER_LENGTH + 1];
    double over = 1 / value;
    write_plain(number, is_one_over_whole(value) ? round(over) : over,
                is_one_over_whole(value) && digits < 7 ? 7 : digits);
    snprintf(to, SPOKEN_LENGTH, "1/%s", number);
}

void spoken_span(char *to, double seconds, int digits)
{
    if (seconds >= 59.9995 && seconds < 1e8) {
        /* "1 h 2 min 3 s" without the parts that are nothing. */
        int before = 3; /* digits before the point, at least */
        while (before < 9 && seconds >= pow(10, before)) {
            before++;
        }
        const int places = digits - 1 - before > 0 ? digits - 1 - before : 0;
        double step = pow(10, -places), whole = round(seconds / step) * step;
        double minutes = floor(whole / 60 + 1e-9), rest = whole - 60 * minutes;
        double hours = floor(minutes / 60);
        size_t used = 0;
        minutes -= 60 * hours;
        if (hours > 0) {
            used += (size_t)snprintf(to + used, SPOKEN_LENGTH - used, "%.0f h ", hours);
        }
        if (minutes > 0) {
            used += (size_t)snprintf(to + used, SPOKEN_LENGTH - used, "%.0f min ", minutes);
        }
        if (rest >= step / 2) {
            char number[NUMBER_LENGTH + 1];
            write_plain(number, rest, places + 2);
            used += (size_t)snprintf(to + used, SPOKEN_LENGTH - used, "%s s ", number);
        }
        to[used - 1] = '\0';
    } else {
        write_plain(to, seconds, digits);
        strcat(to, " s");
    }
}

void spoken_time(char *to, double seconds, int digits)
{
    if (seconds >= 1e-6 && (seconds < LONGEST_FRACTION || is_one_over_whole(seconds))) {
        write_fraction(to, seconds, digits);
        strcat(to, " s");
    } else {
        spoken_span(to, seconds, digits);
    }
}

void spoken_part(char *to, double value, int digits)
{
    if (value > 0 && value < 1) {
        write_fraction(to, value, digits);
    } else {
        snprintf(to, SPOKEN_LENGTH, value > 0 ? "1/1" : "0");
    }
}

int spoken_inch_places(double millimetres, int digits)
{
    double feet = fabs(millimetres) / MM_A_FOOT;
    int before = 1 + !(feet < 10) + !(feet < 100) + !(feet < 1000);
    return digits - before - 2;
}

void spoken_feet(char *to, double millimetres, int digits, int places)
{
    const char *sign = millimetres < 0 ? "-" : "";
    int decimals = places >= 0 ? places : spoken_inch_places(millimetres, digits);
    if (decimals < -1) {
        char number[NUMBER_LENGTH + 1];
        *number_write_plain(number, fabs(millimetres) / MM_A_FOOT, digits, true) = '\0';
        snprintf(to, SPOKEN_LENGTH, "%s%s'", sign, number);
        return;
    }
    decimals = decimals < 0 ? 0 : decimals;
    double step = pow(10, -decimals);
    double inches = round(fabs(millimetres) / MM_AN_INCH / step) * step;
    double whole = floor(inches / 12 + 1e-9);
    double rest = inches - 12 * whole;
    snprintf(to, SPOKEN_LENGTH, "%s%.0f' %.*f\"", sign, whole, decimals, rest < 0 ? 0 : rest);
}
