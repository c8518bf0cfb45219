/* tests/unit/test_zemax_words.c - .zmx files word by word: what each means, or why it is lost. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"

static const char good[] = "MODE SEQ\n"
                           "NAME Singlet\n"
                           "UNIT MM X W X CM MR CPMM\n"
                           "ENPD 10\n"
                           "FTYP 0 0 2 1 0 0 0\n"
                           "XFLN 0 0\n"
                           "YFLN 0 10\n"
                           "WAVM 1 0.5875618 1\n"
                           "PWAV 1\n"
                           "SURF 0\n"
                           "  TYPE STANDARD\n"
                           "  DISZ INFINITY\n"
                           "SURF 1\n"
                           "  STOP\n"
                           "  CURV 0.02\n"
                           "  DISZ 4\n"
                           "  GLAS ___BLANK 1 0 1.5 0\n"
                           "SURF 2\n"
                           "  CURV -0.02\n"
                           "  DISZ 90\n"
                           "SURF 3\n"
                           "  TYPE STANDARD\n"
                           "  DISZ 0\n";

/* Up to the glass, and the same with catalogues and a glass. */
#define BEFORE                                                                                     \
    "SURF 0\n  TYPE STANDARD\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS "
#define NO_GLASS              BEFORE "___BLANK 1 0 1.5 0"
#define WITH(catalogs, glass) "GCAT " catalogs "\n" BEFORE glass

static const struct meaning of_lens[] = {
    {"", "", "lens Singlet\nunit mm\nwavelength d\nobject inf\nfield angle 0 10\naperture epd 10"},
    {"", "", "focus table"},
    {"", "", "surface 50 4 1.5 - stop\nsurface -50 90 air -"},
    {"UNIT MM", "UNIT IN", "unit in"},
    /* text in quotes ends the numbers of a line, whatever it looks like */
    {"CURV -0.02", "CURV -0.02 0 0 0 0 \"1,5 by\" 0", "surface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 4 1 0 0 1 \"\"", "surface -50 90 air 8"},
    {"UNIT MM", "UNIT CM", "unit cm"},
    {"UNIT MM", "UNIT METER", "unit m"},
    {"NAME Singlet", "NAME", "unit mm\nwavelength d"},
    {"NAME Singlet", "NAME a\x8d\xe9", "lens a \xc3\xa9"}, /* no character of Windows-1252 */
    {"NAME Singlet", "NAME a \"b\" #c\nNOTE 0 first\nNOTE 4\nNOTE 0 second",
     "lens a \"b\" No.c\nnote first\nnote second"},
    {"ENPD 10", "FNUM 4 0", "aperture f/4"},
    {"ENPD 10", "FNUM 4", "aperture f/4"},
    {"ENPD 10", "FNUM 4 1", "aperture f/4"}, /* at infinity the working one is the same */
    {"ENPD 10", "OBNA 0.1 0", "aperture na 0.1"},
    {"ENPD 10", "ENPD 10\nPUPD 0 10", "aperture epd 10"},
    /* a thin lens of 50 mm: |u'| = y (1/50 - 1/200) = 3 D/400, N = 200/(3 D), D = 200/12 */
    {"ENPD 10\nFTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1\nSURF 0\n"
     "  TYPE STANDARD\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n",
     "FNUM 4 1\nSURF 0\n  DISZ 200\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 0\n",
     "aperture epd 16.6666666666667"},
    {"ENPD 10\n", "", "field angle 0 10\nfocus table"},
    {"FTYP 0 0 2 1 0 0 0", "FTYP 1 0 2 1 0 0 0", "field height 0 10"},
    {"FTYP 0 0 2 1 0 0 0", "FTYP 2 0 2 1 0 0 0", "field image 0 10"},
    {"FTYP 0 0 2 1 0 0 0", "FTYP 3 0 2 1 0 0 0", "field real 0 10"},
    {"XFLN 0 0\nYFLN 0 10", "XFLN 0 -7.5\nYFLN 0 10\nFWGN 1 0.5", "field angle 0 -7.5,10:0.5"},
    {"FTYP 0 0 2 1 0 0 0", "FTYP 0 0 2 1 0 0 1", "focus afocal"},
    {"XFLN 0 0\nYFLN 0 10", "XFLN 2.5 3", "field angle 2.5,0 3,0"},
    {"XFLN 0 0\nYFLN 0 10", "YFLN 0 110", "field angle 0 110"},
    {"FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10", "FTYP 0 0 2 1\nYFLN 0 10 20 0 0",
     "field angle 0 10"},
    {"FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10",
     "FTYP 0 0 14 1\nYFLN 0 1 2 3 4 5 6 7 8 9 10 11 12 13",
     "field angle 0 1 2 3 4 5 6 7 8 9 10 11 12 13"},
    {"XFLN 0 0\nYFLN 0 10", "XFLD 0 0\nYFLD 0 5", "field angle 0 5"},
    {"YFLN 0 10\n", "", "field angle 0 0"},
    {"FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1",
     "FTYP 0 0 2 3\nYFLN 0 10\nWAVM 1 0.4 1\nWAVM 2 0.5 2\nWAVM 3 0.6 1\nWAVM 4 0.7 1\nPWAV 2",
     "wavelength 0.5um:2 0.4um 0.6um"},
    {"FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1",
     "FTYP 0 0 2 3\nYFLN 0 10\nWAVL 0.4 0.5 0.6\nWWGT 1 0.5 1\nPWAV 3",
     "wavelength 0.6um 0.4um 0.5um:0.5"},
    {"FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1",
     "WAVM 1 0.4861327 1\nWAVM 2 0.55 1\nWAVM 3 0.55 1\nPWAV 1", "wavelength F 0.55um"},
    {"DISZ INFINITY", "DISZ 200\n  GLAS ___BLANK 1 0 1.333 55.5", "object 200\nmedium 1.333/55.5"},
    {"DISZ INFINITY", "DISZ 1e10", "object inf"},
    /* a cone of 30 degrees in air and in 1.5 */
    {"ENPD 10", "OBNA 30 1", "aperture na 0.49999999999999994"},
    /* an object in or behind planes that are nothing: 0 + 25, and -30 + 10 + 45.5 */
    {"DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n  "
     "CURV "
     "-0.02\n  DISZ 90\nSURF 3",
     "DISZ 0\nSURF 1\n  DISZ 25\n  DIAM 3\nSURF 2\n  STOP\n  CURV 0.02\n  DISZ 90\nSURF 3",
     "object 25"},
    {"DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n  "
     "CURV "
     "-0.02\n  DISZ 90\nSURF 3",
     "DISZ -30\nSURF 1\n  DISZ 10\nSURF 2\n  DISZ 45.5\nSURF 3\n  STOP\n  CURV 0.02\n  DISZ "
     "90\nSURF 4",
     "object 25.5"},
    /* the object in the first surface, and behind it in its own medium */
    {"DISZ INFINITY", "DISZ 0",
     "note the object lies in the first surface of the file: surface 1 is a plane 1 mm behind the "
     "object, from which rays go back"},
    {"DISZ INFINITY", "DISZ 0", "surface - -1 air -\nsurface 50 4 1.5 - stop"},
    {"DISZ INFINITY", "DISZ -12.5\n  GLAS ___BLANK 1 0 1.333 0", "object 1\nmedium 1.333"},
    {"DISZ INFINITY", "DISZ -12.5\n  GLAS ___BLANK 1 0 1.333 0",
     "surface - -13.5 1.333 -\nsurface 50 4 1.5 - stop"},
};

