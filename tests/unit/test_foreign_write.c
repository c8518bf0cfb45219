/* tests/unit/test_foreign_write.c - lenses as CODE V, OSLO, Zemax and pbrt have them. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"

static const char good[] = "lens Singlet\n"
                           "wavelength d\n"
                           "field angle 0 10\n"
                           "aperture epd 10\n"
                           "focus table\n"
                           "surface 50 4 1.5 12 stop\n"
                           "surface -50 90 air -\n";

/* What a format cannot hold, and what --lossy does instead, or "". */
struct loss {
    const char *old, *now, *message, *instead;
};

static struct text written(struct fixture *fixture, const char *format, const char *old,
                           const char *now, bool *done)
{
    long line;
    int column;
    struct text text = {"", 0};
    fixture_open(fixture, "case.lens");
    struct text file = case_file(fixture, good, old, now, &line, &column);
    CHECK(foreign_read(&fixture->job, file, &fixture->lens, &fixture->error));
    fixture->job.lossy = *done;
    *done = foreign_write(&fixture->job, foreign_by_name(text_of(format)), &fixture->lens, &text,
                          &fixture->error);
    return text;
}

/* The lines are in the file that is written. */
static void check_written(const char *format, const struct meaning *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct fixture fixture;
        char wanted[600];
        bool done = false;
        struct text text = written(&fixture, format, cases[i].old, cases[i].now, &done);
        char *plain = arena_string(&fixture.arena, text.start, text.length), *to = plain;
        for (const char *from = plain; *from != '\0'; from++) {
            *to = *from;
            to += *from != '\r';
        }
        *to = '\0';
        snprintf(wanted, sizeof wanted, "\n%s\n", cases[i].lines);
        const char *lines = single_blanks(&fixture, text_of(plain));
        bool found = done && strstr(lines, wanted) != NULL;
        if (!found) {
            printf("%s: %s\n    wanted %s    found  %s\n", format, cases[i].now, wanted,
                   done ? lines : fixture.error.message);
        }
        CHECK(found);
        arena_free(&fixture.arena);
    }
}

/* Refused without --lossy, and listed with it. */
static void check_losses(const char *format, const struct loss *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct fixture strict, lossy;
        char refused[600], listed[600];
        bool done = false, lost = true;
        written(&strict, format, cases[i].old, cases[i].now, &done);
        written(&lossy, format, cases[i].old, cases[i].now, &lost);
        snprintf(refused, sizeof refused, "cannot be kept: %s", cases[i].message);
        snprintf(listed, sizeof listed, "%s%s%s", cases[i].message,
                 cases[i].instead[0] != '\0' ? "; " : "", cases[i].instead);
        bool same = !done && is_error(&strict.error, 0, 0, refused) && lost &&
                    lossy.job.loss_count == 1 && lossy.job.losses[0].line == 0 &&
                    strcmp(lossy.job.losses[0].what, listed) == 0;
        if (!same) {
            printf("%s: %s\n    wanted %s\n    found  %s\n    listed %s\n", format, cases[i].now,
                   refused, done ? "written without a word" : strict.error.message,
                   lossy.job.loss_count > 0 ? lossy.job.losses[0].what : lossy.error.message);
        }
        CHECK(same);
        arena_free(&strict.arena);
        arena_free(&lossy.arena);
    }
}

