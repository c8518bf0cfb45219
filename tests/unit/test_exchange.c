/* tests/unit/test_exchange.c - CODE V and OSLO files: read, refused, written and read again. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "exchange/lens_formats.h"
#include "exchange/lens_open.h"
#include "file/lens_glass.h"
#include "optics/first_order.h"

#include <math.h>
#include <stdlib.h>

/* One program run: the glasses and where everything lives. */
struct fixture {
    struct arena arena;
    struct lensdb db;
    struct lens_glasses place;
    struct glass_source glasses;
};

static void open_fixture(struct fixture *fixture)
{
    *fixture = (struct fixture){.arena = {0}};
    fixture->db = (struct lensdb){.arena = &fixture->arena};
    fixture->place = (struct lens_glasses){&fixture->db, &fixture->arena};
    fixture->glasses = lens_glass_source(&fixture->place);
}

static bool read_text(struct fixture *fixture, const char *source, struct text text, bool lossy,
                      struct lens *lens, size_t *losses, struct error *error)
{
    struct foreign_job job = {
        .source = source, .arena = &fixture->arena, .glasses = &fixture->glasses, .lossy = lossy};
    bool read = foreign_read(&job, text, lens, error);
    *losses = job.loss_count;
    return read;
}

static bool is_same_pair(struct pair a, struct pair b)
{
    return a.hi == b.hi && a.lo == b.lo;
}

static bool is_same_surface(const struct surface *a, const struct surface *b)
{
    bool same = a->kind == b->kind && a->is_stop == b->is_stop && a->is_plane == b->is_plane &&
                a->has_diameter == b->has_diameter && a->curved == b->curved &&
                is_same_pair(a->conic.value, b->conic.value) &&
                is_same_pair(a->thickness.value, b->thickness.value) &&
                a->coefficients == b->coefficients &&
                (a->decentre == NULL) == (b->decentre == NULL) &&
                (a->coordinate_break == NULL) == (b->coordinate_break == NULL);
    same = same && (a->is_plane || is_same_pair(a->radius.value, b->radius.value));
    same = same && (!a->has_diameter || is_same_pair(a->diameter.value, b->diameter.value));
    same = same && (!a->has_curvature || is_same_pair(a->curvature.value, b->curvature.value));
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        same = same && is_same_pair(a->coefficient[i].value, b->coefficient[i].value);
    }
    return same;
}

/* Numbers of both to the last bit, at one wavelength. */
static bool is_same_lens(struct fixture *fixture, const struct lens *a, const struct lens *b,
                         double wavelength)
{
    struct error error;
    struct first_order one, other;
    bool same = a->surface_count == b->surface_count && a->stop == b->stop &&
                a->position_count == b->position_count &&
                a->object_is_infinite == b->object_is_infinite && a->focus == b->focus &&
                a->aperture_kind == b->aperture_kind && a->field_count == b->field_count &&
                is_same_pair(a->aperture.value, b->aperture.value) &&
                is_same_pair(a->object.value, b->object.value);
    for (size_t i = 0; same && i < a->field_count; i++) {
        same = is_same_pair(a->fields[i].at[0].value, b->fields[i].at[0].value) &&
               is_same_pair(a->fields[i].at[1].value, b->fields[i].at[1].value) &&
               a->fields[i].weight == b->fields[i].weight;
    }
    for (size_t i = 0; same && i < a->surface_count; i++) {
        struct pair n, m;
        same = is_same_surface(&a->surfaces[i], &b->surfaces[i]) &&
               medium_index(&a->surfaces[i].medium, wavelength, &n, &error) &&
               medium_index(&b->surfaces[i].medium, wavelength, &m, &error) && is_same_pair(n, m);
        if (!same) {
            printf("surface %zu differs\n", i + 1);
        }
    }
    return same && first_order_of_lens(a, wavelength, SECTION_Y, &fixture->arena, &one, &error) &&
           first_order_of_lens(b, wavelength, SECTION_Y, &fixture->arena, &other, &error) &&
           one.power == other.power && one.bfl == other.bfl;
}