/* nd and Vd of the tables of lensdb; the material has to be the one that they describe. */
static const struct meaning of_glasses[] = {
    {NO_GLASS, WITH("SCHOTT HOYA CDGM", "F2 0 0 1.62004 36.366"), "surface 50 4 SCHOTT:F2 - stop"},
    {NO_GLASS, WITH("SCHOTT HOYA CDGM", "F2 0 0 1.62004 36.303"), "surface 50 4 HOYA:F2 - stop"},
    {NO_GLASS, WITH("SCHOTT HOYA CDGM", "F2 0 0 1.612929 36.986"), "surface 50 4 CDGM:F2 - stop"},
    {NO_GLASS, WITH("HOYA SCHOTT", "F2"), "surface 50 4 HOYA:F2 - stop"},
    {NO_GLASS, WITH("HOYA SCHOTT", "F2 0 0 1.5 40"), "surface 50 4 HOYA:F2 - stop"},
    {NO_GLASS, WITH("SCHOTT", "N-BK7 0 0 1.51685 64.11"), "surface 50 4 SCHOTT:N-BK7 - stop"},
    /* as the maker prints it, Vd to 0.1 */
    {NO_GLASS, WITH("SUMITA", "F1 0 0 1.62588 35.6"), "surface 50 4 SUMITA:F1 - stop"},
    /* HOYA has a BAF6, of nd 1.589003 and Vd 48.54: not what is meant */
    {NO_GLASS, WITH("CDGM", "BAF6 0 0 1.60801 46.21"), "surface 50 4 1.60801/46.21 - stop"},
    {NO_GLASS, WITH("CDGM", "BAF6 0 0 1.60801 46.21"),
     "note the glass 'BAF6' of nd 1.60801 and Vd 46.21 is in none of the file's catalogues (CDGM): "
     "nd and Vd are used instead"},
    /* the numbers beside a glass of the file's catalogues are left-overs of another one */
    {NO_GLASS, WITH("HOYA OHARA", "BAF6 0 0 1.60801 46.21"), "surface 50 4 HOYA:BAF6 - stop"},
    {NO_GLASS, WITH("HOYA OHARA", "BAF6 0 0 1.60801 46.21"),
     "note the glass 'BAF6' is HOYA:BAF6 of nd 1.589 and Vd 48.544, beside which the file has nd "
     "1.60801 and Vd 46.21: the catalogue's glass is used"},
    {NO_GLASS, WITH("SCHOTT", "SK2 0 0 1.61765 5.5139999E+1 -8.E-4 1 1 1 0 0"),
     "surface 50 4 SCHOTT:SK2 - stop"},
    {NO_GLASS, WITH("SCHOTT", "SK2 3 0 1.61765 5.5139999E+1"), "surface 50 4 SCHOTT:SK2 - stop"},
    /* those of a model glass count, whatever it is called */
    {NO_GLASS, WITH("SCHOTT", "SK2 1 0 1.61765 55.14"), "surface 50 4 1.61765/55.14 - stop"},
    {NO_GLASS, WITH("SCHOTT", "SK2 1 0 1.61765 55.14"),
     "note the glass 'SK2' is SCHOTT:SK2 of nd 1.60738 and Vd 56.65, beside which the file has nd "
     "1.61765 and Vd 55.14: it is a model glass, whose numbers are used"},
    {NO_GLASS, WITH("SCHOTT", "SK2 1 0 1.5 40"), "surface 50 4 1.5/40 - stop"},
    {NO_GLASS, WITH("SCHOTT", "N-BK7 1 0 1.5168 64.17"), "surface 50 4 1.5168/64.17 - stop"},
    {NO_GLASS, WITH("SCHOTT", "517642 1 0 1.6 50"), "surface 50 4 1.6/50 - stop"},
    /* a converter that is known to write a patent's numbers beside the nearest glass */
    {NO_GLASS, "VERS 161019 507 33785\n" WITH("SCHOTT", "N-LAF33 0 0 1.7859 44.3"),
     "surface 50 4 1.7859/44.3 - stop"},
    {NO_GLASS, "VERS 161019 507 33785\n" WITH("SCHOTT", "N-LAF33 0 0 1.7859 44.3"),
     "note the glass 'N-LAF33' is SCHOTT:N-LAF33 of nd 1.78582 and Vd 44.05, beside which the file "
     "has nd 1.7859 and Vd 44.3, where redukti's converter writes those of a patent: nd and Vd are "
     "used instead"},
    {NO_GLASS, "VERS 161019 507 33785\n" WITH("SCHOTT", "SF57 0 0 1.8467 23.8"),
     "surface 50 4 SCHOTT:SF57 - stop"}, /* rounded */
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS NOGLASS 0 0 1.6 50", "surface 50 4 1.6/50 - stop"},
    /* N-BK7 beyond 6e-5 and 0.1 % */
    {NO_GLASS, WITH("SCHOTT", "N-BK7 4 0 1.51688 64.167"), "surface 50 4 1.51688/64.167 - stop"},
    {NO_GLASS, WITH("SCHOTT", "N-BK7 4 0 1.5168 64.25"), "surface 50 4 1.5168/64.25 - stop"},
    /* within them, beyond the rounding */
    {NO_GLASS, WITH("SCHOTT", "N-BK7 0 0 1.51685 64.11"),
     "note the glass 'N-BK7' is SCHOTT:N-BK7 of nd 1.5168 and Vd 64.17, beside which the file has "
     "nd 1.51685 and Vd 64.11: the catalogue's glass is used"},
    /* editions and former names of catalogues */
    {NO_GLASS, WITH("CDGM-ZEMAX201409", "F2"), "surface 50 4 CDGM:F2 - stop"},
    {NO_GLASS, WITH("OLD_SCHOTT", "F2"), "surface 50 4 SCHOTT:F2 - stop"},
    {NO_GLASS, WITH("NIKON-HIKARI", "E-FKH1"), "surface 50 4 HIKARI:E-FKH1 - stop"},
    /* homonyms of Zemax's materials, unless the index says that lensdb's is meant */
    {NO_GLASS, WITH("MISC", "WATER 0 0 1.5 40"), "surface 50 4 MISC:WATER_HANDBOOK - stop"},
    {NO_GLASS, WITH("MISC", "WATER 0 0 1.333044 55.794"),
     "surface 50 4 MISC:WATER_HANDBOOK - stop"},
    {NO_GLASS, WITH("MISC", "WATER 0 0 1.333403 55.76"), "surface 50 4 MISC:WATER - stop"},
    {NO_GLASS, WITH("MISC", "PMMA 0 0 1.491756 57.441"), "surface 50 4 MISC:PMMA_HANDBOOK - stop"},
    {NO_GLASS, WITH("MISC", "PMMA 0 0 1.490595 58.005"), "surface 50 4 MISC:PMMA - stop"},
    {NO_GLASS, WITH("SCHOTT INFRARED", "F_SILICA"), "surface 50 4 MISC:FUSED_SILICA - stop"},
};

