/* tests/unit/test_codev.c - CODE V sequence files: what each command means, or why it is lost. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_change.h"
#include "foreign_cases.h"

static const char good[] = "RDM;LEN\n"
                           "TITLE 'Singlet'\n"
                           "EPD 10\n"
                           "WL 587.5618\n"
                           "YAN 0 10\n"
                           "SO 0 1e13\n"
                           "S 50 4 517642\n"
                           "STO\n"
                           "S -50 90\n"
                           "SI 0 0\n"
                           "GO\n";

#define NO_RDM(what)                                                                               \
    "without RDM the number of a surface is its curvature, but " what                              \
    " fits a radius of 50 mm better than one of 0.02 mm"

static const struct meaning of_lens[] = {
    {"", "", "lens Singlet\nunit mm\nwavelength 587.5618nm\nobject inf\nfield angle 0 10"},
    {"", "", "aperture epd 10\nfocus table"},
    {"", "", "surface 50 4 1.517/64.2 - stop\nsurface -50 90 air -"},
    {"SO 0 1e13", "SO 0 inf", "object inf"},
    {"SO 0 1e13", "SO 0 1e13; THI SO Infinity", "object inf"},
    {"EPD 10", "TEM 20\nPRE 760\nEPD 10; &", "aperture epd 10"},
    {"EPD 10", "EPD 10; & ! more\n\n ; &\n", "aperture epd 10"},
    {"'Singlet'", "\"it's\"", "lens it's"},
    {"'Singlet'", "'a\x02 #1'", "lens a No.1"},
    {"STO", "STO\nSLB 'a\x02z'", "surface 50 4 1.517/64.2 - stop name=\"a z\""},
    {"'Singlet'", "\"\"a name\"\"", "lens a name"},
    {"TITLE", "tit", "lens Singlet"},
    {"EPD", "DIM C\nEPD", "unit cm"},
    {"EPD", "dim in\nEPD", "unit in"},
    {"GO\n", "DIM I ! behind the lengths\n", "unit in"},
    {"WL 587.5618", "WL 656.3 587.6 486.1\nWTW 1 2 0.5",
     "wavelength 587.6nm:2 656.3nm 486.1nm:0.5"},
    {"WL 587.5618", "WL 656.3 &\n 587.6 486.1\nREF 3", "wavelength 486.1nm 656.3nm 587.6nm"},
    {"WL 587.5618\n", "", "unit mm\nobject inf"},
    {"EPD 10", "FNO 4", "aperture f/4"},
    {"EPD 10", "NA 0.25", "aperture f/2"}, /* N = 1/(2 NA') */
    /* a mirror of f = -50 mm: |u'| = y (1/50 - 1/200) = 3 D/400, N = 200/(3 D), D = 200/12 */
    {"EPD 10\nWL 587.5618\nYAN 0 10\nSO 0 1e13\nS 50 4 517642", "FNO 4\nSO 0 200\nS -100 4 REFL",
     "aperture epd 16.6666666666667"},
    {"EPD 10", "NAO 0.1", "aperture na 0.1"},
    {"EPD 10\n", "", "field angle 0 10\nfocus table"},
    {"YAN 0 10\n", "", "object inf\naperture epd 10"},
    {"YAN 0 10", "YAN 0 -10\nXAN 0 0", "field angle 0 -10"},
    {"YAN 0 10", "YOB 0 -7.5", "field height 0 -7.5"},
    {"YAN 0 10", "YIM 0 21.6", "field image 0 21.6"},
    {"YAN 0 10", "YRI 0 7.25", "field real 0 7.25"},
    {"YAN 0 10", "XRI 3 0\nYRI 0 7.25", "field real 3,0 7.25"},
    {"YAN 0 10", "XAN 0 -2.5\nYAN 0 10", "field angle 0 -2.5,10"},
    {"YAN 0 10", "XOB 0 2.5 4\nYOB 0 10\nWTF 1 0.5 1", "field height 0 2.5,10:0.5 4,0"},
    {"YAN 0 10", "XIM 0 2.5", "field image 0 2.5,0"},
    {"YAN 0 10", "YAN 0 110", "field angle 0 110"},
    {"YAN 0 10", "YAN 0 10\nVUY 0 0\nVLX F2 0", "field angle 0 10"},
    {"SO 0 1e13", "SO 0 200 1.333:55", "object 200\nmedium 1.333/55"},
    {"SO 0 1e13", "S0 0 1e10", "object inf"},
    {"SI 0 0", "SI 0 -0.5", "surface -50 89.5 air -"}, /* the image is displaced */
    {"SI 0 0", "PIM\nSI 0 0", "focus paraxial"},
    {"SI 0 0", "REF 1; CCY 0 ; THC S1 0 ; TOL 3 ; WTF 1 2; SAV 'x'\nSI 0 0", "focus table"},
    {"SI 0 0", "SI 0 0\nZOO 1", "focus table"},
    /* what lenscalc keeps in comments */
    {"GO", "! lenscalc: source a book\n! lenscalc: kind triplet", "kind triplet\nsource a book"},
    {"GO", "! lenscalc: note one\n! lenscalc: note two", "note one\nnote two"},
    {"GO", "! lenscalc: stated efl 95.5\n! lenscalc: stated fnumber 4",
     "stated efl 95.5\nstated fnumber 4"},
    {"GO", "! lenscalc: stated bfl -3 4", "focus table\n# radius thickness medium diameter"},
    {"GO", "! lenscalc: stated bfl x", "focus table\n# radius thickness medium diameter"},
    {"GO", "CIR S1 6\n! lenscalc: the stop's diameter rules, not EPD", "aperture stop"},
};