static const struct meaning codev[] = {
    {"", "", "RDM;LEN\nTITLE 'Singlet'\nEPD 10\nDIM M\nWL 587.5618\nREF 1\nWTW 1"},
    {"", "", "XAN 0.0 0.0\nYAN 0 10\nPRV\n PWL 587.5618\n 'N1' 1.5\nEND\nSO 0.0 0.1e14"},
    {"", "", "S 50 4 'N1'\n STO\n CIR 6\nS -50 90\nSI 0.0 0.0\nGO"},
    {"lens Singlet", "lens it's\nunit in", "TITLE \"it's\"\nEPD 10\nDIM I"},
    {"lens Singlet", "unit cm", "EPD 10\nDIM C"},
    {"lens Singlet", "source a book\nkind x\nstated efl 50.5\nnote one",
     "RDM;LEN\n! lenscalc: source a book\n! lenscalc: kind x\n! lenscalc: stated efl 50.5\n"
     "! lenscalc: note one"},
    {"aperture epd 10", "aperture stop", "! lenscalc: the stop's diameter rules, not EPD\nEPD 12"},
    {"lens Singlet", "unit m", "EPD 10000\nDIM M"}, /* CODE V has no metres */
    {"lens Singlet", "unit m", "S 50000 4000 'N1'\n STO\n CIR 6000"},
    {"wavelength d", "wavelength 0.5um F:0.25 600nm", "WL 500 486.1327 600\nREF 1\nWTW 1 0.25 1"},
    {"aperture epd 10", "aperture f/4", "TITLE 'Singlet'\nFNO 4"},
    {"aperture epd 10", "aperture na 0.1\nobject 200", "NAO 0.1"},
    {"aperture epd 10", "aperture na 0.1\nobject 200", "SO 0.0 200"},
    {"aperture epd 10\n", "", "TITLE 'Singlet'\nDIM M"},
    {"field angle 0 10", "field height 0 -5\nobject 200", "XOB 0.0 0.0\nYOB 0 -5"},
    {"field angle 0 10", "field image 21.6", "XIM 0.0\nYIM 21.6"},
    {"1.5 12", "1.5168/64.17 12", "S 50 4 5168.6417"},
    {"1.5 12", "1.5/64 12", "S 50 4 500.64"},
    {"1.5 12", "SCHOTT:N-BK7 12", "S 50 4 NBK7_SCHOTT"},
    {"1.5 12", "{500nm 1.52, 600nm 1.51} 12", " PWL 500 600\n 'N1' 1.52 1.51\nEND"},
    {"1.5 12", "mirror 12", "S 50 4 REFL"},
    {"focus table", "focus paraxial", " PIM\nSI 0.0 0.0"},
    {"12 stop", "12 stop k=-1", " CON\n K -1"},
    {"12 stop", "12 stop A4=1e-5 A20=1e-21", " ASP\n K 0.0\n A 1e-5\n J 1e-21"},
    {"12 stop", "12 stop A1=1e-3 A2=1e-4 k=2",
     " SPS ODD 0.0\n SCO K 2\n SCO AR1 1e-3\n SCO AR2 1e-4"},
    {"12 stop", "12 stop cyl=y", "S 50 4 'N1'\n CYL\n STO"},
    {"12 stop", "12 stop cyl=x", "S 0.0 4 'N1'\n CYL\n RDX 50\n STO"},
    {"50 4 1.5 12", "- 4 1.5 12 c=0.0312345", "S 0.0 4 'N1'\n CUY 0.0312345"},
    {"12 stop", "12 stop name=\"front\"", " SLB 'front'"},
    {"12 stop", "12 stop decenter=0.5,-1 tilt=2,-3",
     " XDE 0.5; YDE -1; ZDE 0.0\n ADE -2; BDE 3; CDE 0\n DAR"},
    {"surface 50", "bend decenter=0.5,-1 tilt=2,-3,4\nsurface 50",
     " XDE 0.5; YDE -1; ZDE 0.0\n ADE -2; BDE 3; CDE 4"},
    {"aperture epd 10\nfocus table\nsurface 50 4",
     "position a b\nlet d1 4 5\nlet aperture epd 10 epd 8\nlet object inf 300\nfocus table\n"
     "surface 50 d1",
     "ZOO 2\nZOO TIT\nTIT Z1 'a'\nTIT Z2 'b'\nZOO EPD 10 8\nZOO THI SO 0.1e14 300\nZOO THI S1 4 5"},
};

