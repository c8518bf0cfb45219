/* tests/unit/test_oslo.c - OSLO lens files: what each command means, or why it is lost. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"

static const char good[] = "LEN NEW \"Singlet\" 50 2\n"
                           "EBR 5\n"
                           "ANG 10\n"
                           "WV 0.5875618\n"
                           "TH 1e20\n"
                           "NXT\n"
                           "RD 50\n"
                           "TH 4\n"
                           "GLA 1.5\n"
                           "AST\n"
                           "NXT\n"
                           "RD -50\n"
                           "TH 90\n"
                           "NXT\n"
                           "END 2\n";

static const struct meaning of_lens[] = {
    {"", "", "lens Singlet\nunit mm\nwavelength 0.5875618um\nobject inf\nfield angle 0 10"},
    {"", "", "aperture epd 10\nfocus table"},
    {"", "", "surface 50 4 1.5 - stop\nsurface -50 90 air -"},
    {"EBR 5", "UNI 25.4\nEBR 0.5", "unit in"},
    {"EBR 5", "EBR 0.5\nUNI 25.4", "aperture epd 1.0"},
    {"EBR 5", "UNI 10\nEBR 5", "unit cm"},
    {"EBR 5", "UNI 1000\nEBR 5", "unit m"},
    {"EBR 5", "FNO 4", "aperture f/4"},
    {"EBR 5", "FNB 4", "aperture f/4"},
    {"EBR 5\n", "", "field angle 0 10\nfocus table"},
    {"ANG 10\n", "", "object inf\naperture epd 10"},
    {"ANG 10", "GIH 21.6", "field image 0 21.6"},
    {"ANG 10", "ANG 0", "field angle 0"},
    {"ANG 10", "OBH -1e20", "field angle 0 45"}, /* tan w = -height/distance */
    {"EBR 5\nANG 10\nWV 0.5875618\nTH 1e20", "NAO 0.1\nOBH -7.5\nWV 0.5875618\nTH 200",
     "object 200\nfield height 0 -7.5\naperture na 0.1"},
    {"WV 0.5875618", "WV 0.58756 0.48613\nWW 1 0.5", "wavelength 0.58756um 0.48613um:0.5"},
    {"WV 0.5875618", "WV1 0.58756\nWV2 0.48613\nWW1 2", "wavelength 0.58756um:2 0.48613um"},
    {"WV 0.5875618", "WV 0.5 0.6\nWV1 0.7", "wavelength 0.7um 0.6um"},
    {"WV 0.5875618\n", "", "unit mm\nobject inf"},
    {"WV 0.5875618", "SNO1 \"one\"; SNO2 \"two\"\nWV 0.55", "note one\nnote two"},
    {"WV 0.5875618", "DES \"me\"; DSP 1; PLT 3\nWV 0.55 // green", "wavelength 0.55um"},
    {"END 2", "END 2\nRST NEW\nF 1 0\nF 2 1\nF 3 0.5 0 0\nEND", "aperture epd 10"},
    {"ANG 10", "GIH 20", "field image 0 20"},
    {"END 2\n", "END 2\nRST NEW\nF 1 0\nF 2 1 -1 0 0 0 -1 1 -1 1 0.5\nEND\n",
     "field angle 0 -10,10:0.5"},
    /* what lenscalc keeps in comments */
    {"EBR 5", "// lenscalc: source a book\n// lenscalc: kind triplet\nEBR 5",
     "kind triplet\nsource a book"},
    {"EBR 5", "// lenscalc: stated efl 95.5\nEBR 5", "stated efl 95.5"},
    {"EBR 5", "// lenscalc: fields 0 7 10\nEBR 5", "field angle 0 7 10"},
    {"AST", "AST\n// lenscalc: name 1 front", "surface 50 4 1.5 - stop name=\"front\""},
    {"GLA 1.5\nAST", "GLA 1.5", "surface 50 4 1.5 - stop"}, /* without AST the first surface */
};