static const struct meaning of_surfaces[] = {
    {"S 50 4", "S1 50 4", "surface 50 4 1.517/64.2 - stop"},
    {"S 50", "s 50", "surface 50 4 1.517/64.2 - stop"},
    {"517642", "517800.642000", "surface 50 4 1.517800/64.2000 - stop"},
    {"517642", "NBK7_SCHOTT", "surface 50 4 SCHOTT:N-BK7 - stop"},
    {"517642", "AIR", "surface 50 4 air - stop"},
    {"517642", "REFR 517642", "surface 50 4 1.517/64.2 - stop"},
    {"517642", "REFL", "surface 50 4 mirror - stop"},
    {"STO", "STO\nRMD REFL", "surface 50 4 mirror - stop"},
    {"STO", "STO\nGLA S1 1.6", "surface 50 4 1.6 - stop"},
    /* glasses that begin like a field, a wavelength or a position, and ranges of surfaces */
    {"STO", "STO\nGLA S1 F2_SCHOTT", "surface 50 4 SCHOTT:F2 - stop"},
    {"STO", "STO\nGLA F2_SCHOTT", "surface 50 4 SCHOTT:F2 - stop"},
    {"STO", "STO\nPRV;PWL 500;F2 1.7;S1 1.6;Z1 1.8;END;GLA F2", "surface 50 4 1.7 - stop"},
    {"STO", "STO\nPRV;PWL 500;F2 1.7;S1 1.6;Z1 1.8;END;GLA S1 S1", "surface 50 4 1.6 - stop"},
    /* a private glass by the name of a catalogue's: n_F of N-BK7 is 1.52238 */
    {"STO", "STO\nPRV;PWL 486.1327;'NBK7_SCHOTT' 1.6;END;GLA 'NBK7_SCHOTT'",
     "surface 50 4 1.6 - stop"},
    {"STO", "STO\nPRV;PWL 486.1327;'NBK7_SCHOTT' 1.6;END;GLA 'NBK7_SCHOTT'",
     "note the glass 'NBK7_SCHOTT' is SCHOTT:N-BK7 of the index 1.522376 at 0.486133 um, beside "
     "which the file has 1.6: the file's indices are used"},
    {"STO", "STO\nPRV;PWL 486.1327;'NBK7_SCHOTT' 1.52238;END;GLA 'NBK7_SCHOTT'",
     "lens Singlet\nunit mm"}, /* rounded: no note */
    {"STO", "STO\nPRV;PWL 500;'ENDER' 1.7;'PWL' 1.6;END;GLA ENDER", "surface 50 4 1.7 - stop"},
    {"GO", "SLB S2 F1", "surface -50 90 air - name=\"F1\""},
    {"GO", "CIR S1..2 6;THI S1..S2 5", "surface 50 5 1.517/64.2 12 stop\nsurface -50 5 air 12"},
    {"GO", "STO S2", "surface 50 4 1.517/64.2 -\nsurface -50 90 air - stop"},
    {"S 50", "S 0", "surface - 4 1.517/64.2 - stop"},
    {"S 50 4 517642", "S 0 4", "stop - 4 air -"},
    {"STO", "STO\nRDY 80", "surface 80 4 1.517/64.2 - stop"},
    {"STO", "STO\nCUY 0.02", "surface 50 4 1.517/64.2 - stop"}, /* 1/0.02 is a short radius */
    {"STO", "STO\nCUY 0.0312345", "surface - 4 1.517/64.2 - c=0.0312345 stop"},
    {"RDM;LEN", "RDM N;LEN", "surface 0.02 4 1.517/64.2 - stop"},
    {"GO", "THI S1 5;THI S2 80.5", "surface 50 5 1.517/64.2 - stop\nsurface -50 80.5 air -"},
    {"STO", "STO\nCYL", "surface 50 4 1.517/64.2 - stop cyl=y"},
    {"S 50 4 517642\nSTO", "S 0 4 517642\nSTO\nCYL;RDX 50", "surface 50 4 1.517/64.2 - stop cyl=x"},
    {"S 50 4 517642\nSTO", "S 0 4 517642\nSTO\nCYL;CUX 0.02;RDX 0",
     "surface 50 4 1.517/64.2 - stop cyl=x"},
    {"STO", "STO\nCON\nK -0.5", "surface 50 4 1.517/64.2 - k=-0.5 stop"},
    {"STO", "STO\nASP\nK 0.1;A 1e-5;B 2e-7;C 0.0",
     "surface 50 4 1.517/64.2 - k=0.1 A4=1e-5 A6=2e-7 stop"},
    {"STO", "STO\nASP\nC 1e-9;D 1e-11;E 1e-13;F 1e-15;G 1e-17;H 1e-19;J 1e-21",
     "surface 50 4 1.517/64.2 - A8=1e-9 A10=1e-11 A12=1e-13 A14=1e-15 A16=1e-17 A18=1e-19 A20=1e-21"
     " stop"},
    {"STO", "STO\nK -0.5; A 1e-5; B&\n 2e-7",
     "surface 50 4 1.517/64.2 - k=-0.5 A4=1e-5 A6=2e-7 stop"},
    {"STO", "STO\nSPS ODD 1\nSCO K -1\nSCO AR3 1e-4\nSCO C5 2e-6\nSCO AR22 0",
     "surface 50 4 1.517/64.2 - k=-1 A3=1e-4 A4=2e-6 stop"},
    {"STO", "STO\nCIR 6", "surface 50 4 1.517/64.2 12 stop"},
    {"STO", "STO\nCIR CLR L'rim' 6;CIR EDG 7", "surface 50 4 1.517/64.2 12 stop"},
    {"GO", "CIR S1 6;CIR S2 7\nVUY F2 0.1",
     "note vignetting factors of the fields: the clear diameters limit the beams"},
    {"STO", "STO\nCIR 0", "surface 50 4 1.517/64.2 - stop"},
    {"STO", "STO\nCIR 6;ADX 1;ADY -2",
     "surface 50 4 1.517/64.2 - stop\npass circle 12 decenter=1,-2"},
    {"STO", "STO\nCIR 9;CIR OBS 2;ADY OBS 1",
     "surface 50 4 1.517/64.2 18 stop\nblock circle 4 decenter=0,1"},
    {"STO", "STO\nCIR HOL L'h' 2", "surface 50 4 1.517/64.2 - stop\nblock circle 4"},
    {"STO", "STO\nREX 2.5;REY 3;ADX 1",
     "surface 50 4 1.517/64.2 - stop\npass rectangle 5.0 6 decenter=1,0"},
    {"STO", "STO\nREX L'a' 2;REY L'a' 3;ELX OBS L'b' 1;ELY OBS L'b' 1.5;ADY OBS L'b' -1;ADY L'a' 4",
     "surface 50 4 1.517/64.2 - stop\npass rectangle 4 6 decenter=0,4\nblock ellipse 2 3.0 "
     "decenter=0,-1"},
    {"STO", "STO\nREX EDG 4;REY EDG 5;ADX 0", "surface 50 4 1.517/64.2 - stop"},
    {"STO", "STO\nSLB 'front'\nCIR S'front' 6", "surface 50 4 1.517/64.2 12 stop name=\"front\""},
    {"STO", "STO\nCIR SS 6;CIR SI 7;CIR S1..1 8", "surface 50 4 1.517/64.2 16 stop"},
};