static const struct meaning oslo[] = {
    {"", "", "LEN NEW \"Singlet\" 100 3\nEBR 5\nANG 10"},
    {"", "", "UNI 1.0\nAIR\nTH 1.0e+20\nNXT\nGLA 1.5\nRD 50\nTH 4\nAP CHK 6\nAST\nNXT\nAIR"},
    {"", "", "RD -50\nTH 90\nNXT\nAIR\nWV 0.5875618\nWW 1.0\nEND 3\nRST NEW"},
    {"field angle 0 10", "field image 0 10 20", "F 2 0.5 0.0 0.0 0.0 0.0 -1.0 1.0 -1.0 1.0 1.0"},
    {"field angle 0 10\naperture epd 10", "field height 0 -5\nobject 200\naperture na 0.1",
     "NAO 0.1\nOBH -5"},
    {"lens Singlet", "unit in", "UNI 25.4"},
    {"lens Singlet", "unit m", "UNI 1000.0"},
    {"lens Singlet", "lens x\nnote one\nnote two", "SNO1 \"one\"\nSNO2 \"two\""},
    {"wavelength d", "wavelength 500nm F:0.25", "WV 0.500 0.4861327\nWW 1.0 0.25"},
    {"aperture epd 10", "aperture f/4", "FNO 4"},
    {"1.5 12", "1.5168/64.17 12", "WV 0.58756 0.48613 0.65627\nGLA MOD 1.5168 64.17"},
    {"1.5 12", "SCHOTT:N-BK7 12", "GLA NBK7"},
    {"1.5 12", "OHARA:S-BSL7 12", "GLA O_SBSL7"},
    {"1.5 12", "HOYA:BSC7 12", "GLA H_BSC7"},
    {"1.5 12", "{500nm 1.52, 600nm 1.51} 12", "WV 0.5 0.6\nGLA MOD MODEL1 1.52 1.51"},
    {"1.5 12", "mirror 12", "RFL\nRD 50"},
    {"focus table", "focus paraxial", "TH 90\nPY 0.0"},
    {"12 stop", "12 stop k=-1 A4=1e-5 A10=2e-9", "CC -1\nAD 1e-5\nAG 2e-9"},
    {"12 stop", "12 stop A2=1e-5 A20=2e-9", "ASP ASR 10\nAS1 1e-5\nAS10 2e-9"},
    {"12 stop", "12 stop A3=1e-5 A20=2e-9", "ASP ARA 20\nAS3 1e-5\nAS20 2e-9"},
    {"50 4 1.5 12", "- 4 1.5 12 c=0.0312345", "GLA 1.5\nCV 0.0312345"},
    {"12 stop", "12 stop decenter=0.5,-1 tilt=2,-3",
     "DT 1\nDCX 0.5\nDCY -1\nTLA -2\nTLB 3\nTLC 0\nRCO"},
    {"surface 50", "bend decenter=0,0 tilt=1,-2,4\nsurface 50",
     "DT 1\nDCX 0\nDCY 0\nTLA -1\nTLB 2\nTLC 4\nNXT"},
};