static const struct meaning of_surfaces[] = {
    {"RD 50", "CV 0.02", "surface 50 4 1.5 - stop"},
    {"RD 50", "CV 0.0312345", "surface - 4 1.5 - c=0.0312345 stop"},
    {"RD 50\n", "", "surface - 4 1.5 - stop"},
    {"RD 50\nTH 4\nGLA 1.5", "RD 50\nTH -4\nRFL", "surface 50 -4 mirror - stop"},
    {"GLA 1.5", "RFL\nGLA 1.5", "surface 50 4 1.5 - stop"},
    {"GLA 1.5", "GLA 1.5\nAIR", "surface 50 4 air - stop"},
    {"GLA 1.5", "GLA N-BK7", "surface 50 4 SCHOTT:N-BK7 - stop"},
    {"GLA 1.5", "GLA BK7", "surface 50 4 SCHOTT:BK7 - stop"},
    {"GLA 1.5", "GLA O_S-BSL7", "surface 50 4 OHARA:S-BSL7 - stop"},
    {"GLA 1.5", "GLA H_BSC7", "surface 50 4 HOYA:BSC7 - stop"},
    {"GLA 1.5", "GLA MOD 1.6 50", "surface 50 4 1.6/50 - stop"},
    {"GLA 1.5", "GLA MOD MINE 1.6 50", "surface 50 4 1.6/50 - stop"},
    {"GLA 1.5", "GLA MINE 1.55", "surface 50 4 1.55 - stop"},
    /* indices count, whatever glass has the name; SCHOTT prints nd = 1.51680, 1.80518 */
    {"GLA 1.5", "GLA BK7 1.6", "surface 50 4 1.6 - stop"},
    {"GLA 1.5", "GLA BK7 1.6",
     "note the glass 'BK7' is SCHOTT:BK7 of the index 1.5168 at 0.587562 um, beside which the file "
     "has 1.6: the file's indices are used"},
    {"GLA 1.5", "GLA BK7 1.5168", "lens Singlet\nunit mm"}, /* rounded: no note */
    {"WV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5",
     "WV 0.5 0.6\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA MINE 1.52 1.51",
     "surface 50 4 {0.5um 1.52, 0.6um 1.51} - stop"},
    {"WV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5",
     "WV 0.5 0.6\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5 1.5 1.5", "surface 50 4 1.5 - stop"},
    {"WV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5",
     "TH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5 1.51 1.49",
     "surface 50 4 {0.58756um 1.5, 0.48613um 1.51, 0.65627um 1.49} - stop"},
    {"AST", "AST\nAP 6", "surface 50 4 1.5 12 stop"},
    {"AST", "AST\nAP CHK 6.25", "surface 50 4 1.5 12.50 stop"},
    {"AST", "AST\nAP 0", "surface 50 4 1.5 - stop"},
    {"AST\nNXT", "NXT\nAST", "surface 50 4 1.5 -\nsurface -50 90 air - stop"},
    {"RD 50\nTH 4\nGLA 1.5", "TH 4", "stop - 4 air -"},
    {"AST", "AST\nCC -1", "surface 50 4 1.5 - k=-1 stop"},
    {"AST", "AST\nAD 1e-5;AE 2e-7;AF 3e-9;AG 4e-11",
     "surface 50 4 1.5 - A4=1e-5 A6=2e-7 A8=3e-9 A10=4e-11 stop"},
    {"AST", "AST\nASP ASR 3\nAS0 0;AS1 1e-3;AS2 0;AS10 1e-21",
     "surface 50 4 1.5 - A2=1e-3 A20=1e-21 stop"},
    {"AST", "AST\nASP ARA 3\nAS1 1e-3;AS2 2e-4;AS20 1e-21",
     "surface 50 4 1.5 - A1=1e-3 A2=2e-4 A20=1e-21 stop"},
    {"AST", "AST\nTOX 0;RDX 0;APN 0", "surface 50 4 1.5 - stop"},
    /* special apertures: between edges, corners, obstructing, picked up */
    {"AST", "AST\nAPN 1;ATP A 2;AAC A 4;AX1 A -2;AX2 A 2;AY1 A -1;AY2 A 1",
     "surface 50 4 1.5 - stop\npass rectangle 4 2"},
    {"AST", "AST\nATP A 2;AAC A 4;AX1 A -2;AX2 A 2;AY1 A -1;AY2 A 1;AAN A 90",
     "surface 50 4 1.5 - stop\npass rectangle 2 4"},
    {"AST", "AST\nATP A 2;AAC A 4;AX1 A -.2;AY1 A -1.5;AY2 A 1.5",
     "surface 50 4 1.5 - stop\npass rectangle 0.2 3 decenter=-0.1,0"},
    {"AST", "AST\nAP 6\nATP A 1;AAC A 2;AX2 A 2;AY1 A -1;AY2 A 1",
     "surface 50 4 1.5 12 stop\nblock ellipse 2 2 decenter=1,0"},
    {"AST", "AST\nATP A 3;AAC A 4;AVX2 A 2;AVY3 A 2",
     "surface 50 4 1.5 - stop\npass polygon 0,0 2,0 0,2"},
    {"AST\nNXT", "AST\nATP A 4;AAC A 4;AVX2 A 2;AVX3 A 2;AVY3 A 2;AVY4 A 1\nNXT\nAPK B -1 A",
     "surface -50 90 air -\npass polygon 0,0 2,0 2,2 0,1"},
};