/* alpha and beta turn left-handed in CODE V, gamma right-handed; a lens turns right-handed. */
static const struct meaning of_shifts[] = {
    {"STO", "STO\nXDE 0.5;YDE -1;ADE 2;BDE -3;DAR",
     "surface 50 4 1.517/64.2 - stop decenter=0.5,-1 tilt=-2,3"},
    {"STO", "STO\nXDE 0.5;YDE -1;ADE 2;BDE -3;CDE 4",
     "bend decenter=0.5,-1 tilt=-2,3,4\nsurface 50 4 1.517/64.2 - stop"},
    {"STO", "STO\nADE 0;YDE 0;ADX 0;XOD 0", "surface 50 4 1.517/64.2 - stop"},
    /* along z: with what follows, or back again behind the surface */
    {"SI 0 0", "ZDE 2\nSI 0 0", "surface 50 6 1.517/64.2 - stop\nsurface -50 90 air -"},
    {"SI 0 0", "ZDE 2;DAR\nSI 0 0", "surface 50 6 1.517/64.2 - stop\nsurface -50 88 air -"},
    {"SI 0 0", "SI 0 0\nZDE 2", "surface -50 92 air -"},
    /* a fold: the surface is turned, and the axis behind it once more */
    /* shifted, then turned right-handed by -10; behind it turned back, then shifted back */
    {"STO", "STO\nYDE 2;ADE 10;REV",
     "surface 50 0 1.517/64.2 - stop\nbend decenter=0,0 tilt=10,0,0\nsurface - 0 1.517/64.2 -\n"
     "bend decenter=0,-2 tilt=0,0,0\nsurface - 4 1.517/64.2 -"},
    {"STO", "STO\nXDE 1;ZDE 0.5;REV",
     "surface 50 0 1.517/64.2 - stop\nbend decenter=-1,0 tilt=0,0,0\nsurface - 3.5 1.517/64.2 -"},
    {"SI 0 0", "SI 0 0\nADE 5;REV", "surface -50 90 air -"},
    {"SI 0 0", "S 0 -30 REFL\nADE 45;BEN\nSI 0 0",
     "bend decenter=0,0 tilt=-45,0,0\nsurface - 0 mirror -\n"
     "bend decenter=0,0 tilt=-45,0,0\nsurface - -30 air -"},
    {"SI 0 0", "SI 0 0\nADE 10",
     "surface -50 90 air -\nbend decenter=0,0 tilt=-10,0,0\n"
     "surface - 0 air -"},
};

