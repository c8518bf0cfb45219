/* tests/fuzz/odd_lens.h - a legal but odd lens out of the fuzzer's bytes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_FUZZ_ODD_LENS_H
#define LENSCALC_TESTS_FUZZ_ODD_LENS_H

#include "odd.h"

enum { MOST_SURFACES = 14 };

/* What of a lens's lines depends on those above them. */
struct lens_state {
    unsigned stop, positions, mirrors, surfaces;
    bool has_variable; /* a gap is one */
};

static inline void medium_write(struct page *page, struct bytes *bytes, struct lens_state *state,
                                bool may_reflect)
{
    static const char *const media[] = {"air",        "1.5",
                                        "1.670/47.1", "air",
                                        "N-BK7",      "air",
                                        "4",          "1.0001",
                                        "air",        "SCHOTT:N-SF6",
                                        "1.333",      "1.5168/1e3",
                                        "air",        "{0.2um 1.6, 1um 1.5, 11um 1.4}",
                                        "air",        "2.4/12",
                                        "1",          "mirror",
                                        "CAF2",       "air"};
    const unsigned medium = bytes_pick(bytes, sizeof media / sizeof media[0]);
    const bool is_mirror = strcmp(media[medium], "mirror") == 0;
    state->mirrors += is_mirror && may_reflect;
    page_add(page, " %s", is_mirror && !may_reflect ? "air" : media[medium]);
}

/* A gap to the next vertex, behind mirrors to the left; sometimes the other way. */
static inline void gap_write(struct page *page, struct bytes *bytes, const struct lens_state *state,
                             bool is_last)
{
    const unsigned kind = bytes_pick(bytes, 16);
    const double gap = kind == 0 ? 0 : bytes_amount(bytes, kind == 1 ? 1e-9 : 0.05, 1e4);
    const bool is_back = (state->mirrors % 2 == 1) != (kind == 7);
    if (is_last && kind == 6) {
        page_add(page, " -");
    } else {
        page_add(page, " %.9g", gap * (is_back && gap > 0 ? -1 : 1));
    }
}

/* Shapes that pass or block light, in lines below a surface. */
static inline void shape_write(struct page *page, struct bytes *bytes)
{
    const unsigned shape = bytes_pick(bytes, 32);
    const char *verb = shape % 2 == 0 ? "block" : "pass";
    const double size = bytes_amount(bytes, 0.5, 1e3);
    switch (shape / 2) {
    case 6:
        page_add(page, "%s circle %.6g\n", verb, size);
        break;
    case 1:
        page_add(page, "%s ring %.6g %.6g\n", verb, size / 3, size);
        break;
    case 2:
        page_add(page, "%s rectangle %.6g %.6g turn=30\n", verb, size, size / 7);
        break;
    case 3:
        page_add(page, "%s ellipse %.6g %.6g decenter=1,%.6g\n", verb, size, 5.0, size);
        break;
    case 4:
        page_add(page, "%s polygon 0,0 %.6g,0 0,%.6g %.6g,-1\n", verb, size, size, -size);
        break;
    case 5:
        page_add(page, "block spider %.6g 3\n", size);
        break;
    default:
        break;
    }
}

/* What stands behind a surface's diameter: its figure, where it lies, marks. */
static inline void extras_write(struct page *page, struct bytes *bytes, bool is_curved)
{
    static const int powers[] = {4, 2, 6, 1, 3, 10, 20, 7};
    const unsigned which = bytes_next(bytes);
    double pair[2];
    const bool is_figured = which & 128 && is_curved, is_moved = which >= 192;
    if (which & 1 && is_figured) {
        page_add(page, " k=%.6g", bytes_signed(bytes, 1e-6, 50));
    }
    if (which & 2 && is_figured) {
        const int power = powers[bytes_pick(bytes, 8)];
        page_add(page, " A%d=%.6g", power, bytes_signed(bytes, 1e-12, 1) * pow(0.1, power));
    }
    if (which & 4 && is_moved) {
        bytes_pair(bytes, 1e-9, 85, pair);
        page_add(page, " tilt=%.6g,%.6g", pair[0], pair[1]);
    }
    if (which & 8 && is_moved) {
        bytes_pair(bytes, 1e-9, 100, pair);
        page_add(page, " decenter=%.6g,%.6g", pair[0], pair[1]);
    }
    if ((which & 144) == 16 && which & 4 && is_curved) {
        page_add(page, " cyl=%s", which & 32 ? "x" : "y");
    }
    if (which & 64) {
        page_add(page, " t~%s", which & 32 && is_curved ? " R~" : "");
    }
}

/* Radius of a surface, or focal length of a thick lens; zero is a plane. */
static inline double radius_next(struct bytes *bytes)
{
    static const double usual[] = {50, -50, 20, -100, 12.5, -12.5, 1e9, -1e9};
    const unsigned kind = bytes_next(bytes);
    if (kind % 8 == 7) {
        return 0;
    }
    return kind % 2 == 0 ? usual[kind / 8 % 8] : bytes_signed(bytes, 1e-3, 1e9);
}