/* Tilts about x and y turn left-handed in OSLO, about z right-handed. */
static const struct meaning of_shifts[] = {
    {"AST", "AST\nDT 1;DCX 0.5;DCY -1;TLA 2;TLB -3;RCO",
     "surface 50 4 1.5 - stop decenter=0.5,-1 tilt=-2,3"},
    {"AST", "AST\nDCX 0.5;DCY -1;TLA 2;TLB -3;TLC 4",
     "bend decenter=0.5,-1 tilt=-2,3,4\nsurface 50 4 1.5 - stop"},
    {"AST", "AST\nDT -1;TLA 2;RCO 1", "surface 50 4 1.5 - stop decenter=0,0 tilt=-2,0"},
    {"RD -50\nTH 90", "RD -50\nTH 90\nDCZ 2", "surface 50 6 1.5 - stop\nsurface -50 90 air -"},
    {"RD -50\nTH 90", "RD -50\nTH 90\nDCZ 2;RCO", "surface 50 6 1.5 - stop\nsurface -50 88 air -"},
    /* turned about z, y, x, then shifted; undone where the axis goes on unbent */
    {"AST", "AST\nDT -1;DCX 1;DCZ 3;TLA 10;TLC 30",
     "bend decenter=0,0 tilt=0,0,30\nsurface - 0 air -\nbend decenter=0,0 tilt=-10,0,0\n"
     "surface - 3 air -\nbend decenter=1,0 tilt=0,0,0\nsurface 50 4 1.5 - stop"},
    {"AST", "AST\nDT -1;DCY 2;TLA 10;RCO",
     "bend decenter=0,0 tilt=-10,0,0\nsurface - 0 air -\nbend decenter=0,2 tilt=0,0,0\n"
     "surface 50 0 1.5 - stop\nbend decenter=0,-2 tilt=0,0,0\nsurface - 0 1.5 -\n"
     "bend decenter=0,0 tilt=10,0,0\nsurface - 4 1.5 -"},
    {"AST\nNXT\nRD -50", "AST\nDCY 4;TLA 30\nNXT\nPK TDM 1\nRD -50",
     "bend decenter=0,0 tilt=30,0,0\nsurface - 0 1.5 -\nbend decenter=0,-4 tilt=0,0,0\n"
     "surface -50 90 air -"},
    {"RD -50\nTH 90", "TH -30\nRFL\nTLA 45;BEN",
     "bend decenter=0,0 tilt=-45,0,0\nsurface - 0 mirror -\n"
     "bend decenter=0,0 tilt=-45,0,0\nsurface - -30 1.5 -"},
};