/* What follows another surface: scale * number + offset. */
static const struct meaning of_pickups[] = {
    {"GO", "PIK RDY S2 RDY S1 -1", "surface -50 90 air -"},
    {"GO", "PIK RDY S2 Z1 RDY S1 Z1 0.5 5", "surface 30 90 air -"},
    {"GO", "PIK CUY S2 CUY S1 1 0.005", "surface 40 90 air -"},
    {"GO", "PIK CUY S2 CUY S1 -1", "surface -50 90 air -"},
    {"GO", "PIK THI S2 THI S1 2 0.5", "surface -50 8.5 air -"},
    {"GO", "CIR S1 6;PIK CIR S2 CIR S1", "surface -50 90 air 12"},
    {"GO", "K S1 -0.5;PIK K S2 K S1 2", "surface -50 90 air - k=-1"},
    {"GO", "PIK GLA S2 GLA S1", "surface -50 90 1.517/64.2 -"},
    {"GO", "PIK RDY S2..2 RDY S1", "surface 50 90 air -"},
    /* what is followed may follow itself, further down in the file */
    {"S -50 90\nSI 0 0\nGO",
     "S 1 2\nS 7 3\nS -50 90\nSI 0 0\nPIK RDY S3 RDY S2 -1\nPIK RDY S2 RDY S1\nGO",
     "surface 50 2 air -\nsurface -50 3 air -"},
    {"GO", "PIK THI S2 THI S1\nPIK RDY S1 RDY S2 -1",
     "surface 50 4 1.517/64.2 - stop\n"
     "surface -50 4 air -"},
};

/* A plano-convex lens of n = 1.5, R = 50, t = 6: f = 100, bfl = 100 - 6/1.5 = 96. */
static const char plano[] = "RDM;LEN\nEPD 5\nSO 0 1e13\nS 50 6 1.5\nSTO\nS 0 1\nSI 0 0\nGO\n";
static const struct meaning of_solves[] = {
    {"SI 0 0", "PIM\nSI 0 -0.5", "surface - 95.5 air -"},
    {"SI 0 0", "THI HMY 1.2\nSI 0 0", "surface - 48 air -"}, /* y = 2.4, u' = -2.5/100 */
    {"SI 0 0", "PIM\nSI 0 0", "focus paraxial"},
    /* n'u' = n u - y (n' - n) c: -0.0488 = -0.025 + 2.4 0.5 c */
    {"SI 0 0", "CUY UMY -0.049\nSI 0 0", "surface - 1 air - c=-0.02"},
    /* the chief ray through the stop at surface 1: y = 6 tan w/1.5 at surface 2, u' = tan w */
    {"EPD 5\nSO 0 1e13\nS 50 6 1.5\nSTO\nS 0 1\n",
     "EPD 5\nYOB 0 -50\nSO 0 100\nS 0 6 1.5\nSTO\nS 0 1\nTHI HCY 12\n", "surface - 20 air -"},
    {"EPD 5\nSO 0 1e13\nS 50 6 1.5\nSTO\nS 0 1\n",
     "EPD 5\nYOB 0 -50\nSO 0 100\nS 0 6 1.5\nSTO\nS 0 1\nCUY UCY 0.48\n",
     "surface - 1 air - c=-0.02"},
    {"SI 0 0", "ZOO 2\nZOO EPD 5 10\nTHI HMY 1.2\nSI 0 0", "let d2 48 72"},
    /* what is not evaluated stands as it is, and what is not what the file has is said */
    {"STO", "STO\nCUY SMY 1",
     "note line 6: a solve: it is not known; the number in the file is kept"},
    {"STO", "STO\nTHI UMY 1",
     "note line 6: a solve: it is not known; the number in the file is kept"},
    {"STO", "STO\nTHI UMY 1", "surface 50 6 1.5 - stop"},
    {"EPD 5\nSO 0 1e13", "FNO 4;SO 0 200", "surface 50 6 1.5 - stop\nsurface - 1 air -"},
    {"EPD 5\nSO 0 1e13\nS 50 6 1.5\nSTO\n", "FNO 4;SO 0 200\nS 50 6 1.5\nSTO\nTHI HMY 2\n",
     "note line 5: a solve: it follows a ray whose height follows from the lens; the number in the "
     "file is kept"},
    {"SI 0 0", "THI HMY 1.2\nSI 0 0",
     "note the thickness of surface 2 is 48 by its solve, the file had 1"},
};

static const char zoom[] = "RDM;LEN\nTITLE 'Zoom'\nEPD 5\nSO 0 1e13\nS 50 6 1.5\nSTO\nCIR 4\n"
                           "S 0 10\nSI 0 0\nZOO 3\nZOO THI S1 6 7 8\nGO\n";