static const struct meaning of_surfaces[] = {
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS ___BLANK 1 0 1.6 50", "surface 50 4 1.6/50 - stop"},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS 517642", "surface 50 4 1.517/64.2 - stop"},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS N-BK7 0 0 1.5 40", "surface 50 4 SCHOTT:N-BK7 - stop"},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS AIR", "surface 50 4 air - stop"},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS MIRROR 0 0", "surface 50 4 mirror - stop"},
    {"CURV -0.02", "CURV 0", "surface - 90 air -"},
    {"CURV -0.02\n", "", "surface - 90 air -"},
    {"CURV -0.02", "CURV -0.0312345", "surface - 90 air - c=-0.0312345"},
    {"CURV -0.02", "CURV -0.02\n  CONI -0.5", "surface -50 90 air - k=-0.5"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 6.25 0", "surface -50 90 air 12.5"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 6\n  CLAP 0 5 0", "surface -50 90 air 10"},
    {"CURV -0.02", "CURV -0.02\n  OBDC 0 0", "surface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  CLAP 1 5 0", "surface -50 90 air 10\npass ring 2 10"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 9 1\n  CLAP 0 5 0\n  OBDC 1 -2",
     "surface -50 90 air 18\npass circle 10 decenter=1,-2"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 6 1\n  SQAP 1.5 5 0",
     "surface -50 90 air 12\npass rectangle 3 10"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 5 1\n  ELAP 1.5 5.5 0",
     "surface -50 90 air -\npass ellipse 3 11"},
    {"CURV -0.02", "CURV -0.02\n  DIAM 5 1\n  OBSC 0 2 0\n  OBDC 0.5 0",
     "surface -50 90 air 10\nblock circle 4 decenter=0.5,0"},
    {"CURV -0.02", "CURV -0.02\n  OBSC 1 2 0", "surface -50 90 air -\nblock ring 2 4"},
    {"CURV -0.02", "CURV -0.02\n  SQOB 1 2 0", "surface -50 90 air -\nblock rectangle 2 4"},
    {"CURV -0.02", "CURV -0.02\n  ELOB 1 2 0", "surface -50 90 air -\nblock ellipse 2 4"},
    {"CURV -0.02", "CURV -0.02\n  SPID 0.5 4 0", "surface -50 90 air -\nblock spider 0.5 4"},
    {"CURV -0.02", "CURV -0.02\n  COMM rear \"side\"", "surface -50 90 air - name=\"rear 'side'\""},
    {"CURV -0.02", "CURV -0.02\n  COAT AR", "note coating of surface 2: AR"},
    {"CURV -0.02", "TYPE EVENASPH\n  PARM 1 1e-3\n  PARM 2 2e-5\n  PARM 8 3e-20\n  PARM 3 0",
     "surface - 90 air - A2=1e-3 A4=2e-5 A16=3e-20"},
    {"CURV -0.02", "TYPE ODDASPHE\n  PARM 1 1e-3\n  PARM 2 2e-5\n  PARM 7 3e-10",
     "surface - 90 air - A1=1e-3 A2=2e-5 A7=3e-10"},
    /* alpha (r/r0)^(2 i): r0 = 10 */
    {"CURV -0.02", "TYPE XASPHERE\n  XDAT 1 3 0\n  XDAT 2 10 0\n  XDAT 4 5\n  XDAT 5 0",
     "surface - 90 air - A4=0.0005"},
    {"CURV -0.02", "TYPE XASPHERE\n  XDAT 1 1 0\n  XDAT 2 1 0\n  XDAT 3 5\n  XDAT 4 7",
     "surface - 90 air - A2=5"},
    {"CURV -0.02", "TYPE XOSPHERE\n  XDAT 1 3 0\n  XDAT 2 2 0\n  XDAT 3 1\n  XDAT 5 1",
     "surface - 90 air - A1=0.5 A3=0.125"},
    {"CURV -0.02", "TYPE TOROIDAL\n  CURV -0.02", "surface -50 90 air - cyl=y"},
    {"CURV -0.02", "TYPE TOROIDAL\n  CURV 0\n  PARM 1 40", "surface 40 90 air - cyl=x"},
    {"SURF 2\n  CURV -0.02\n", "SURF 2\n  TYPE TILTSURF\n  PARM 2 -1\n",
     "surface - 90 air - decenter=0,0 tilt=-45,0"},
    {"SURF 2\n  CURV -0.02\n", "SURF 2\n  TYPE TILTSURF\n  PARM 1 1\n",
     "surface - 90 air - decenter=0,0 tilt=0,-45"},
    /* a break bends the axis: decentre, then x, y, z; with PARM 6 the other way around */
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 2\n  TYPE COORDBRK\n  PARM 1 0.5\n  PARM 2 -1\n  PARM 3 2\n  PARM 4 -3\n  PARM 5 4\n"
     "  DISZ 0\nSURF 3\n  DISZ 90\nSURF 4",
     "bend decenter=0.5,-1 tilt=2,-3,4\nsurface - 90 air -"},
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 2\n  TYPE COORDBRK\n  PARM 2 -1\n  PARM 3 2\n  PARM 6 1\n  DISZ 0\n"
     "SURF 3\n  DISZ 90\nSURF 4",
     "bend decenter=0,0 tilt=2,0,0\nsurface - 0 1.5 -\nbend decenter=0,-1 tilt=0,0,0\n"
     "surface - 90 air -"},
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 2\n  TYPE COORDBRK\n  PARM 3 2\n  DISZ 5\nSURF 3\n  DISZ 90\nSURF 4",
     "bend decenter=0,0 tilt=2,0,0\nsurface - 5 1.5 -\nsurface - 90 air -"},
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 2\n  TYPE COORDBRK\n  DISZ 5\n  COMM arm\nSURF 3\n  DISZ 90\nSURF 4",
     "surface - 5 1.5 - name=\"arm\""},
    /* what says that there is nothing of the kind */
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 2\n  TYPE COORDBRK\n  PARM 1 0\n  PARM 6 1\n  DISZ 0\nSURF 3\n  CURV -0.02\n  DISZ 90\n"
     "SURF 4",
     "surface 50 4 1.5 - stop\nsurface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  SCBD 1 0 0 0 0 0 0 0", "surface -50 90 air -"},
    /* what has no effect of its own */
    {"CURV -0.02", "CURV -0.02\n  TYPE DGRATING\n  PARM 1 0.6\n  PARM 2 0", "surface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  TYPE FZERNSAG\n  PARM 1 0\n  XDAT 1 2\n  XDAT 2 10\n  XDAT 3 0",
     "surface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  SCBD 1 0 0 1 2 3 4 5",
     "bend decenter=1,2 tilt=3,4,5\nsurface -50 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  SCBD 1 0 0 1 0 3 0 0\n  SCBD 2 0 1 0 0 0 0 0",
     "bend decenter=1,0 tilt=3,0,0\nsurface -50 0 air -\nbend decenter=1,0 tilt=3,0,0\n"
     "surface - 90 air -"},
    {"CURV -0.02", "CURV -0.02\n  SCBD 1 0 0 1 0 3 0 0\n  SCBD 2 0 2 0 0 0 0 0",
     "bend decenter=1,0 tilt=3,0,0\nsurface -50 0 air -\nbend decenter=0,0 tilt=-3,0,0\n"
     "surface - 0 air -\nbend decenter=-1,0 tilt=0,0,0\nsurface - 90 air -"},
    {"SURF 3\n", "SURF 3\n  SCBD 1 0 0 0 0 90 0 0\n",
     "surface -50 90 air -\nbend decenter=0,0 tilt=90,0,0\nsurface - 0 air -"},
    {"NAME Singlet", "NAME Singlet\nGFAC 0 2", "aperture epd 10"},
    {"NAME Singlet", "NAME Singlet\nGFAC 1 0", "aperture epd 10"},
    {"NAME Singlet", "NAME Singlet\nGFAC 1 2",
     "note apodisation of the pupil, GFAC 1 2: here its rays weigh the same"},
    {"NAME Singlet", "NAME Singlet\nGFAC 2 0",
     "note apodisation of the pupil, GFAC 2 0: here its rays weigh the same"},
    {"NAME Singlet", "NAME Singlet\nFCOM 1 \xc3\xa4\nRCMF 25 0", "aperture epd 10"},
    {"NAME Singlet", "NAME Singlet\nVCYN 0 0\nZVDY 0", "aperture epd 10"},
    {"DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n",
     "DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n  DIAM 6\nSURF 2\n  DIAM 5\nVCYN 0 0.1\n",
     "note vignetting factors of the fields: the clear diameters limit the beams"},
    {"CURV -0.02", "CURV -0.02\n  WXYZ 0 0",
     "note line 20: WXYZ is unknown; its numbers are 0, it was passed over"},
    /* numbers of surfaces with gaps, and what is said of them by number */
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3", "SURF 5\n  CURV -0.02\n  DISZ 90\nSURF 9",
     "surface 50 4 1.5 - stop\nsurface -50 90 air -"},
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "SURF 5\n  CURV -0.02\n  DISZ 90\nSURF 9\nMNUM 2 1\nTHIC 5 1 90\nTHIC 5 2 80\n",
     "let d2 90 80"},
    {"WAVM 1 0.5875618 1", "WAVM 1 3000 1", "wavelength 3000um"},
    /* the merit function, of a word that no one knows; one configuration has its values already */
    {"TYPE STANDARD\n  DISZ 0\n",
     "DISZ 0\nQQQQ 1 2 0 0 0 0 0.5 1 0 0\nTOL QQQQ 1 2\nMNUM 1 1\n"
     "EDVA 2 1 7 0 1\nAPMN 2 1 3\nQQQQ 2 1 5\n",
     "surface -50 90 air -"},
};