static const struct meaning of_pickups[] = {
    {"RD -50\nTH 90", "PK CV 1\nTH 90", "surface 50 90 air -"},
    {"RD -50\nTH 90", "PK CVM -1\nTH 90", "surface -50 90 air -"},
    {"AST", "AST\nCC -1\nAD 1e-5", "surface 50 4 1.5 - k=-1 A4=1e-5 stop"},
    {"AST\nNXT\nRD -50", "AST\nCC -1\nAD 1e-5\nNXT\nPK CVM 1",
     "surface -50 90 air - k=-1 A4=-1e-5"},
    {"RD -50\nTH 90", "RD -50\nPK TH 1", "surface -50 4 air -"},
    {"RD -50\nTH 90", "RD -50\nPK TH 1 0.5", "surface -50 4.5 air -"},
    {"RD -50\nTH 90", "RD -50\nPK THM 1 20", "surface -50 16 air -"},
    {"RD -50\nTH 90", "RD -50\nPK LN 1 0 1", "surface -50 5 air -"},
    {"RD -50\nTH 90", "RD -50\nPK LNM 1 2 20", "surface -50 16 air -"},
    {"AST\nNXT\nRD -50", "AST\nAP 6\nNXT\nPK AP 1", "surface - 90 air 12"},
    {"RD -50\nTH 90", "RD -50\nTH 90\nPK GLA 1", "surface -50 90 1.5 -"},
};

/* n = 1.5, R = 50, t = 6: f = 100, and the image 100 - 6/1.5 = 96 behind the plane side. */
static const char plano[] = "LEN NEW \"plano\" 100 2\nEBR 2.5\nTH 1e20\nNXT\nRD 50\nTH 6\nGLA 1.5\n"
                            "AST\nNXT\nTH 1\nNXT\nEND 2\n";
static const struct meaning of_solves[] = {
    {"TH 1\n", "PY 0\n", "focus paraxial"},
    {"TH 1\n", "PY 1.2\n", "surface - 48 air -"},
    {"AST", "AST\nEC 1", "note line 9: a solve: it is not known; the number in the file is kept"},
    {"AST", "AST\nPI 0.1", "note line 9: a solve: it is not known; the number in the file is kept"},
    {"TH 1\n", "TH 5\nPY 1.2\n",
     "note the thickness of surface 2 is 48 by its solve, the file had 5"},
    {"TH 1\n", "TH 1\nPU -0.049\n", "surface - 1 air - c=-0.02"},
    {"EBR 2.5\nTH 1e20\nNXT\nRD 50\nTH 6\nGLA 1.5\nAST\nNXT\nTH 1\n",
     "NAO 0.1\nOBH -50\nTH 100\nNXT\nTH 6\nGLA 1.5\nAST\nNXT\nPYC 12\n", "surface - 20 air -"},
    {"EBR 2.5\nTH 1e20\nNXT\nRD 50\nTH 6\nGLA 1.5\nAST\nNXT\nTH 1\n",
     "NAO 0.1\nOBH -50\nTH 100\nNXT\nTH 6\nGLA 1.5\nAST\nNXT\nTH 1\nPUC 0.48\n",
     "surface - 1 air - c=-0.02"},
};

static const char stands[] = "the number in the file is kept";
static const char shape[] =
    "AS1: a coefficient of another asphere than ASP ASR and ASP ARA, of order 1 to 20";