static const struct meaning of_positions[] = {
    {"", "", "position z1 z2 z3\nlet d1 6 7 8"},
    {"GO", "TIT Z1 'far end';TIT Z2 'all';TIT Z3 'far end'", "position far-end z2 z3"},
    {"GO", "ZOO TIT;TITLE 'two'", "lens two"},
    {"GO", "ZOO EPD 5 4 3", "let aperture epd 5 epd 4 epd 3"},
    {"EPD 5", "FNO 4;!", "aperture f/4"},
    {"EPD 5\nSO", "FNO 4\nSO", "aperture f/4"},
    {"GO", "ZOO CIR S1 4 5 6", "let D1 8 10 12"},
    {"GO", "ZOO THI SO 1e13 200 100", "let object inf 200 100"},
    {"GO", "THI S2 Z2 12.5", "let d2 10 12.5 10"},
    {"GO", "CIR S1 Z3 5", "let D1 8 8 10"},
    {"GO", "ZOO CIR S1 CLR 4 5 6", "let D1 8 10 12"},
    {"GO", "EPD Z2 4", "let aperture epd 5 epd 4 epd 5"},
    {"GO", "ZOO RDY S1 50 40 30", "set R1 50 40 30"},
    {"GO", "ZOO CUY S1 0.02 0.025 0.04", "set R1 50 40 25"},
    {"GO", "RDY S1 Z2 40", "set R1 50 40 50"},
    {"GO", "ZOO K S1 0 -1 -2", "set k1 0 -1 -2"},
    {"GO", "ZOO A S1 0 1e-6 2e-6;A Z3 S1 3e-6", "set A4_1 0 1e-6 3e-6"},
    {"GO", "SPS S1 ODD;ZOO SCO S1 AR3 0 1e-6 2e-6", "set A3_1 0 1e-6 2e-6"},
    {"GO", "ZOO GLA S1 1.5 1.6 NBK7_SCHOTT", "set glass1 1.5 1.6 SCHOTT:N-BK7"},
    {"GO", "ZOO GLA S1 F2_SCHOTT F5_SCHOTT F4_HOYA", "set glass1 SCHOTT:F2 SCHOTT:F5 HOYA:F4"},
    {"GO", "PRV;PWL 500;S1 1.6;Z1 1.8;F2 1.7;END;ZOO GLA S1 S1 Z1 F2", "set glass1 1.6 1.8 1.7"},
    {"GO", "GLA S1 F2_SCHOTT;GLA S1 Z2 F5_SCHOTT", "set glass1 SCHOTT:F2 SCHOTT:F5 SCHOTT:F2"},
    {"GO", "ZOO CIR S1..2 4 5 6", "let D1 8 10 12\nlet D2 8 10 12"},
    {"GO", "ZOO YDE S2 0 1 -1;DAR S2", "set decenter_y2 0 1 -1"},
    {"GO", "ZOO ADE S2 0 10 20;DAR S2", "set tilt_x2 0 -10 -20"},
    {"GO", "ZOO WTF F1 1 1 1;WL 500 600;ZOO WTW W2 1 1 1", "wavelength 500nm 600nm"},
    {"GO", "WL 500 600;REF 1;WTW 1 1;ZOO WTW W2 1 0.5 0",
     "set wavelength 500nm,600nm 500nm,600nm:0.5 500nm,600nm:0"},
    {"GO", "WL 500 600;ZOO REF 1 2 1", "set wavelength 500nm,600nm 600nm,500nm 500nm,600nm"},
    {"GO", "PIK THI S2 Z2 THI S1 Z2 2", "let d2 10 14 10"},
    /* a mirror that bends the axis in some positions has its plane in all */
    {"S 0 10\nSI", "S 0 -10 REFL\nBEN\nSI 0 0;ZOO ADE S2 0 -45 45;!",
     "bend decenter=0,0 tilt=0,0,0\nsurface - 0 mirror -"},
    {"GO", "CUY S2 UMY 0;CUY S2 Z3 0", "position z1 z2 z3"},
    {"GO", "YAN 0 7;ZOO YAN F2 7 7 7", "field angle 0 7"},
    {"GO", "XAN 1 2;YAN F1 5;YAN F2 6", "field angle 1,5 2,6"},
    {"GO", "PIK THI S2 THI S1 1 0.5", "let d2 6.5 7.5 8.5"},
    {"GO", "ZOO THC S1 0 0 0;ZOO XAN 0 0 0", "let d1 6 7 8"},
    {"GO", "ZDE S2 1", "let d1 7 8 9"},
};

static const char stands[] = "the number in the file is kept";