/* a plane z = y tan b turns about x by b */
static const struct meaning of_images[] = {
    {"  TYPE STANDARD\n  DISZ 0\n", "  TYPE TILTSURF\n  PARM 1 0\n  PARM 2 1\n  DISZ 0\n",
     "surface -50 90 air -\nbend decenter=0,0 tilt=45,0,0\nsurface - 0 air -"},
    {"  TYPE STANDARD\n  DISZ 0\n", "  TYPE TILTSURF\n  PARM 1 0\n  PARM 2 0\n  DISZ 0\n",
     "surface -50 90 air -"},
};

static const struct meaning of_solves[] = {
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3",
     "SURF 5\n  CURV -0.02\n  DISZ 90\n  PZUP 1 2\nSURF 9",
     "note line 21: what follows another surface, in a file whose surface numbers have gaps; the "
     "file's number is kept"},
    {"DISZ 90", "DISZ 0\n  PZUP 1 2 0.5", "surface -50 8.5 air -"},
    {"ENPD 10\nFTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1\nSURF 0\n"
     "  TYPE STANDARD\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n",
     "FNUM 4 1\nSURF 0\n  DISZ 200\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  MAZH 3 0\n",
     "surface 50 4 1.5 - stop"},
    {"DISZ 90", "DISZ 0\n  PZUP 1 2.5", "surface -50 10 air -"},
    {"DISZ 90", "DISZ 0\n  TCOM 1 20", "surface -50 16 air -"},
    {"DISZ 90", "DISZ 0\n  TOLE 1 50", "surface -50 46 air -"},
};