/* All lenses of lensdb, written and read again, in all their positions. */
static void check_round_trip(const char *format_name, bool all_positions,
                             const char *const *reasons)
{
    struct fixture names;
    const char *const *list;
    struct error error;
    open_fixture(&names);
    CHECK(lens_open_names(&names.db, LENSDB_EMBEDDED, &names.arena, &list, &error));
    const struct foreign_format *format = foreign_by_name(text_of(format_name));
    for (; *list != NULL; list++) {
        struct fixture fixture;
        struct lens lens, again;
        struct text text;
        size_t losses = 0;
        open_fixture(&fixture);
        bool read = lens_open(&fixture.db, text_of(*list), &fixture.arena, &lens, &error);
        struct foreign_job job = {
            .source = *list, .arena = &fixture.arena, .glasses = &fixture.glasses};
        bool written = read && foreign_write(&job, format, &lens, &text, &error);
        CHECK(read);
        if (!written) { /* it says what the format has no words for, and writes it if allowed */
            bool known = false;
            for (const char *const *reason = reasons; *reason != NULL; reason++) {
                known = known || strstr(error.message, *reason) != NULL;
            }
            if (!known) {
                printf("%s as %s: %s\n", *list, format_name, error.message);
            }
            CHECK(known);
            CHECK(error.code == ERROR_DATA && error.hint[0] != '\0');
            job.lossy = true;
            CHECK(foreign_write(&job, format, &lens, &text, &error) && job.loss_count > 0);
            CHECK(read_text(&fixture, "again", text, true, &again, &losses, &error));
            arena_free(&fixture.arena);
            continue;
        }
        bool back = read_text(&fixture, "again", text, false, &again, &losses, &error);
        size_t positions = all_positions && lens.position_count > 0 ? lens.position_count : 1;
        bool same = back;
        for (size_t i = 0; same && i < positions; i++) {
            const struct lens *one = lens_at_position(&lens, i, &fixture.arena);
            const struct lens *other = lens_at_position(&again, i, &fixture.arena);
            struct lens first = *one, second = *other;
            if (!all_positions) {
                first.position_count = 0;
            }
            same = is_same_lens(&fixture, &first, &second, lens_primary_wavelength(&lens));
        }
        if (!same) {
            printf("%s as %s: %s%s\n", *list, format_name,
                   back ? "differs" : "is not read: ", back ? "" : error.message);
        }
        CHECK(same);
        arena_free(&fixture.arena);
    }
    arena_free(&names.arena);
}

/*
 * N-BK7 in air of T and p: the numbers of test_zemax_solves, of a program of its own. CODE V has mm
 * of mercury, 760 to an atmosphere.
 */
static void check_environment(void)
{
    static const struct {
        const char *name, *text;
        double index;
    } cases[] = {
        {"a.seq",
         "RDM;LEN\nWL 550\nTEM 40\nSO 0 1e20\nS 50 4 NBK7_SCHOTT\nSTO\nS -50 9\nSI 0 0\nGO\n",
         1.5185816350991548},
        {"b.seq",
         "RDM;LEN\nWL 550\nSO 0 1e20\nS 50 4 NBK7_SCHOTT\nSTO\nS -50 9\nSI 0 0\nTEM -30\nPRE 380\n"
         "GO\n",
         1.5186331340439905},
        {"c.len",
         "LEN NEW \"c\"\nWV 0.55\nPRE 0\nNXT\nRD 50\nTH 4\nGLA N-BK7\nAST\nNXT\nTH 9\nNXT\nEND 3\n",
         1.5189446251499588},
        {"d.len",
         "LEN NEW \"d\"\nTEM 40\nPRE 1\nNXT\nRD 50\nTH 4\nGLA N-BK7\nAST\nNXT\nTH 9\nNXT\nWV 0.55\n"
         "END 3\n",
         1.5185816350991548},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        struct lens lens;
        struct error error = {.code = ERROR_NONE};
        struct pair index = {NAN, NAN};
        size_t losses;
        open_fixture(&fixture);
        CHECK(read_text(&fixture, cases[i].name, text_of(cases[i].text), false, &lens, &losses,
                        &error) &&
              medium_index(&lens.surfaces[0].medium, 0.55, &index, &error));
        CHECK_RELATIVE(index.hi, cases[i].index, 4e-16, cases[i].name);
        arena_free(&fixture.arena);
    }
}

