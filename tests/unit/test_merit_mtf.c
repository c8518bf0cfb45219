/* tests/unit/test_merit_mtf.c - contrast as an operand: what it is by the numbers of a lens. */
/* SPDX-License-Identifier: MIT */
#include "merit_check.h"
#include "merit_truth.h"

#include "design/merit/merit_mtf.h"

/*
 * test_pupil_overlap.c has what contrast is by rays, and check_goals.py its value. Here derivatives
 * by variables are those times the derivatives of rays, by differences in 113 bits.
 */
enum { DIRECTIONS = 2, SIDES = 4, FIELDS = 2 };

/* The lens for some numbers. */
struct truth {
    const struct system *systems; /* one a wavelength */
    struct truth_first first;     /* of the primary one */
    real pupil;                   /* exit pupil of the first wavelength, from the image */
    struct precise_ray chiefs[FIELDS];
    bool has_chief[FIELDS];
};

static bool open_truth(struct merit_bench *bench, const struct merit_slot *slot,
                       const struct merit_bundle *bundle, const double *v, struct truth *truth)
{
    const struct bundle_wish *wish = &bundle->wish;
    const struct lens *lens =
        variables_put(&bench->variables, v, bench->merit.places[slot->place].position);
    struct system *systems = ARENA_ARRAY(bench->arena, wish->wavelength_count, struct system);
    struct system primary;
    struct system_options options = system_options_default();
    struct error error;
    options.stop_radius = 1;
    bool done = system_compile(lens, lens_primary_wavelength(lens), &options, bench->arena,
                               &primary, &error);
    for (size_t i = 0; i < wish->wavelength_count && done; i++) {
        done = system_compile(lens, wish->wavelengths[i].wavelength, &options, bench->arena,
                              &systems[i], &error);
    }
    const double fnumber = bench->merit.question.fnumber;
    truth->systems = systems;
    truth->first = truth_first_of(&primary, fnumber);
    truth->pupil = truth_first_of(&systems[0], fnumber).exit - truth->first.image;
    return done;
}

/* Where a start is in its beam: across the way from the object to the first vertex. */
static void find_from(const struct truth_question *q, const struct precise_ray *start,
                      real parts[PUPIL_PARTS])
{
    static const real vertex[3] = {0, 0, 0};
    const struct precise_ray axis = truth_ray(q->system->lens, q->field, q->first, vertex);
    const real n = q->first->n, *d = axis.p;
    real side = precise_root(d[0] * d[0] + d[1] * d[1]) / n, over = 0, ahead = 0, X[3];
    for (int k = 0; k < 3; k++) {
        over += start->p[k] * d[k];
        ahead -= start->x[k] * d[k];
    }
    for (int k = 0; k < 3; k++) {
        X[k] = start->x[k] + ahead / over * start->p[k];
    }
    real up[2] = {0, 1};
    if (side > 0) {
        up[0] = d[0] / n / side;
        up[1] = d[1] / n / side;
    }
    const real sign = up[1] < 0 || (!(up[1] > 0) && up[0] < 0) ? -1 : 1;
    parts[PUPIL_FROM_X] = sign * (X[0] * up[1] - X[1] * up[0]);
    parts[PUPIL_FROM_Y] = sign * ((X[0] * up[0] + X[1] * up[1]) * d[2] / n - X[2] * side);
}