static const struct refusal losses[] = {
    {"AST", "AST\n@QQQ 1", "QQQ: an unknown command", ""},
    {"AST", "AST\n\"@ATP\" A 2", "ATP: text where a command is expected", ""},
    {"AST", "AST\n\"@TH\" 2", "TH: text where a command is expected", ""},
    {"AST", "AST\n\"@SNO1\" note", "SNO1: text where a command is expected", ""},
    {"AST", "AST\n@PFL 100", "PFL: a perfect lens", ""},
    {"AST", "AST\n@GSP 0.001", "GSP: a grating", ""},
    {"AST", "AST\n@GC 1", "GC: coordinates of another surface", ""},
    {"AST", "AST\n@TOY 1", "TOY: coordinates of another surface", ""},
    {"AST", "AST\n@CFG 2", "CFG: configurations, in a block behind END", ""},
    {"AST", "AST\n@CVX 0.1", "CVX: a toric surface", ""},
    {"AST", "AST\n@AX1 A 2", "a special aperture that neither obstructs nor transmits", "left out"},
    {"AST", "AST\n@ATP A 1;AAC A 1", "a special aperture that is a hole", "left out"},
    {"AST", "AST\n@ATP A 5;AAC A 4", "a special aperture of an unknown shape", "left out"},
    {"AST", "AST\n@ATP A 2;AAC A 4;AX2 A 2;AY2 A 2;AAN A 90", "a special aperture that is turned",
     "left out"},
    {"AST", "AST\n@ATP A 2;AAC A 4;AX2 A 2", "ATP: an aperture that is not stated whole",
     "left out"},
    {"AST", "AST\nTEM @-300", "a temperature is above -273.15 C", NULL},
    {"AST", "AST\nPRE @-1", "a pressure is not below 0", NULL},
    {"AST", "AST\n@GRT 1", "GRT: an index that changes inside of the glass", ""},
    {"AST", "AST\n@ASP ZER 3", "ASP: an asphere that is not a polynomial of r", ""},
    {"AST", "AST\n@AS1 1e-3", shape, ""},
    {"AST", "AST\nASP ASR\n@AS11 1e-3",
     "AS11: a coefficient of another asphere than ASP ASR and ASP ARA, of order 1 to 20", ""},
    {"RD -50", "RD -50\nTLA 5\n@RCO 1", "RCO: coordinates of another surface", ""},
    {"END 2", "END 2\nCFG NEW\n@PK 1 2 5\nEND",
     "PK: a setting of a configuration that is not known", ""},
    {"END 2", "END 2\nCFG NEW\n@TH 1 5\nEND", "TH: a setting of a configuration that is not known",
     ""},
    {"RD -50\nTH 90\nNXT\nEND 2", "RD -50\nPK TH 1\nNXT\nEND 2\nCFG NEW\n@TH 2 2 5\nEND",
     "TH: a setting of a configuration, of a surface that follows another", ""},
    {"RD -50\nTH 90\nNXT\nEND 2", "RD -50\n@PY 0\nNXT\nEND 2\nCFG NEW\nTH 1 2 5\nEND",
     "a solve in a file with configurations", "each is solved by itself"},
    {"AST", "AST\nDT -1;DCX 1;TLA 5;@BEN",
     "a bend or return of a surface that is turned before it is shifted",
     "without the bend or return"},
    {"AST", "AST\nTLA 5;TLB 1;@BEN", "a bend with turns about more than one axis",
     "only the first is kept"},
    {"AST", "AST\n@PK RDX 0", "PK: a pick-up that is not known", stands},
    {"END 2", "END 2\n@RD 50", "RD: a command behind END: further data of the lens", ""},
    {"END 2", "END 2\nRST NEW\n@F 1 0.5 0.1 0 0.2\nEND",
     "F: a point of the field with a place or a pupil of its own", ""},
    {"EBR 5", "@NAO 0.1", "NAO: a numerical aperture of an object at infinity", ""},
};