#define ZMX                                                                                        \
    "MODE SEQ\nSURF 0\n DISZ INFINITY\nSURF 1\n CURV 0.02\n DISZ 4\nSURF 2\n DISZ 9\nSURF 3\n"
#define SEQ  "RDM;LEN\nSO 0 1e20\nS 50 4 1.5\nS -50 9\nSI 0 0\n"
#define OSLO "LEN NEW \"c\"\nNXT\nRD 50\nTH 4\nGLA 1.5\nNXT\nTH 9\nNXT\n"
#define DAT  "50 4 1.5 20\n-50 4 1 20\n"

/* Files that end as their format does, and such as may be the beginning of a longer one. */
static void check_ends(void)
{
    static const struct {
        const char *name, *text, *why; /* null: it is whole; "": refused */
    } cases[] = {
        {"a.zmx", ZMX " DISZ 0\nMNUM 1 1\n", NULL},
        {"a.zmx", ZMX " DISZ 0\nMNUM 1 1", "its last line has no end"},
        {"a.zmx", ZMX " DISZ 0\n", "nothing stands behind its surfaces"},
        {"a.zmx", ZMX " DISZ 0\n MEMA 1\n", "nothing stands behind its surfaces"},
        {"a.zmx", ZMX "MNUM 1 1\n", "its last surface has no distance DISZ"},
        {"a.zmx", ZMX " GLAS ___BLANK 1 0 1.5 0\n DISZ 4\n", ""},
        {"a.zmx", ZMX " DISZ 0\nMNUM 2 1\nTHIC 2 1 9\nTHIC 2 2 8\n",
         "neither CSUM nor MOFF stands behind its configurations"},
        {"a.zmx", ZMX " DISZ 0\nMNUM 2 1\nTHIC 2 1 9\nTHIC 2 2 8\nCSUM 1\n", NULL},
        {"a.seq", SEQ "GO", NULL},
        {"a.seq", SEQ, "no GO stands at its end"},
        {"a.len", OSLO "END 3\n", NULL},
        {"a.len", OSLO, "no END stands behind its surfaces"},
        {"a.len", OSLO "GLA 1.6\n", ""},
        {"a.len", OSLO "END 3\nCFG\nTH 2 2 8\n", "no END stands behind its last block"},
        {"a.dat", DAT "0 3 0 9\n", NULL},
        {"a.dat", DAT, "it has no stop, a surface of radius 0"},
        {"a.dat", DAT "0 3 0 9\n40 4 1.6 20\n", "behind its last surface is glass"},
        {"a.lens", "surface 50 4 1.5 20\n", NULL},
        {"a.lens", "surface 50 4 1.336/55 20\n", NULL},
        {"a.lens", "surface 50 4 N-BK7 20\n", "the glass N-BK7 lies before the image"},
        {"a.lens", "surface 50 4 1.6/40 20\n", "the glass 1.6/40 lies before the image"},
        {"a.lens", "surface 50 4 air 20", "its last line has no end"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        struct lens lens = {0};
        struct error error = {.code = ERROR_NONE};
        size_t losses;
        open_fixture(&fixture);
        const bool done = read_text(&fixture, cases[i].name, text_of(cases[i].text), false, &lens,
                                    &losses, &error);
        const bool is_refusal = cases[i].why != NULL && cases[i].why[0] == '\0';
        const char *told = done ? lens.cut_short : strstr(error.message, "cut short");
        const bool same = cases[i].why == NULL
                              ? done && told == NULL
                              : done != is_refusal && told != NULL && strstr(told, cases[i].why);
        if (!same) {
            printf("%s: %s\n%s\n", cases[i].text, told, error.message);
        }
        CHECK(same);
        arena_free(&fixture.arena);
    }
}

int main(void)
{
    static const char *const codev[] = {"nd is not from 1 to 2", NULL};
    static const char *const oslo[] = {"the positions", "a cylinder", "no stop", NULL};
    check_round_trip("seq", true, codev);
    check_round_trip("len", false, oslo);
    check_environment();
    check_ends();
    return check_report();
}