static inline void surface_write(struct page *page, struct bytes bytes, struct lens_state *state,
                                 unsigned number)
{
    const bool is_last = number == state->surfaces, is_stop = number == state->stop;
    const unsigned kind = bytes_pick(&bytes, 16);
    const bool is_thick = kind == 1, is_plane_stop = is_stop && kind % 2 == 0;
    if (kind == 3) {
        double turns[2];
        bytes_pair(&bytes, 1e-6, 89, turns);
        const double shift = bytes_signed(&bytes, 1e-6, 50);
        page_add(page, "bend decenter=%.6g,0 tilt=%.6g,%.6g,0\n", shift, turns[0], turns[1]);
    }
    const double radius = radius_next(&bytes);
    const bool is_plane = radius == 0 || is_plane_stop;
    if (is_plane_stop) {
        page_add(page, "stop -");
    } else if (is_plane && !is_thick) {
        page_add(page, "surface -");
    } else {
        page_add(page, "%s %.9g", is_thick ? "thick" : "surface", is_plane ? 100 : radius);
    }
    struct page medium = {0};
    if (is_last && kind < 12) {
        page_add(&medium, " air");
    } else {
        medium_write(&medium, &bytes, state, !is_thick && !is_plane_stop);
    }
    if (state->positions > 1 && !state->has_variable && kind == 5) {
        page_add(page, " gap");
        state->has_variable = true;
    } else {
        gap_write(page, &bytes, state, is_last);
    }
    page_add(page, "%s", medium.text);
    const unsigned clear = bytes_pick(&bytes, 4);
    if (clear == 0 && !is_stop) {
        page_add(page, " -");
    } else {
        page_add(page, " %.6g", clear == 3 ? bytes_amount(&bytes, 1e-3, 1e3) : 10.0 * clear + 2);
    }
    if (is_thick) {
        page_add(page, " hiatus=%.6g", bytes_signed(&bytes, 1e-3, 100));
    }
    extras_write(page, &bytes, !is_thick && !is_plane);
    page_add(page, "%s\n", is_stop && !is_plane_stop ? " stop" : "");
    shape_write(page, &bytes);
}

/* What the lens is used for. */
static inline void use_write(struct page *page, struct bytes *bytes, const struct lens_state *state)
{
    static const char *const colours[] = {"d",      "d F C",      "587.56nm", "400nm 700nm:0.1",
                                          "F d",    "e:2 C:1e-3", "d F C",    "C d F g",
                                          "10.6um", "0.2um"};
    static const char *const foci[] = {"paraxial", "table", "best",     "paraxial",
                                       "best",     "table", "paraxial", "afocal"};
    static const char *const kinds[] = {"angle", "height", "image", "real"};
    page_add(page, "wavelength %s\n",
             colours[bytes_pick(bytes, bytes_pick(bytes, 8) == 7 ? 10 : 8)]);
    page_add(page, "focus %s\n", foci[bytes_pick(bytes, 8)]);
    const unsigned far = bytes_pick(bytes, 3);
    const double object = bytes_amount(bytes, 1e-3, 1e12);
    if (far > 0) {
        page_add(page, "object %.9g%s\n", object, bytes_pick(bytes, 16) == 1 ? " telecentric" : "");
    }
    const unsigned kind = far == 0 ? 2 * bytes_pick(bytes, 2) : bytes_pick(bytes, 4);
    const bool is_usual = bytes_pick(bytes, 2) == 0;
    const double field = is_usual ? 5 : bytes_amount(bytes, 1e-9, kind == 0 ? 175 : 1e3);
    if (kind == 0 && field < 85 && bytes_pick(bytes, 4) == 1) {
        page_add(page, "field angle 0 3,%.6g:0.5\n", field);
    } else {
        page_add(page, "field %s 0 %.6g\n", kinds[kind], field);
    }
    const unsigned rule = bytes_pick(bytes, 5);
    const double size = bytes_amount(bytes, 1e-2, 1e2);
    if (rule == 0 && state->stop > 0) {
        page_add(page, "aperture stop\n");
    } else if (rule == 1 || rule == 0) {
        page_add(page, "aperture f/%.6g\n", size);
    } else if (rule == 2) {
        page_add(page, "aperture epd %.6g\n", size);
    } else if (rule == 3 && far > 0) {
        page_add(page, "aperture na %.6g\n", size / 101);
    }
}

/* The bytes as a .lens. */
static inline void lens_write(struct page *page, struct bytes *input)
{
    struct bytes head = bytes_chunk(input);
    struct lens_state state = {0};
    const size_t rest = (size_t)(input->end - input->at + CHUNK - 1) / CHUNK;
    state.surfaces = rest < MOST_SURFACES ? (unsigned)rest : MOST_SURFACES;
    state.surfaces += state.surfaces == 0;
    state.stop = bytes_pick(&head, 8) == 7 ? 0 : 1 + bytes_pick(&head, state.surfaces);
    state.positions = bytes_pick(&head, 4) == 3 ? 2 : 1;
    page_add(page, "lens odd\nunit %s\n", bytes_pick(&head, 8) == 7 ? "in" : "mm");
    use_write(page, &head, &state);
    if (bytes_pick(&head, 8) == 7) {
        page_add(page, "medium 1.33\n");
    }
    if (state.positions > 1) {
        page_add(page, "position wide tele\n");
    }
    for (unsigned i = 1; i <= state.surfaces; i++) {
        surface_write(page, bytes_chunk(input), &state, i);
    }
    if (state.has_variable) {
        page_add(page, "let gap 1 %.6g\n", bytes_amount(&head, 1e-3, 1e3));
    }
}

#endif