static const struct refusal losses[] = {
    {"STO", "STO\n@INT S1 'wave.int'", "INT: a measured deformation", ""},
    {"STO", "STO\nPRE @-1", "a pressure is not below 0", NULL},
    {"STO", "STO\n@PUX 0.5", "PUX: an apodised pupil", ""},
    {"STO", "STO\n@XYZ 1", "XYZ: an unknown command", ""},
    {"STO", "STO\n@RET S0", "RET: a shift or turn that is related to another surface", ""},
    {"STO", "STO\nADE 10;BDE 5\n@REV", "a return with turns about more than one axis",
     "they are undone in another order"},
    {"STO", "STO\n@REX 2", "REX: an aperture that is not stated whole", "left out"},
    {"STO", "STO\n@XTO", "XTO: a toric, anamorphic or special surface", ""},
    {"STO", "STO\n@DIF GRT", "DIF: a diffractive surface", ""},
    {"STO", "STO\nTEM @-300", "a temperature is above -273.15 C", NULL},
    {"STO", "STO\n@INC S1 0.1", "INC: an index that is changed", ""},
    {"STO", "STO\n@VUY 0 0.1", "VUY: vignetting factors of the fields", ""},
    {"STO", "STO\n@ADY 1", "ADY: an aperture that is not stated whole", "left out"},
    {"STO", "STO\nREX 2;REY 3;@ARO 30", "ARO: a turned aperture", ""},
    {"STO", "STO\n@CUF 0.1", "CUF: a Fresnel surface of this base", ""},
    {"STO", "STO\n@XOD 1", "XOD: an offset of the point about which a surface turns", ""},
    {"STO", "STO\n@RDX 40", "RDX: a curvature in x of a surface that is no cylinder", ""},
    {"STO", "STO\nCYL\n@CUX 0.1", "CUX: a surface that is curved in x and in y", ""},
    {"STO", "STO\n@RDY Z2 40", "RDY: it is of position 2 of 1", ""},
    {"STO", "STO\n@GLA Z2 AIR", "GLA: it is of position 2 of 1", ""},
    {"STO", "STO\n@K Z2 1", "K: it is of position 2 of 1", ""},
    {"STO", "STO\n@ADE Z2 1", "ADE: it is of position 2 of 1", ""},
    {"STO", "STO\n@EPD Z2 1", "EPD: it is of position 2 of 1", ""},
    {"STO", "STO\n@SPS QBF", "SPS: a surface of a shape that lenscalc has not", ""},
    {"STO", "STO\n@SPS ODD 2", "SPS: a radius that r is divided by", ""},
    {"STO", "STO\nSPS ODD\n@SCO AR21 1", "SCO: a constant of a shape that lenscalc has not", ""},
    {"STO", "STO\n@SCO C3 1", "SCO: a constant of a shape that lenscalc has not", ""},
    {"STO", "STO\nSPS ODD\n@SCO X3 1", "SCO: a constant of a shape that lenscalc has not", ""},
    {"GO", "@PIK XDE S1 XDE S2", "PIK: a pick-up that is not known", stands},
    {"GO", "@PIK RDY S2 THI S1", "PIK: a pick-up between unlike numbers, ranges or positions", ""},
    {"GO", "@PIK RDY S2 Z2 RDY S1", "PIK: a pick-up between unlike numbers, ranges or positions",
     ""},
    {"SO 0 1e13", "@SO 500 1e13", "a curved or tilted object", "taken as a plane"},
    {"SI 0 0", "@SI -500 0", "a curved image", "taken as a plane"},
    {"SO 0 1e13", "@SO 0 1e13\nZDE 5", "a curved or tilted object", "taken as a plane"},
    {"STO", "STO\nADE 10;BDE 5\n@BEN", "a bend with turns about more than one axis",
     "only the first is kept"},
    {"STO", "STO\nCYL;CDE 10\n@DAR", "a cylinder turned about z", "left unturned"},
    {"GO", "ZOO 2\nZOO @VUY F1 0 0.1", "VUY: vignetting factors of the fields", ""},
    {"GO", "ZOO 2\nZOO THI S1 3 @x", "a solve: it is not known", stands},
};

static const char macro[] = "a command of a macro: lenscalc reads lens data and runs no macros";