/* What is known of a ray. */
static void find_parts(struct truth *truth, const struct merit_bundle *bundle, size_t group,
                       size_t point, real parts[PUPIL_PARTS])
{
    const struct bundle_group *of = &bundle->groups[group];
    const struct pupil_point *at = &of->points.points[point];
    const struct system *system = &truth->systems[of->light];
    struct truth_question middle = {.system = &truth->systems[0],
                                    .first = &truth->first,
                                    .field = &bundle->wish.fields[of->field].point};
    struct truth_question question = middle;
    struct precise_ray start, end, *chief = &truth->chiefs[of->field];
    double begin[2];
    merit_bundle_start(bundle, group, point, begin);
    question.system = system;
    question.from_entrance = bundle->wish.from_entrance;
    question.x = (real)at->x;
    question.y = (real)at->y;
    question.begin[0] = middle.begin[0] = begin[0];
    question.begin[1] = middle.begin[1] = begin[1];
    CHECK(truth_start_of(&question, &start));
    end = start;
    CHECK(truth_trace(&question, &end));
    CHECK(truth->has_chief[of->field] || truth_end(&middle, chief));
    truth->has_chief[of->field] = true;
    find_from(&question, &start, parts);
    parts[PUPIL_TO_X] = end.x[0];
    parts[PUPIL_TO_Y] = end.x[1];
    parts[PUPIL_WAVE] = 0;
    if (!bundle->wish.path) {
        return;
    }
    const real n = precise_of(system->n[system->lens->surface_count]);
    const real first_n = precise_of(middle.system->n[system->lens->surface_count]);
    const real way = first_n * truth->pupil / chief->p[2], t = truth_meeting(chief, &end, way, n);
    for (int k = 0; k < 2; k++) {
        parts[k] = (end.x[k] - chief->x[k] + t * end.p[k] / n) / way;
    }
    const real wavelength = (real)bundle->lights[of->light].wavelength / 1000;
    parts[PUPIL_WAVE] = (end.path + n * t) / wavelength;
}

/* By a variable: sum, and the sum of sizes, of what each part of each ray does. */
struct gain {
    real sum;
    double size;
};

/* The parts of all rays by a variable: differences whose error is of fourth order. */
static real (*find_slopes(struct merit_bench *bench, const struct merit_slot *slot,
                          size_t variable))[PUPIL_PARTS]
{
    static const int steps[SIDES] = {-2, -1, 1, 2}, factors[SIDES] = {1, -8, 8, -1};
    const struct merit_bundle *bundle = merit_mtf_look(slot, 0, 0).bundle;
    const size_t points = bundle->groups[0].points.count, count = bundle->group_count * points;
    const double h = ldexp(1, ilogb(bench->variables.scale[variable]) - 13);
    real(*slopes)[PUPIL_PARTS] = arena_array(bench->arena, count, sizeof *slopes);
    for (int k = 0; k < SIDES; k++) {
        double moved[MERIT_MOST];
        struct truth truth = {.systems = NULL};
        memcpy(moved, bench->v, sizeof moved);
        moved[variable] += steps[k] * h;
        CHECK(open_truth(bench, slot, bundle, moved, &truth));
        for (size_t i = 0; i < count; i++) {
            real parts[PUPIL_PARTS];
            find_parts(&truth, bundle, i / points, i % points, parts);
            for (int part = 0; part < PUPIL_PARTS; part++) {
                slopes[i][part] += factors[k] * parts[part] / (12 * (real)h);
            }
        }
    }
    return slopes;
}

static void add_gains(struct merit_bench *bench, const struct merit_slot *slot, size_t variable,
                      struct gain *gains)
{
    const struct merit_bundle *bundle = merit_mtf_look(slot, 0, 0).bundle;
    const size_t points = bundle->groups[0].points.count;
    real(*slopes)[PUPIL_PARTS] = find_slopes(bench, slot, variable);
    for (size_t i = 0; i < bundle->group_count * points * DIRECTIONS; i++) {
        const int d = (int)(i % DIRECTIONS);
        const size_t ray = i / DIRECTIONS, group = ray / points;
        const struct merit_mtf_look look = merit_mtf_look(slot, group, d);
        struct gain *gain = &gains[bundle->groups[group].field * DIRECTIONS + (size_t)d];
        for (int part = 0; part < PUPIL_PARTS; part++) {
            const real one = (real)look.back[part][ray % points] * slopes[ray][part];
            gain->sum += one;
            gain->size += fabs((double)one);
        }
    }
}