/* What stands behind END. */
static const struct meaning of_blocks[] = {
    {"END 2", "END 2\nVAR NEW\nV 1 CV 1\nEND\nOPE NEW\nO 1 \"OCM1\"\nEND 1", "focus table"},
    {"END 2", "END 2\nCFG NEW\nTH 2 2 80\nTH 2 3 70\nEND 3\nCFWT 2 0.5\nCFAC 3 NO",
     "position 1 2 3\nlet d2 90 80 70"},
    {"END 2", "END 2\nCFG NEW\nRD 1 2 40\nEND", "set R1 50 40"},
    {"END 2", "END 2\nCFG NEW\nGLA 1 2 1.6\nCC 2 2 -1\nAS2 1 2 0\nEND",
     "set glass1 1.5 1.6\nset k2 0 -1"},
    {"END 2", "END 2\nCFG NEW\nEBR 2 4\nEND", "let aperture epd 10 epd 8"},
    {"END 2", "END 2\nCFG NEW\nWV1 2 0.6328\nEND", "set wavelength 0.5875618um 0.6328um"},
    {"END 2", "END 2\nCFG NEW\nTH 0 2 100\nEND", "let object inf 100"},
    {"END 2", "END 2\nCFG NEW\nTH 2 1 80\nEND", "surface -50 80 air -"},
    {"END 2", "END 2\nDLRS 3\nDLNR 0 5\nOPDF 1e-12\nRST NEW\nR 1 0 0 0.01\nEND", "focus table"},
    {"NXT\nRD -50", "SEF\nRD -50", "surface -50 90 air -"},
    {"TH 4", "THF 4", "surface 50 4 1.5 - stop"},
    {"RD 50", "RDF 50", "surface 50 4 1.5 - stop"},
    {"AST", "AST\nAPF 5\nLDP 1\nVX 2", "surface 50 4 1.5 10 stop"},
    {"AST", "AST\nDCY 1\nRCO 0", "surface 50 4 1.5 - stop decenter=0,1 tilt=0,0"},
    /*
     * a near object: the beam at the first vertex, where the stop is; or 1/(2 u') of a thin lens of
     * 50 mm, u' = y (1/50 - 1/200): D = 200/12
     */
    {"EBR 5\nANG 10\nWV 0.5875618\nTH 1e20", "EBR 5\nWV 0.55\nTH 200", "aperture epd 10"},
    {"EBR 5\nANG 10\nWV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\n",
     "FNO 4\nWV 0.55\nTH 200\nNXT\nRD 50\nTH 0\n", "aperture epd 16.6666666666667"},
    /* the stop 50 mm behind the first vertex, in air: 10 (200 + 50)/200 */
    {"EBR 5\nANG 10\nWV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5\nAST\nNXT\nRD -50\nTH 90\n",
     "EBR 5\nWV 0.55\nTH 200\nNXT\nTH 50\nNXT\nAST\nTH 90\n", "aperture epd 12.5"},
};