static const struct refusal errors[] = {
    {"SI 0 0\n", "", "the file has no image surface SI", NULL},
    {"S 50 4 517642\nSTO\nS -50 90\n", "", "the file has no surface between object and image",
     NULL},
    {"SO 0 1e13\n", "@", "a surface before the object SO", NULL},
    {"STO", "STO\n@SO 0 5", "the object SO is not the first surface", NULL},
    {"GO", "@S 0 1", "a surface behind the image SI", NULL},
    {"S 50 4", "@S2 50 4", "surface 2, where surface 1 is expected", NULL},
    {"S 50 4", "@S1a 50 4", "the number of the surface is a whole number from 1 on", NULL},
    {"S 50 4 517642", "S 50@", "the thickness is missing", NULL},
    {"S 50 4 517642", "S@", "the radius is missing", NULL},
    {"S 50 4 517642", "S 5@x 4", "the radius '5x' is not a number", NULL},
    {"S 50 4 517642", "S @1e100 4", "the radius must be finite and below 1e100", NULL},
    {"S 50 4 517642", "S 50 4 517642 REFR @6", "'6' does not belong here", NULL},
    {"517642", "@NOGLASS", "glass 'NOGLASS' is in no catalogue", NULL},
    {"517642", "@1.5.6", "glass '1.5.6' is in no catalogue", NULL},
    {"517642", "@51764", "glass '51764' is in no catalogue", NULL},
    {"STO", "STO @5", "'5' does not belong here", NULL},
    {"STO", "STO @S9", "there is no surface 'S9'", NULL},
    {"STO", "STO @S1..7", "there is no surface 'S1..7'", NULL},
    {"STO", "@STO SO", "the object cannot be the stop", NULL},
    {"SO 0", "@STO\nSO 0", "'STO' before the first surface", NULL},
    {"STO", "STO\n'@text'", "text where a command is expected", NULL},
    {"STO", "@^x == 1", macro, NULL},
    {"STO", "@FOR ^i 1 3", macro, NULL},
    {"TITLE 'Singlet'", "TITLE @'Singlet", "the text does not end with '", NULL},
    {"TITLE 'Singlet'", "@TITLE Z2 'x'", "position 2 of 0", NULL},
    {"TITLE 'Singlet'", "DIM @F", "the unit is one of M, C, I", NULL},
    {"TITLE 'Singlet'", "DIM M @I", "'I' does not belong here", NULL},
    {"TITLE 'Singlet'", "RDM Y @1", "'1' does not belong here", NULL},
    {"WL 587.5618", "WL @0.5876", "the wavelength is not within 1 nm to 100 mm", NULL},
    {"WL 587.5618", "WL 587.6 @red", "the wavelength 'red' is not a number", NULL},
    {"WL 587.5618", "WL 587.6\nWTW @-1", "a weight is not below 0", NULL},
    {"WL 587.5618", "WL 587.6\nREF @0", "the number of the wavelength is a whole number from 1 on",
     NULL},
    {"EPD 10", "EPD @0", "the aperture must be above 0", NULL},
    {"EPD 10", "EPD@", "the aperture is missing", NULL},
    {"EPD 10", "EPD 10 @5", "'5' does not belong here", NULL},
    {"YAN 0 10", "@YAN 0 200", "field 2: a field angle is not beyond 180 degrees", NULL},
    {"YAN 0 10", "XAN 0 1\n@YAN 0 90",
     "field 2: of a field with an angle in x and one in y both are below 90 degrees", NULL},
    {"YAN 0 10", "YAN 0 10\n@WTF 1 -1", "a weight is not below 0", NULL},
    {"YAN 0 10", "YAN 0 @x", "the field 'x' is not a number", NULL},
    {"YAN 0 10", "YAN@", "the field is missing", NULL},
    {"STO", "STO\nGLA S1@", "the glass is missing", NULL},
    {"STO", "STO\nTHI @S1..0 5", "there is no surface 'S1..0'", NULL},
    {"GO", "@STO S1..2", "one surface is the stop, not a range", NULL},
    {"GO", "ZOO 2\n@ZOO GLA S1 F2_SCHOTT", "1 numbers for 2 positions", NULL},
    {"STO", "STO\nGLA S1 AIR @5", "'5' does not belong here", NULL},
    {"STO", "STO\nK @x", "the conic 'x' is not a number", NULL},
    {"STO", "STO\nA 1 @2", "'2' does not belong here", NULL},
    {"STO", "STO\nSPS ODD @q", "the radius 'q' is not a number", NULL},
    {"STO", "STO\nSPS ODD\nSCO AR1@", "the coefficient is missing", NULL},
    {"STO", "STO\nSLB 'a' '@b'", "'b' does not belong here", NULL},
    {"STO", "STO\nCIR @-5", "the radius of an aperture is not below 0", NULL},
    {"STO", "STO\nCIR S1@", "the radius of the aperture is missing", NULL},
    {"STO", "STO\nXDE @x", "the decentre 'x' is not a number", NULL},
    {"STO", "STO\nADE 1 @2", "'2' does not belong here", NULL},
    {"STO", "STO\nDAR @2", "'2' does not belong here", NULL},
    {"STO", "STO\nCYL @2", "'2' does not belong here", NULL},
    {"STO", "STO\nTHI HMY@", "the target of the solve is missing", NULL},
    {"STO", "STO\nTHI HMY 0 @1", "'1' does not belong here", NULL},
    {"GO", "PIM @1", "'1' does not belong here", NULL},
    {"GO", "PIK RDY @S9 RDY S1", "there is no surface 'S9'", NULL},
    {"GO", "@PIK RDY S1 RDY S1", "a pick-up between surfaces 1 and 1 of 4", NULL},
    {"GO", "PIK RDY S2 RDY S1 1 0 @3", "'3' does not belong here", NULL},
    {"GO", "PIK RDY S2 RDY S1 @x", "the scale 'x' is not a number", NULL},
    {"GO", "ZOO @0", "the number of positions is a whole number from 1 on", NULL},
    {"GO", "ZOO @101", "more than 100 positions", NULL},
    {"GO", "ZOO 2\nZOO @3", "ZOO stands here twice", NULL},
    {"GO", "ZOO 2 @3", "'3' does not belong here", NULL},
    {"GO", "ZOO 2\n@ZOO THI S1 3 4 5", "3 numbers for 2 positions", NULL},
    {"GO", "ZOO 2\n@ZOO EPD 3", "1 numbers for 2 positions", NULL},
    {"GO", "ZOO 2\nZOO EPD 3 @-4", "the aperture must be above 0", NULL},
    {"GO", "ZOO 2\nZOO RDY S1 3 5@x", "the radius '5x' is not a number", NULL},
    {"GO", "@ZOO THI S1 5 6", "2 numbers for 0 positions", NULL},
    {"TITLE 'Singlet'", "ZOO 2\nZOO @THI 1 2", "'THI' before the first surface", NULL},
    {"GO", "@YAN F4 5", "field 4, where 2 are listed", NULL},
    {"GO", "@WTW W2 5", "wavelength 2 of 1", NULL},
    {"GO", "PRV\nPWL @x\nEND", "the wavelength 'x' is not a number", NULL},
    {"GO", "PRV @x\nEND", "'x' does not belong here", NULL},
    {"GO", "PRV\nPWL 500 600\n'A' @1.5\nEND", "1 indices for 2 wavelengths of PWL", NULL},
    {"GO", "PRV\nPWL 500 600\n'A' 1.5 @n\nEND", "the index 'n' is not a number", NULL},
    {"S 50 4 517642", "PRV\nPWL 500 600\n'A' LAU 1 2\nEND\nS 50 4 '@A'",
     "the glass 'A' has a formula that lenscalc does not know", NULL},
    {"GO", "@PIK RDY S1 RDY S2\nPIK CUY S2 CUY S1\nGO",
     "the pick-ups go in a circle: surface 1 follows surface 2, which follows it", NULL},
    {"GO", "@PIK THI S1 THI S1\nGO", "a pick-up between surfaces 1 and 1 of 4", NULL},
    /* radii without RDM, whatever the aperture is: f = 0.0487 mm of a glass of 4 mm */
    {"RDM;LEN\nTITLE 'Singlet'\nEPD 10\nWL 587.5618\nYAN 0 10\nSO 0 1e13\nS 50",
     "LEN\nEPD 10\nSO 0 1e13\n@S 50", NO_RDM("a beam of 10 mm"), NULL},
    {"RDM;LEN\nTITLE 'Singlet'\nEPD 10\nWL 587.5618\nYAN 0 10\nSO 0 1e13\nS 50",
     "LEN\nSO 0 1e13\n@S 50", NO_RDM("a distance of 4 mm"), NULL},
    {"RDM;LEN\nTITLE 'Singlet'\nEPD 10\nWL 587.5618\nYAN 0 10\nSO 0 1e13\nS 50",
     "LEN\nNAO 0.1\nSO 0 1e3\n@S 50", NO_RDM("a beam of 201.008 mm"), NULL}, /* 2 s tan u */
};