static const struct meaning zemax[] = {
    {"", "", "MODE SEQ\nNAME Singlet\nUNIT MM X W X CM MR CPMM\nENPD 10"},
    {"", "", "FTYP 0 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 10\nWAVM 1 0.5875618 1\nPWAV 1"},
    {"", "",
     "SURF 1\n TYPE STANDARD\n STOP\n CURV 0.02 0 0 0 0 \"\"\n DIAM 6 1 0 0 1 \"\"\n"
     " GLAS ___BLANK 1 0 1.5 0 0 0 0 0 0 0\n DISZ 4"},
    {"", "", "SURF 2\n TYPE STANDARD\n CURV -0.02 0 0 0 0 \"\"\n DISZ 90\nSURF 3"},
    {"lens Singlet", "unit m", "UNIT METER X W X CM MR CPMM"},
    {"field angle 0 10", "field image 0 5", "FTYP 2 0 2 1 0 0 0\nXFLN 0 0\nYFLN 0 5"},
    {"aperture epd 10", "aperture f/4", "FNUM 4 0"},
    {"aperture epd 10", "aperture stop", "FLOA"},
    {"1.5 12", "SCHOTT:N-BK7 12", "GCAT SCHOTT"},
    {"1.5 12", "SCHOTT:N-BK7 12", " GLAS N-BK7 0 0 1.5168 64.167336 0 0 0 0 0 0"},
    {"1.5 12", "mirror 12", " GLAS MIRROR 0 0 0 0 0 0 0 0 0 0"},
    {"focus table", "focus paraxial", " DISZ 90\n MAZH 0 0"},
    {"12 stop", "12 stop k=-1 A16=1e-20 A4=1e-5", " CONI -1\n PARM 2 1e-5\n PARM 8 1e-20"},
    {"12 stop", "12 stop A18=1e-20",
     " XDAT 1 10 0 0 1 0 0 \"\"\n XDAT 2 1 0 0 1 0 0 \"\"\n XDAT 11 1e-20 0 0 1 0 0 \"\""},
    {"12 stop", "12 stop A3=1e-4", "SURF 1\n TYPE ODDASPHE"},
    {"12 stop", "12 stop A3=1e-4", " PARM 3 1e-4"},
    {"12 stop", "12 stop A9=1e-9",
     " XDAT 1 20 0 0 1 0 0 \"\"\n XDAT 2 1 0 0 1 0 0 \"\"\n XDAT 11 1e-9 0 0 1 0 0 \"\""},
    {"12 stop", "12 stop cyl=x", " CURV 0 0 0 0 0 \"\"\n PARM 1 50"},
    {"12 stop", "12 decenter=0.5,-1 tilt=2,-3 stop",
     "SURF 1\n TYPE COORDBRK\n PARM 1 0.5\n PARM 2 -1\n PARM 3 2\n PARM 4 -3\n PARM 5 0\n PARM 6 "
     "0"},
    {"12 stop", "12 decenter=0.5,-1 tilt=2,-3 stop",
     "SURF 3\n TYPE COORDBRK\n PARM 1 -0.5\n PARM 2 1\n PARM 3 -2\n PARM 4 3\n PARM 5 0\n PARM 6 "
     "1"},
    {"aperture epd 10\nfocus table\nsurface 50 4 1.5 12",
     "position a b\nlet d1 4 5\nlet e 12 10\nlet aperture f/4 f/5.6\nlet object inf 300\n"
     "focus table\nsurface 50 d1 1.5 e",
     "MNUM 2 1\nTHIC 0 1 1e10 0 0 0 1 1 1 0 0 \"\" 0\nTHIC 0 2 300 0 0 0 1 1 1 0 0 \"\" 0\n"
     "THIC 1 1 4 0 0 0 1 1 1 0 0 \"\" 0\nTHIC 1 2 5 0 0 0 1 1 1 0 0 \"\" 0\n"
     "SDIA 1 1 6 0 0 0 1 1 1 0 0 \"\" 0\nSDIA 1 2 5 0 0 0 1 1 1 0 0 \"\" 0\n"
     "APER 0 1 4 0 0 0 1 1 1 0 0 \"\" 0\nAPER 0 2 5.6 0 0 0 1 1 1 0 0 \"\" 0"},
    {"surface 50 4 1.5 12 stop", "thick -12.5 4 1.33 12 stop",
     "SURF 1\n TYPE PARAXIAL\n STOP\n CURV 0 0 0 0 0 \"\"\n PARM 1 -12.5\n PARM 2 1\n"
     " DIAM 6 1 0 0 1 \"\"\n GLAS ___BLANK 1 0 1.33 0 0 0 0 0 0 0\n DISZ 4"},
    {"surface 50 4 1.5 12 stop", "position a b\nlet f 50 60\nthick f 4 1.5 12 stop",
     "MNUM 2 1\nPAR1 1 1 50 0 0 0 1 1 1 0 0 \"\" 0\nPAR1 1 2 60 0 0 0 1 1 1 0 0 \"\" 0"},
};