static const struct refusal errors[] = {
    {"LEN NEW \"Singlet\" 50 2\n", "@", "the file does not begin with LEN NEW", NULL},
    {"LEN NEW", "LEN @OLD", "a lens begins with LEN NEW", NULL},
    {"EBR 5", "@LEN NEW", "a second lens in the file", NULL},
    {"\"Singlet\"", "@\"Singlet", "the text does not end with \"", NULL},
    {"EBR 5", "EBR @0", "the aperture must be above 0", NULL},
    {"EBR 5", "EBR@", "the aperture is missing", NULL},
    {"EBR 5", "EBR 5 @6", "'6' does not belong here", NULL},
    {"EBR 5", "UNI @7", "a unit of 7 mm: it is one of 1, 10, 1000, 25.4", NULL},
    {"EBR 5", "UNI @mm", "the unit in mm 'mm' is not a number", NULL},
    {"GLA 1.5", "GLA MOD @nan 47.1", "the index 'nan' is not a number", NULL},
    {"GLA 1.5", "GLA MOD 1@,5 47.1", "the index '1,5' is not a number", NULL},
    {"GLA 1.5", "GLA MOD 12@x3 47.1", "the index '12x3' is not a number", NULL},
    {"GLA 1.5", "GLA -1@,5 1.6", "the index '-1,5' is not a number", NULL},
    {"GLA 1.5", "GLA MOD 1.5 47@,1", "the index '47,1' is not a number", NULL},
    {"ANG 10", "ANG @x", "the field 'x' is not a number", NULL},
    {"ANG 10", "ANG @-181", "a field angle is not beyond 180 degrees", NULL},
    {"WV 0.5875618", "WV 0.55 @550000", "the wavelength is not within 1 nm to 100 mm", NULL},
    {"WV 0.5875618", "WV 0.55\nWW @-1", "a weight is not below 0", NULL},
    {"WV 0.5875618", "WV 0.55\n@WV3 0.5", "number 3 behind 1 wavelengths", NULL},
    {"WV 0.5875618", "WV 0.55\nWV2 @red", "the wavelength 'red' is not a number", NULL},
    {"WV 0.5875618", "WV 0.55\nWV2 0.6 @0.7", "'0.7' does not belong here", NULL},
    {"RD 50", "RD @x", "the radius 'x' is not a number", NULL},
    {"RD 50", "CV @x", "the curvature 'x' is not a number", NULL},
    {"TH 4", "TH@", "the thickness is missing", NULL},
    {"GLA 1.5", "GLA@", "the glass is missing", NULL},
    {"GLA 1.5", "GLA @NOGLASS", "glass 'NOGLASS' is in no catalogue", NULL},
    {"GLA 1.5", "GLA @H_NOGLASS", "glass 'H_NOGLASS' is in no catalogue", NULL},
    {"GLA 1.5", "GLA @1.5 1.6", "2 indices for 1 wavelengths", NULL},
    {"GLA 1.5", "GLA MINE 1.5 @x", "the index 'x' is not a number", NULL},
    {"GLA 1.5", "RFL @1", "'1' does not belong here", NULL},
    {"AST", "AST @1", "'1' does not belong here", NULL},
    {"AST", "AP @-5", "the radius of an aperture is not below 0", NULL},
    {"AST", "AP CHK@", "the radius of the aperture is missing", NULL},
    {"AST", "CC 1 @2", "'2' does not belong here", NULL},
    {"AST", "AD @x", "the coefficient 'x' is not a number", NULL},
    {"AST", "TLA @x", "the tilt 'x' is not a number", NULL},
    {"AST", "DT @x", "the order of shift and turn 'x' is not a number", NULL},
    {"AST", "RCO @x", "the number of the surface is a whole number from 0 on", NULL},
    {"AST", "PY @x", "the target of the solve 'x' is not a number", NULL},
    {"AST", "PK CV @1", "a pick-up from surface 1, which is not before surface 1", NULL},
    {"AST", "PK TH @-2", "a pick-up from surface 2, which is not before surface 1", NULL},
    {"AST", "PK TH 0 1 @2", "'2' does not belong here", NULL},
    {"AST", "PK TH 0 @x", "the offset 'x' is not a number", NULL},
    {"AST", "PK CV @x", "the number of the surface is a whole number from 0 on", NULL},
    {"RD -50", "PK LN 1 @1", "a length from surface 1 to 1", NULL},
    {"RD -50", "PK LN 1 @x", "the number of the surface is a whole number from 0 on", NULL},
    {"END 2", "END 2\nRST NEW\nF 1@", "the point of the field is missing", NULL},
    {"END 2", "END 2\nRST NEW\nF 1 0 @x", "the point of the field 'x' is not a number", NULL},
    {"WV 0.5875618\nTH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5\nAST\nNXT\nRD -50\nTH 90\nNXT\nEND 2\n",
     "TH 1e20\nNXT\nRD 50\nTH 4\nGLA 1.5\nAST\nNXT\nRD -50\nTH 90\nNXT\nEND 2\nCFG NEW\nWV1 2 "
     "0.6\nEND\n",
     "the configurations differ in whether there are wavelengths, which the positions of a lens "
     "cannot",
     "only the first is kept"},
    {"END 2", "END 2\nCFG NEW\nTH @7 2 5\nEND", "surface 7 of 3", NULL},
    {"END 2", "END 2\nCFG NEW\nTH 2 @101 5\nEND", "more than 100 configurations", NULL},
    {"END 2", "END 2\nCFG NEW\nTH 2 @x 5\nEND",
     "the number of the configuration is a whole number from 1 on", NULL},
    {"NXT\nRD -50\nTH 90\nNXT\n", "", "the file has no surface between object and image", NULL},
};

int main(void)
{
    check_meanings("lens.len", good, CASES(of_lens));
    check_meanings("surfaces.len", good, CASES(of_surfaces));
    check_meanings("shifts.len", good, CASES(of_shifts));
    check_meanings("pickups.len", good, CASES(of_pickups));
    check_meanings("solves.len", plano, CASES(of_solves));
    check_meanings("blocks.len", good, CASES(of_blocks));
    check_refusals("lost.len", good, CASES(losses));
    check_refusals("bad.len", good, CASES(errors));
    return check_report();
}