/* Lines of a zoom, and the same lines of each position alone: both are the same lens there. */
static const char *const alone[][4] = {
    /* in the zoom; in positions 1, 2, 3 */
    {"ZOO EPD 5 4 3", "EPD 5", "EPD 4", "EPD 3"},
    {"ZOO RDY S1 50 -45 40", "RDY S1 50", "RDY S1 -45", "RDY S1 40"},
    {"CUY S2 Z2 -0.0125", "", "CUY S2 -0.0125", ""},
    {"ZOO THI S2 20 25 30", "THI S2 20", "THI S2 25", "THI S2 30"},
    {"ZOO GLA S1 1.5 1.6 NBK7_SCHOTT", "GLA S1 1.5", "GLA S1 1.6", "GLA S1 NBK7_SCHOTT"},
    {"ASP S1;ZOO A S1 3e-7 1e-6 -2e-6;ZOO K S1 -1 0 0.5", "A S1 3e-7;K S1 -1", "A S1 1e-6",
     "A S1 -2e-6;K S1 0.5"},
    {"ZOO YDE S2 0.5 0 -0.5;ZOO ADE S2 1 2 3;DAR S2", "YDE S2 0.5;ADE S2 1;DAR S2",
     "YDE S2 0;ADE S2 2;DAR S2", "YDE S2 -0.5;ADE S2 3;DAR S2"},
    {"ZOO XDE S2 0.5 1 -0.5", "XDE S2 0.5", "XDE S2 1", "XDE S2 -0.5"},
    {"RDY S2 -60;THI S2 HMY 0.5", "RDY S2 -60;THI S2 HMY 0.5", "RDY S2 -60;THI S2 HMY 0.5",
     "RDY S2 -60;THI S2 HMY 0.5"},
    {"RDY S2 -60;PIM", "RDY S2 -60;PIM", "RDY S2 -60;PIM", "RDY S2 -60;PIM"},
    {"PIK RDY S2 RDY S1 -1;ZOO RDY S1 50 60 70", "RDY S2 -50", "RDY S1 60;RDY S2 -60",
     "RDY S1 70;RDY S2 -70"},
    {"WL 500 600;REF 1;ZOO REF 1 2 2", "WL 500 600;REF 1", "WL 500 600;REF 2", "WL 500 600;REF 2"},
};

/* The lens in JSON, which has every number; null where the file is not read. */
static const char *json_of(struct fixture *fixture, const char *lines, const char *what,
                           size_t position)
{
    const struct foreign_format *json = foreign_by_name(text_of("json"));
    const char *file = arena_printf(&fixture->arena,
                                    "RDM;LEN\nEPD 5\nWL 587.6\nSO 0 1e13\nS 50 6 1.5\nSTO\n"
                                    "S 0 10\n%s\nSI 0 0\n%s\nGO\n",
                                    lines, what);
    struct text text = {NULL, 0};
    bool read = foreign_read(&fixture->job, text_of(file), &fixture->lens, &fixture->error);
    if (!read) {
        printf("%s: %s\n", lines, fixture->error.message);
        return NULL;
    }
    struct lens plain = *lens_one_position(&fixture->lens, position, &fixture->arena);
    plain.note_count = 0;
    return json->write(&fixture->job, &plain, &text, &fixture->error)
               ? arena_string(&fixture->arena, text.start, text.length)
               : NULL;
}

static void test_positions_alone(void)
{
    for (size_t i = 0; i < sizeof alone / sizeof alone[0]; i++) {
        for (size_t p = 0; p < 3; p++) {
            struct fixture zoomed, single;
            fixture_open(&zoomed, "zoom.seq");
            fixture_open(&single, "single.seq");
            const char *in_zoom = json_of(&zoomed, alone[i][0], "ZOO 3", p);
            const char *by_itself = json_of(&single, alone[i][p + 1], "", 0);
            bool same = in_zoom != NULL && by_itself != NULL && strcmp(in_zoom, by_itself) == 0;
            if (!same) {
                printf("%s in position %zu:\n%s\n%s\n", alone[i][0], p + 1, in_zoom, by_itself);
            }
            CHECK(same);
            arena_free(&zoomed.arena);
            arena_free(&single.arena);
        }
    }
}

int main(void)
{
    test_positions_alone();
    check_meanings("lens.seq", good, CASES(of_lens));
    check_meanings("surfaces.seq", good, CASES(of_surfaces));
    check_meanings("shifts.seq", good, CASES(of_shifts));
    check_meanings("pickups.seq", good, CASES(of_pickups));
    check_meanings("solves.seq", plano, CASES(of_solves));
    check_meanings("zoom.seq", zoom, CASES(of_positions));
    check_refusals("lost.seq", good, CASES(losses));
    check_refusals("bad.seq", good, CASES(errors));
    return check_report();
}