static const char near_fnumber[] = "aperture f/4\nobject 200";

static const struct loss codev_losses[] = {
    {"lens Singlet", "lens it's \"x\"", "a text with both kinds of quotes",
     "the double ones are left out"},
    {"1.5 12", "2.1/20 12",
     "a glass whose nd is not from 1 to 2 or whose Vd is not from 0 to 100 has no code",
     "it is written nd:Vd"},
    {"aperture epd 10", near_fnumber, "the f-number of a lens with a near object",
     "CODE V takes it as the working one"},
    {"focus table", "focus best", "the best focus", "the image lies at the last thickness"},
    {"12 stop", "12 stop R~", "marks for the designer (R~, t~)", "left out"},
    {"12 stop", "12 stop cyl=y A2=1e-4",
     "CODE V has no cylinder with the coefficient A2 or odd ones", ""},
};
static const struct loss oslo_losses[] = {
    {"lens Singlet", "lens a \"x\"", "double quotes inside of a text", "left out"},
    {"aperture epd 10", near_fnumber, "the f-number of a lens with a near object",
     "OSLO takes it as the working one"},
    {"aperture epd 10", "aperture epd 10\nobject 200",
     "the aperture of a lens with a finite object: OSLO needs its NA, write 'aperture na'", ""},
    {"12 stop", "12", "the lens has no stop", "OSLO takes its first surface"},
    {"focus table", "focus best", "the best focus", "the image lies at the last thickness"},
    {"focus table\nsurface 50 4", "position a b\nlet d1 4 5\nfocus table\nsurface 50 d1",
     "the positions but the first: write them one by one", ""},
    {"12 stop", "12 stop t~[1,2]", "marks for the designer (R~, t~)", "left out"},
    {"12 stop", "12 stop cyl=y", "a cylinder", "written as curved in both sections"},
    {"lens Singlet",
     "note 1\nnote 2\nnote 3\nnote 4\nnote 5\nnote 6\nnote 7\nnote 8\nnote 9\n"
     "note 10\nnote 11",
     "more than ten notes", ""},
};
static const struct loss zemax_losses[] = {
    {"1.5 12", "{500nm 1.52, 587.5618nm 1.51, 600nm 1.5} 12", "a medium given by a table",
     "its index at 0.587562 um is used instead"},
    {"12 stop", "12 stop cyl=y A4=1e-4", "surface 1: a cylinder with aspheric terms",
     "they are left out"},
    {"12 stop", "12 stop cyl=x k=-1", "surface 1: a cylinder with aspheric terms",
     "they are left out"},
    {"12 stop", "12 stop R~", "surface 1: the marks of what may vary", "left out"},
    {"focus table", "focus best", "the best focus", "the image lies at the last thickness"},
    {"surface 50 4 1.5 12 stop", "thick 50 4 1.5 12 stop hiatus=2",
     "surface 1: a thick lens whose principal planes lie apart",
     "they fall together, and what lies behind moves"},
    {"surface 50 4 1.5 12 stop", "thick 50 4 1.5 12 stop distortion=0,0.1",
     "surface 1: the distortion of a thick lens", "left out"},
    {"field angle 0 10", "field angle 0 1 2 3 4 5 6 7 8 9 10 11 12", "more than 12 fields",
     "those beyond are left out"},
};

int main(void)
{
    check_written("seq", CASES(codev));
    check_written("len", CASES(oslo));
    check_written("zmx", CASES(zemax));
    check_losses("seq", CASES(codev_losses));
    check_losses("len", CASES(oslo_losses));
    check_losses("zmx", CASES(zemax_losses));
    return check_report();
}