static const struct meaning of_positions[] = {
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nTHIC 2 1 90\nTHIC 2 2 80\n",
     "position 1 2\nlet d2 90 80"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nTHIC 2 1 80\nTHIC 2 2 80\n",
     "surface -50 80 air -"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nTHIC 0 1 1e10\nTHIC 0 2 500\n",
     "let object inf 500"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nAPER 0 1 10\nAPER 0 2 5\n",
     "let aperture epd 10 epd 5"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nSDIA 1 1 6\nSDIA 1 2 5\n", "let D1 12 10"},
    {"TYPE STANDARD\n  DISZ 0\n",
     "DISZ 0\nMNUM 2 1\nYFIE 2 1 10\nYFIE 2 2 7.5\nXFIE 2 2 1\nFLWT 1 2 0.5\n",
     "set field 0;10 0:0.5;1,7.5"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nWAVE 7 1 0.5\nWAVE 7 2 0.6\n", "position 1 2"},
    /* behind the value its status, then the number of the parameter */
    {"CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "TYPE EVENASPH\n  CURV -0.02\n  PARM 2 1e-6\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\n"
     "PRAM 2 1 2e-6 0 2 0 1 1 1 0 0\nPRAM 2 2 3e-6 0 2 0 1 1 1 0 0\n"
     "PRAM 2 1 4e-9 0 3 0 1 1 1 0 0\nPRAM 2 2 4e-9 0 3 0 1 1 1 0 0\n",
     "set A4_2 2e-6 3e-6"},
    {"CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "TYPE XASPHERE\n  CURV -0.02\n  XDAT 1 2\n  XDAT 2 1\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\n"
     "EDVA 2 1 2e-6 0 4 0 1 1 1 0 0\nEDVA 2 2 3e-6 0 4 0 1 1 1 0 0\n",
     "set A4_2 2e-6 3e-6"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nYFIE 1 1 0\nYFIE 1 2 0\n", "position 1 2"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nYFIE 2 1 7\nYFIE 2 2 7\n", "field angle 0 7"},
    {"TYPE STANDARD\n  DISZ 0\n",
     "DISZ 0\nMNUM 2 1\nXFIE 2 1 3\nXFIE 2 2 3\nFLWT 2 1 0.5\n"
     "FLWT 2 2 0.5\nFLWT 1 1 1\nFLWT 1 2 1\n",
     "field angle 0 3,10:0.5"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nFLTP 0 1 2\nFLTP 0 2 2\n", "field image 0 10"},
    {"CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "CURV -0.02\n  DIAM 6\n  CLAP 0 5 0\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\nAPMX 2 1 5\n"
     "APMX 2 2 4\nAPMN 2 1 0\nAPMN 2 2 0\n",
     "let D2 10 8"},
    {"CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "CURV -0.02\n  DIAM 6\n  SQAP 4 5 0\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\nAPDX 2 1 1\n"
     "APDX 2 2 1\n",
     "pass rectangle 8 10 decenter=1,0"},
    /* temperatures act on indices where ENVD says so, and not on model glasses */
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nTEMP 0 1 20\nTEMP 0 2 60\n",
     "surface 50 4 1.5 - stop\nsurface -50 90 air -"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 1 1\nCRVT 1 1 0.5\nEFFL 1 2\n",
     "surface 50 4 1.5 - stop"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nNOTE 0 lenscalc positions wide tele\nMNUM 2 1\n",
     "position wide tele"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nNOTE 0 lenscalc positions wide\nMNUM 2 1\n",
     "position 1 2"},
};

static const struct refusal losses[] = {
    {"CURV -0.02", "CURV -0.02\n  @SCBD 2 0 3 0 0 0 0 0",
     "SCBD: a shift or turn behind a surface that follows another surface", ""},
    {"CURV -0.02", "CURV -0.02\n  @SCBD 3 0 0 0 0 0 0 0",
     "SCBD is of 1, before the surface, or of 2, behind it", ""},
    {"SURF 0", "@SURF 0\n  SCBD 1 0 0 0 0 0 3 0", "SCBD: a shifted or tilted object",
     "taken across the axis"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 1 1\n@IGNR 2 1 1\n",
     "IGNR: a surface that is left out", ""},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\n@PRAM 2 1 7 0 13\n",
     "a parameter that no surface of lenscalc has", ""},
    {"TYPE STANDARD\n  DISZ INFINITY", "@TYPE TILTSURF\n  PARM 2 0.1\n  DISZ INFINITY",
     "a tilted object", "taken across the axis"},
    {"TYPE STANDARD\n  DISZ INFINITY", "@TYPE EVENASPH\n  PARM 2 0.1\n  DISZ INFINITY",
     "a curved object", "taken for a plane"},
    {"  TYPE STANDARD\n  DISZ 0", "  @TYPE EVENASPH\n  PARM 2 0.1\n  DISZ 0", "a curved image",
     "taken for a plane"},
    {"ENPD 10\nFTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1\nSURF 0\n"
     "  TYPE STANDARD\n  DISZ INFINITY\nSURF 1\n  STOP\n",
     "@FNUM 4 1\nSURF 0\n  DISZ 200\nSURF 1\n", "a working f-number that no entrance pupil gives",
     "the lens gets no aperture"},
    {"TYPE STANDARD\n  DISZ 0\n", "DISZ 0\nMNUM 2 1\nQQQQ 2 1 7\n@QQQQ 2 2 8\n",
     "QQQQ 2 changes between the configurations",
     "what the surfaces and the system of the file say is kept"},
    {"CURV -0.02", "CURV -0.02\n  @WXYZ 0 0\nMNUM 2 1", "unknown word 'WXYZ'", ""},
    {"NAME", "@QQQQ 1\nNAME", "unknown word 'QQQQ'", ""},
    {"FTYP 0 0 2 1", "@FTYP 4 0 2 1", "fields of the kind 4", "left out"},
    {"NAME", "VDYN 0 @0.1\nNAME", "VDYN: vignetting factors of the fields", ""},
    {"FTYP 0 0 2 1", "@FTYP 0 1 2 1", "a telecentric object space of an object at infinity",
     "an ordinary one"},
    {"ENPD 10", "@FLOA", "the aperture is that of the stop, which has no diameter",
     "the lens gets none"},
    {"TYPE STANDARD\n  DISZ INFINITY", "TYPE STANDARD\n  @CURV 0.1", "a curved object",
     "taken for a plane"},
    {"  TYPE STANDARD\n  DISZ 0", "  @CURV 0.1\n  DISZ 0", "a curved image", "taken for a plane"},
    {"CURV -0.02", "@FLAP 1 5 0", "a floating aperture with a hole", "the hole is left out"},
    {"CURV -0.02", "@USAP slit.uda",
     "USAP: the aperture of the file 'slit.uda' (files beside it are not read)", "left out"},
    {"CURV -0.02", "@SQAP 0 5 0", "SQAP: an aperture that is none", "left out"},
    {"CURV -0.02", "@SPID 1 2.5 0", "SPID: an aperture that is none", "left out"},
    {"CURV -0.02", "@OBDC 1 0", "a decentre of an aperture that is not stated", "left out"},
    {"CURV -0.02", "@PARM 13 1", "a parameter that no surface of lenscalc has", ""},
    {"CURV -0.02", "TYPE @DGRATING\n  PARM 1 0.6\n  PARM 2 1\n  CURV -0.02",
     "a surface of the type DGRATING",
     "its standard form with curvature and conic is used instead"},
    {"SURF 2\n  CURV -0.02", "SURF 2\n  @TYPE TOROIDAL\n  CURV 0.02\n  PARM 1 40", "a toroid",
     "its y-z section is used instead, as a cylinder"},
    {"SURF 2\n  CURV -0.02", "SURF 2\n  @TYPE TOROIDAL\n  PARM 2 1e-5", "a toroid",
     "its y-z section is used instead, as a cylinder"},
    {"CURV -0.02", "TYPE XASPHERE\n  XDAT 1 11\n  XDAT 2 1\n  @XDAT 13 1",
     "the coefficient A22: lenscalc goes up to A20", ""},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS @___BLANK 1 0 1.5 60 0.01",
     "the deviation 0.01 of the partial dispersion PgF", ""},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS @N-BK7 4 0 1.5168 64.17 0 0 0 0 0.001",
     "a glass with an offset of its index or dispersion", ""},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS @N-BK7 9 0 1.5168 64.17", "a glass of the type 9",
     "its name is looked up"},
    /* what a solve gives is not what the program has stored */
    {"DISZ 90", "DISZ 12\n  @PZUP 1 2.5",
     "a solve contradicts the lens that is read: the thickness of surface 2 is 10 by it, and 12 in "
     "the file",
     "the file's number is kept"},
    {"CURV -0.02", "@CURV -0.03 4 1 -1 0",
     "a solve contradicts the lens that is read: the curvature of surface 2 is -0.02 by it, and "
     "-0.03 in the file",
     "the file's number is kept"},
    {"CURV -0.02", "CURV -0.02\n  GLAS @___BLANK 2 5 1.5 0",
     "a glass that follows no earlier surface", "the file's glass is kept"},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2 1\nFLTP 0 1 0\nFLTP 0 2 2\n",
     "the kind of the fields differs between the configurations", "those of the first are kept"},
    {"CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n",
     "CURV -0.02\n  SQAP 5 6 0\n  DISZ 90\nSURF 3\n  DISZ 0\nMNUM 2 1\nAPMN 2 1 5\nAPMN 2 2 4\n",
     "the apertures of surface 2 differ between the configurations", "those of the first are kept"},
    {"CURV -0.02", "CURV -0.02\n  YDAT 0 @0,5",
     "YDAT: extra data of toroids and pick-ups of old files", ""},
    {"CURV -0.02", "CURV -0.02\n  @WXYZ 0 0,5", "unknown word 'WXYZ'", ""},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2 1\n@APMX 2 2 4\n",
     "APMX of an aperture that is not stated", "left out"},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2 1\nSDIA 1 1 6\n",
     "the clear aperture that surface 1 has in some configurations", "it gets none"},
};