/* A slot, both directions of all fields, by each variable: the worst error of scale. */
static double check_slot(struct merit_bench *bench, const struct merit_slot *slot,
                         const double *jacobian)
{
    double worst = 0;
    for (size_t j = 0; j < bench->count; j++) {
        struct gain *gains = ARENA_ARRAY(bench->arena, slot->count, struct gain);
        double scale = 1e-12 / bench->variables.scale[j];
        add_gains(bench, slot, j, gains);
        for (size_t i = 0; i < slot->count; i++) {
            scale = fmax(scale, fmax(fabs((double)gains[i].sum), 1e-3 * gains[i].size));
        }
        for (size_t i = 0; i < slot->count; i++) {
            const double mine = jacobian[(slot->first + i) * bench->count + j];
            const double off = fabs(mine - (double)gains[i].sum);
            worst = fmax(worst, off / scale);
            CHECK(off <= 1e-9 * scale);
            if (!(off <= 1e-9 * scale)) {
                printf("    %s by %s: %.15g, expected %.15g\n", slot->operand->name,
                       bench->list[j].name, mine, (double)gains[i].sum);
            }
        }
    }
    return worst;
}

/* The derivatives of all values are what their differences of fourth order give. */
static void check_differences(struct merit_bench *bench, const char *name, const double *jacobian)
{
    static const int steps[SIDES] = {-2, -1, 1, 2}, factors[SIDES] = {1, -8, 8, -1};
    const size_t rows = bench->merit.residual_count;
    for (size_t j = 0; j < bench->count; j++) {
        const double h = ldexp(1, ilogb(bench->variables.scale[j]) - 12);
        double *slopes = ARENA_ARRAY(bench->arena, rows, double), scale = 0;
        double *values = ARENA_ARRAY(bench->arena, rows, double);
        for (int k = 0; k < SIDES; k++) {
            double moved[MERIT_MOST];
            memcpy(moved, bench->v, sizeof moved);
            moved[j] += steps[k] * h;
            CHECK(merit_evaluate(&bench->merit, moved, values, NULL));
            for (size_t i = 0; i < rows; i++) {
                slopes[i] += factors[k] * values[i] / (12 * h);
            }
        }
        for (size_t i = 0; i < rows; i++) {
            scale = fmax(scale, fmax(fabs(slopes[i]), 1e-4 / bench->variables.scale[j]));
        }
        for (size_t i = 0; i < rows; i++) {
            const double mine = jacobian[i * bench->count + j];
            CHECK_NEAR(mine, slopes[i], 1e-6 * scale, name);
        }
    }
}

static void check_case(const struct merit_case *of, const struct merit_question *looks)
{
    struct arena arena = {0};
    struct error error = {0};
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    const bool opens = merit_bench_look(bench, of, looks, &arena, &error);
    CHECK(opens);
    if (opens) {
        const size_t rows = bench->merit.residual_count, n = bench->count;
        double *residuals = ARENA_ARRAY(&arena, rows, double), worst = 0;
        double *jacobian = ARENA_ARRAY(&arena, rows * n, double);
        const bool done = merit_evaluate(&bench->merit, bench->v, residuals, jacobian);
        CHECK(done);
        for (size_t i = 0; i < bench->merit.slot_count && done; i++) {
            worst = fmax(worst, check_slot(bench, &bench->merit.slots[i], jacobian));
        }
        check_differences(bench, of->name, jacobian);
        printf("%s: contrasts from %.3g, worst error %.2g of scale\n", of->name,
               bench->merit.values[0], worst);
    }
    printf("%s%s", error.message, bench->merit.why.message);
    arena_free(&arena);
}

/* Lenses with every kind of variable, aim, aperture, image plane and field. */
static const char round_lens[] = "wavelength d F\nfield angle 0 9\naperture epd 8\n"
                                 "focus paraxial\nsurface 50 6 1.6/55 -\nsurface -80 3 air -\n"
                                 "surface -40 2 1.7/30 -\nstop - 5 air 8\n"
                                 "surface 70 4 1.5 - k=-1 A4=1e-6\nsurface -35 40 air -\n";
static const char displaced[] = "wavelength e\nfield image 0 5,3\naperture stop\n"
                                "focus table\nsurface 50 6 1.6 -\nsurface -80 3 air -\n"
                                "surface -40 2 1.7 -\nstop - 5 air 7\n"
                                "surface 70 4 1.5 -\nsurface -35 40 air -\n";
static const char near[] = "wavelength e C\nobject 150\nfield height 0 6\n"
                           "aperture na 0.02\nfocus paraxial\nmedium 1.1\n"
                           "surface 40 6 1.6 -\nsurface - 3 1.2 -\nstop - 2 1.2 -\n"
                           "surface -60 5 1.8 - k=2 A4=1e-5\nsurface 90 60 1.1 -\n";