static const struct refusal errors[] = {
    {"SURF 2\n", "SURF 2\n  OBSC 0 1 0\n  TYPE @USERSURF 0 \"us_x.dll\"\n",
     "a surface computed by a program (DLL) of the user's, which the file does not hold", NULL},
    {"MODE SEQ", "MODE @NSC",
     "a non-sequential system: lenscalc has lenses whose surfaces follow each other", NULL},
    {"UNIT MM", "UNIT @FT", "the unit is one of MM, CM, IN, METER", NULL},
    {"ENPD 10", "ENPD @x", "ENPD needs a number", NULL},
    {"ENPD 10", "@ENPD", "ENPD needs a number", NULL},
    {"ENPD 10", "ENPD @-1", "the aperture must be above 0", NULL},
    {"YFLN 0 10", "YFLN 0 @200", "a field angle is not beyond 180 degrees", NULL},
    {"WAVM 1 0.5875618 1", "@WAVM 0 0.5 1", "WAVM needs the number, the wavelength and its weight",
     NULL},
    {"WAVM 1 0.5875618 1", "@WAVM 1", "WAVM needs the number, the wavelength and its weight", NULL},
    {"WAVM 1 0.5875618 1", "WAVM 1 @550000 1", "the wavelength is not within 0.001 to 100000 um",
     NULL},
    {"WAVM 1 0.5875618 1", "WAVL 0.5 @0", "the wavelength is not within 0.001 to 100000 um", NULL},
    {"PWAV 1", "@PWAV 0", "PWAV needs a wavelength's number", NULL},
    {"PWAV 1", "@PWAV 2", "the primary wavelength is number 2 of 1", NULL},
    {"WAVM 1 0.5875618 1\nPWAV 1", "WAVM 1 0.55 -1\n@PWAV 1",
     "wavelength 1 is missing, or its weight is below 0", NULL},
    {"PWAV 1", "PWAV 1\n@DISZ 5", "'DISZ' stands before any surface", NULL},
    {"SURF 1", "@SURF 0", "SURF 1 is expected here", NULL},
    {"SURF 1", "@SURF 1.5", "SURF 1 is expected here", NULL},
    {"SURF 0", "@SURF 1", "SURF 0 is expected here", NULL},
    {"SURF 1", "@SURF", "SURF 1 is expected here", NULL},
    {"SURF 0", "@SURF 0\n  STOP", "the object is the stop", NULL},
    {"SURF 3", "@SURF 3\n  STOP", "the image is the stop", NULL},
    {"SURF 2", "@SURF 2\n  STOP", "a second stop", NULL},
    {"DISZ 4", "DISZ @INFINITY", "an infinite distance behind surface 1", NULL},
    {"DISZ 4", "DISZ @far", "DISZ needs a number", NULL},
    {"CURV -0.02", "@CURV", "CURV needs a number", NULL},
    {"CURV -0.02", "CONI @x", "CONI needs a number", NULL},
    {"CURV -0.02", "DIAM @x", "DIAM needs a number", NULL},
    {"CURV -0.02", "CLAP @x", "CLAP needs a number", NULL},
    {"CURV -0.02", "@PARM 1", "PARM needs a number and a value", NULL},
    {"CURV -0.02", "@XDAT -1 5", "XDAT needs a number and a value", NULL},
    {"CURV -0.02", "TYPE @NONSEQCO",
     "a non-sequential group: lenscalc has lenses whose surfaces follow each other", NULL},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS@", "the glass is missing", NULL},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS @___BLANK 1 0 0 0", "a model glass without an index", NULL},
    {"ENPD 10", "OBNA @90 1", "the angle of the cone must be below 90 degrees", NULL},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS ___BLANK 1 0 1.5 @-5", "the Abbe number is below 0", NULL},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS @NOGLASS 0 0 1.5 40",
     "the glass 'NOGLASS' is in no catalogue, and the file has no index of it", NULL},
    {NO_GLASS, WITH("CDGM MISC", "@BAF6 0 0 1.5 40"),
     "the glass 'BAF6' is in none of the file's catalogues (CDGM, MISC), and the file has no index "
     "of it",
     NULL},
    /* a word that is no number, among numbers, in every line that has them */
    {"XFLN 0 0", "XFLN 0 0@,5", "the value behind XFLN '0,5' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 @nan 3", "the value behind YFLN 'nan' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 @-inf", "the value behind YFLN must be finite and below 1e100", NULL},
    {"YFLN 0 10", "YFLN 0@x1p3 10", "the value behind YFLN '0x1p3' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 1@d5", "the value behind YFLN '1d5' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 @1e308", "the value behind YFLN must be finite and below 1e100", NULL},
    {"YFLN 0 10", "YFLN 0 10\nFWGN 1 @x", "the value behind FWGN 'x' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 10\nVDYN 0 0@,1", "the value behind VDYN '0,1' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 10\nGFAC 0 @x", "the value behind GFAC 'x' is not a number", NULL},
    {"YFLN 0 10", "YFLN 0 10\nENVD 20 1@,0 0", "the value behind ENVD '1,0' is not a number", NULL},
    {"FTYP 0 0 2 1", "FTYP 0 12@x3 2 1", "the value behind FTYP '12x3' is not a number", NULL},
    {"ENPD 10", "ENPD 10 @x", "the value behind ENPD 'x' is not a number", NULL},
    {"0.5875618 1\n", "0.5875618 1@,0\n", "the value behind WAVM '1,0' is not a number", NULL},
    {"WAVM 1 0.5875618 1", "WAVL 0.5 0@,6", "the value behind WAVL '0,6' is not a number", NULL},
    {"PWAV 1", "PWAV 1 @x", "the value behind PWAV 'x' is not a number", NULL},
    {"CURV -0.02", "CURV -0.02 1@,0 0", "the value behind CURV '1,0' is not a number", NULL},
    {"CURV -0.02", "CONI -1 @x", "the value behind CONI 'x' is not a number", NULL},
    {"CURV -0.02", "DIAM 5 @x 0 0 1 \"\"", "the value behind DIAM 'x' is not a number", NULL},
    {"CURV -0.02", "CLAP 0 5 0@,1", "the value behind CLAP '0,1' is not a number", NULL},
    {"CURV -0.02", "FLAP 0 5@,1", "the value behind FLAP '5,1' is not a number", NULL},
    {"CURV -0.02", "OBDC 0 0@,1", "the value behind OBDC '0,1' is not a number", NULL},
    {"CURV -0.02", "PARM 1 1@,5", "the value behind PARM '1,5' is not a number", NULL},
    {"CURV -0.02", "SCBD 1 0 0 1@,5", "the value behind SCBD '1,5' is not a number", NULL},
    {"DISZ 90", "DISZ 90 1@,5", "the value behind DISZ '1,5' is not a number", NULL},
    {"DISZ 90", "DISZ 90\n  MAZH 0@,5 0", "the value behind MAZH '0,5' is not a number", NULL},
    {"GLAS ___BLANK 1 0 1.5 0", "GLAS ___BLANK 1 0 1.5 47@,1",
     "the value behind GLAS '47,1' is not a number", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2@,5\n",
     "the value behind MNUM '2,5' is not a number", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\nTHIC 2 1 7 @x\n",
     "the value behind THIC 'x' is not a number", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\nTHIC 2 1 7@,5\n",
     "the value behind THIC '7,5' is not a number", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\n@MNUM 0\n",
     "MNUM needs the number of configurations, 1 to 100", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\n@THIC 1 3 5\n",
     "THIC needs a surface, a configuration and its value", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\n@PRAM 2 1 7 0\n",
     "PRAM needs a surface, a configuration, its value and behind a status the number of the "
     "parameter",
     NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\n@TEMP 0 2 -300\n",
     "a temperature is above -273.15 C, a pressure 0 or more atmospheres", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\nYFIE @0 2 3\n",
     "fields have the numbers 1 to 64", NULL},
    {"  TYPE STANDARD\n  DISZ 0\n", "  DISZ 0\nMNUM 2\nAPER 0 1 @0\n",
     "the aperture must be above 0", NULL},
    {"SURF 2\n  CURV -0.02\n  DISZ 90\nSURF 3\n  TYPE STANDARD\n  DISZ 0\n", "",
     "the file has no surface between object and image", NULL},
};

int main(void)
{
    check_meanings("lens.zmx", good, CASES(of_lens));
    check_meanings("glasses.zmx", good, CASES(of_glasses));
    check_meanings("surfaces.zmx", good, CASES(of_surfaces));
    check_meanings("images.zmx", good, CASES(of_images));
    check_meanings("solves.zmx", good, CASES(of_solves));
    check_meanings("positions.zmx", good, CASES(of_positions));
    check_refusals("lost.zmx", good, CASES(losses));
    check_refusals("bad.zmx", good, CASES(errors));
    return check_report();
}