static const char near_image[] = "object 150\nfield image 0 4\naperture na 0.02\n"
                                 "focus paraxial\nsurface 40 6 1.6 -\nsurface - 3 1 -\n"
                                 "stop - 2 1 -\nsurface -60 5 1.8 -\nsurface -90 0 1 -\n";
static const char mirrors[] = "field angle 0 0.5\naperture f/12\nfocus paraxial\n"
                              "stop - 0 air -\n"
                              "surface -160 -50 mirror - k=-1\n"
                              "surface -100 60 mirror - A4=1e-7\n"
                              "surface 90 3 1.5 -\nsurface 400 10 air -\n";
static const char zoom[] = "field angle 0 4\naperture f/8\nfocus table\n"
                           "position wide tele\nlet d2 4 12\nlet d4 30 22\n"
                           "surface 80 4 1.6/60 -\nsurface -200 d2 air -\n"
                           "surface -60 2 1.7 -\nsurface 90 d4 air -\nstop - 1 air 9\n"
                           "surface 40 4 1.6 -\nsurface -50 70 air -\n";

static const char all_round[] = "R1 c2 t1 t4 n1 V1 n5 k5 A4_5 A6_6 R6";
static const char moved[] = "R1 t3 t6 decenter_x2 decenter_y1 tilt_x3 tilt_y5 decenter_y4";
static const char high[] = "mtf@20/mm = 1, gmtf@20/mm = 1", low[] = "mtf@5/mm = 1, gmtf@5/mm = 1",
                  waves[] = "mtf@5/mm = 1";

int main(void)
{
    static const struct merit_question stop = {.fnumber = NAN, .rays = 3};
    static const struct merit_question entrance = {
        .fnumber = NAN, .from_entrance = true, .rays = 3};
    static const struct merit_question more = {.fnumber = NAN, .from_entrance = true, .rays = 10};
    static const struct merit_question fast = {.fnumber = 6, .rays = 3};
    static const struct {
        struct merit_case of;
        const struct merit_question *looks;
    } cases[] = {
        {{"round", round_lens, all_round, high, 0}, &stop},
        {{"round, entrance", round_lens, "R1 c2 t1 n1 A4_5", high, 0}, &more},
        {{"round, f/6", round_lens, "R1 V1 A4_5", high, 0}, &fast},
        {{"displaced", displaced, moved, low, 0}, &stop},
        {{"displaced, entrance", displaced, "R1 t2 R5 t6 tilt_y3", waves, 0}, &entrance},
        {{"near", near, "R1 t2 n4 A4_4", low, 0}, &stop},
        {{"near, entrance", near, "R1 t2 n4 A4_4", waves, 0}, &entrance},
        {{"near image", near_image, "R1 t2 n4 t5", low, 0}, &stop},
        {{"near image, entrance", near_image, "R1 t2 n4", waves, 0}, &entrance},
        {{"displaced, fine", displaced, "R1 t2 R5", high, 0}, &more},
        {{"near image, fine", near_image, "R1", waves, 0}, &more},
        {{"mirrors", mirrors, "R2 t2 k2 R3 A4_3 t3 n4", low, 0}, &stop},
        {{"mirrors moved", mirrors, "R2 t2 tilt_x3 bend_tilt_y3 bend_decenter_x4", low, 0}, &stop},
        {{"zoom", zoom, "R1 R3 t1 n3 t7 V1", low, 0}, &stop},
    };
    /* the operand of 0, 1/2 and 1 millionth, and of what is above */
    CHECK(merit_mtf_contrast(0.5e-6) == 0);
    CHECK_NEAR(merit_mtf_contrast(0.625e-6), 0.5e-6, 1e-18, "half a millionth");
    CHECK_NEAR(merit_mtf_contrast(1e-6), 1e-6, 1e-18, "a millionth");
    CHECK(merit_mtf_contrast(0.3) == 0.3);
    if (sizeof(real) == sizeof(double)) {
        printf("contrast: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_case(&cases[i].of, cases[i].looks);
    }
    return check_report();
}
