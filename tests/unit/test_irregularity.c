/* tests/unit/test_irregularity.c - deformed surfaces against surfaces of that shape. */
/* SPDX-License-Identifier: MIT */
#include "lens_of.h"

#include "design/merit/merit.h"
#include "design/merit/merit_rays.h"
#include "design/tolerance/irregularity.h"

enum { MOST = 4, ROWS = 2048 };

/* The first derivatives of one operand of a lens. */
struct looked {
    size_t rows, columns;
    double jacobian[ROWS * 2 * MOST], residuals[ROWS];
};

/* The lens, and by what it is derived: variables, then irregularities. */
struct look {
    const char *text, *const *names;
    size_t name_count;
    const struct irregularity *irregularities;
    size_t irregularity_count;
    const double *amounts; /* null: columns are wanted */
    enum operand_kind kind;
    bool from_entrance;
};

static bool open_variables(const struct look *look, const struct lens *lens, struct arena *arena,
                           struct variables *variables, struct error *error)
{
    struct variable list[MOST];
    for (size_t i = 0; i < look->name_count; i++) {
        list[i] = (struct variable){.position = LENS_NONE,
                                    .low = -INFINITY,
                                    .high = INFINITY,
                                    .name = look->names[i],
                                    .scale = 1};
        CHECK(parameter_read(text_of(look->names[i]), NULL, &list[i].what, error));
    }
    return variables_open(lens, list, look->name_count, arena, variables, error);
}

static void look_at(const struct look *look, struct looked *looked)
{
    struct arena arena = {0};
    const struct lens lens = lens_of(look->text, &arena);
    const struct operand operand = {.kind = look->kind,
                                    .deviation = 1,
                                    .wavelength = NAN,
                                    .position = LENS_NONE,
                                    .first = LENS_NONE,
                                    .last = LENS_NONE,
                                    .frequency = NAN,
                                    .name = "it"};
    struct variables variables;
    struct merit merit;
    struct error error = {.code = ERROR_NONE};
    const struct merit_question question = {.lens = &lens,
                                            .variables = &variables,
                                            .variable_count = look->name_count,
                                            .irregularities = look->irregularities,
                                            .irregularity_count = look->irregularity_count,
                                            .irregularity_amounts = look->amounts,
                                            .operands = &operand,
                                            .operand_count = 1,
                                            .fnumber = NAN,
                                            .from_entrance = look->from_entrance,
                                            .pattern = PATTERN_GAUSS,
                                            .rays = 12};
    double numbers[MOST];
    *looked = (struct looked){0};
    const bool opens = open_variables(look, &lens, &arena, &variables, &error) &&
                       merit_open(&question, &arena, &merit, &error);
    CHECK(opens);
    if (opens && merit.residual_count <= ROWS) {
        variables_get(&variables, numbers);
        const bool has = look->amounts == NULL;
        CHECK(merit_evaluate(&merit, numbers, looked->residuals, has ? looked->jacobian : NULL));
        if (!has) {
            CHECK(merit_beams_deform(merit.slots[0].beams, &error));
            CHECK(merit_evaluate(&merit, numbers, looked->residuals, NULL));
        }
        looked->rows = merit.residual_count;
        looked->columns = merit.variable_count;
    } else {
        printf("%s\n", error.message);
    }
    CHECK(looked->rows > 0);
    arena_free(&arena);
}

/* The columns of one against a sum of columns of another, by the largest of them. */
static void compare_within(const struct looked *is, size_t column, const struct looked *of,
                           const double *factors, double tolerance, const char *what)
{
    double largest = 0, worst = 0;
    CHECK(is->rows == of->rows);
    for (size_t i = 0; i < is->rows; i++) {
        double sum = 0;
        for (size_t j = 0; j < of->columns; j++) {
            sum += factors[j] * of->jacobian[i * of->columns + j];
        }
        largest = fmax(largest, fabs(sum));
        worst = fmax(worst, fabs(is->jacobian[i * is->columns + column] - sum));
    }
    CHECK(largest > 0);
    CHECK_NEAR(worst / largest, 0, tolerance, what);
}

static void compare(const struct looked *is, size_t column, const struct looked *of,
                    const double *factors, const char *what)
{
    compare_within(is, column, of, factors, 1e-11, what);
}

/*
 * What is deformed lies before a stop that stays as it is: a stop whose size or place paraxial rays
 * decide on would change with the shape too, and the exit pupil.
 */
#define LENS(moved)                                                                                \
    "wavelength d F\nfield angle 0 5,9\naperture stop\nfocus table\nsurface - 3 air -\n"           \
    "surface 50 6 1.6/55 -\n" moved "\nstop - 5 air 7\nsurface 70 4 1.5 -\nsurface -35 66 air -\n"
static const enum operand_kind kinds[] = {OPERAND_SPOT, OPERAND_OPD, OPERAND_HEIGHT};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* A sphere of Zernike's is a piston, a parabola and a surface of fourth order. */
static void check_spherical(void)
{
    static const char *const names[] = {"A2_3", "A4_3", "t2", "t3"};
    const double R = 5;
    const struct irregularity of = {2, IRREGULARITY_SPHERICAL, R};
    const double factors[] = {-4 / (R * R), 4 / (R * R * R * R), 2.0 / 3, -2.0 / 3, 0};
    static struct looked looked;
    for (size_t i = 0; i < KINDS; i++) {
        const struct look look = {.text = LENS("surface -80 3 air - k=0.5 A4=2e-6"),
                                  .names = names,
                                  .name_count = 4,
                                  .irregularities = &of,
                                  .irregularity_count = 1,
                                  .kind = kinds[i]};
        look_at(&look, &looked);
        compare(&looked, 4, &looked, factors, "spherical");
    }
}

/* Rays through the entrance pupil; a mirror. */
static void check_mirror(void)
{
    static const char *const names[] = {"A2_2", "A4_2", "t1", "t2"};
    const double R = 5;
    const struct irregularity of = {1, IRREGULARITY_SPHERICAL, R};
    const double factors[] = {-4 / (R * R), 4 / (R * R * R * R), 2.0 / 3, -2.0 / 3, 0};
    static struct looked looked;
    const struct look look = {.text = "field angle 0 1\naperture epd 9\nfocus table\n"
                                      "stop - 30 air -\nsurface -160 -50 mirror - k=-1\n"
                                      "surface -90 3 1.5 -\nsurface 400 -30 air -\n",
                              .names = names,
                              .name_count = 4,
                              .irregularities = &of,
                              .irregularity_count = 1,
                              .kind = OPERAND_SPOT,
                              .from_entrance = true};
    look_at(&look, &looked);
    compare(&looked, 4, &looked, factors, "spherical");
}

/* On a surface that is shifted and tilted: two radii, so that no piston is left. */
static void check_moved(void)
{
    static const char *const names[] = {"A2_3", "A4_3"};
    const struct irregularity of[] = {{2, IRREGULARITY_SPHERICAL, 5},
                                      {2, IRREGULARITY_SPHERICAL, 4}};
    const double p = 4 / (5.0 * 5), q = 4 / (4.0 * 4);
    const double factors[] = {q - p, p * p / 4 - q * q / 4, 0, 1};
    static struct looked looked;
    for (size_t i = 0; i < KINDS; i++) {
        const struct look look = {.text = LENS("surface -80 3 air - k=0.5 A4=2e-6 "
                                               "decenter=0.5,-0.3 tilt=4,-3"),
                                  .names = names,
                                  .name_count = 2,
                                  .irregularities = of,
                                  .irregularity_count = 2,
                                  .kind = kinds[i]};
        look_at(&look, &looked);
        compare(&looked, 2, &looked, factors, "of a surface that is moved");
    }
}

#define TURNED(surface) "bend tilt=0,0,45\n" surface "\nbend tilt=0,0,-45"

/* Astigmatism is the difference of two cylinders. */
static void check_astigmatism(void)
{
    static const char *const names[] = {"c3"};
    static const struct {
        enum irregularity_form form;
        const char *x, *y;
    } cases[] = {
        {IRREGULARITY_COS, LENS("surface - 3 air - cyl=x c=1e-14"),
         LENS("surface - 3 air - cyl=y c=1e-14")},
        {IRREGULARITY_SIN, LENS(TURNED("surface - 3 air - cyl=x c=1e-14")),
         LENS(TURNED("surface - 3 air - cyl=y c=1e-14"))},
    };
    static struct looked x, y;
    const double R = 6, factors[] = {1 / (R * R), 0};
    for (size_t i = 0; i < 2 * KINDS; i++) {
        const struct irregularity of = {2, cases[i % 2].form, R};
        struct look look = {.text = cases[i % 2].x,
                            .names = names,
                            .name_count = 1,
                            .irregularities = &of,
                            .irregularity_count = 1,
                            .kind = kinds[i / 2]};
        look_at(&look, &x);
        look.text = cases[i % 2].y;
        look_at(&look, &y);
        for (size_t k = 0; k < x.rows; k++) {
            x.jacobian[2 * k] -= y.jacobian[2 * k];
        }
        /* a form on a surface that is turned is turned with it */
        if (cases[i % 2].form == IRREGULARITY_SIN) {
            look.text = LENS("surface - 3 air -");
            look_at(&look, &y);
        }
        compare(&y, 1, &x, factors, "astigmatism");
    }
}

/* The first surface, whose rays begin before it, does what it does behind one without effect. */
static void check_first(void)
{
    static const char *const first = "wavelength d\nfield angle 0 5,9\naperture epd 8\n"
                                     "focus table\nsurface 50 6 1.6/55 -\nsurface -80 3 air -\n"
                                     "stop - 5 air 8\nsurface -300 40 1.3 -\n";
    static const char *const second = "wavelength d\nfield angle 0 5,9\naperture epd 8\n"
                                      "focus table\nsurface - 2 air -\nsurface 50 6 1.6/55 -\n"
                                      "surface -80 3 air -\nstop - 5 air 8\n"
                                      "surface -300 40 1.3 -\n";
    static struct looked one, two;
    const double same[] = {1};
    for (int form = 0; form < IRREGULARITY_FORMS; form++) {
        struct irregularity of = {0, (enum irregularity_form)form, 6};
        struct look look = {
            .text = first, .irregularities = &of, .irregularity_count = 1, .kind = OPERAND_SPOT};
        look_at(&look, &one);
        of.surface = 1;
        look.text = second;
        look_at(&look, &two);
        compare(&one, 0, &two, same, "the first surface");
    }
}

/*
 * Rays that are moved by amounts: residuals change as the columns say, to first order. Differences
 * of both signs have what is of second order in neither.
 */
static void check_amounts(void)
{
    static const enum operand_kind all[] = {OPERAND_SPOT, OPERAND_OPD, OPERAND_POLY};
    const struct irregularity of[] = {
        {1, IRREGULARITY_COS, 6}, {2, IRREGULARITY_SIN, 5}, {5, IRREGULARITY_SPHERICAL, 6}};
    static struct looked columns, moved[2];
    const double one[] = {1};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        struct look look = {.text = LENS("surface -80 3 air - k=0.5 A4=2e-6"),
                            .irregularities = of,
                            .irregularity_count = 3,
                            .kind = all[k]};
        look_at(&look, &columns);
        const double size = 1e-5;
        for (int i = 0; i < 3; i++) {
            double amounts[3] = {0, 0, 0};
            look.amounts = amounts;
            for (int side = 0; side < 2; side++) {
                amounts[i] = side == 0 ? size : -size;
                look_at(&look, &moved[side]);
            }
            for (size_t r = 0; r < columns.rows; r++) {
                moved[0].jacobian[r] = (moved[0].residuals[r] - moved[1].residuals[r]) / (2 * size);
                moved[1].jacobian[r] = columns.jacobian[3 * r + (size_t)i];
            }
            moved[0].columns = moved[1].columns = 1;
            compare_within(&moved[0], 0, &moved[1], one, 1e-7, "moved by amounts");
        }
    }
}

/* Each form spans 1 from valley to peak in its disc, by a map; and has the slopes that it says. */
static void check_span(void)
{
    enum { STEPS = 200 };
    const double R = 7;
    for (int form = 0; form < IRREGULARITY_FORMS; form++) {
        const struct irregularity of = {0, (enum irregularity_form)form, R};
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i <= STEPS; i++) {
            for (int k = 0; k < 4 * STEPS; k++) {
                const double r = R * i / STEPS, t = 3.14159265358979 * k / (2 * STEPS);
                const double z = irregularity_height(&of, r * cos(t), r * sin(t)).z;
                low = fmin(low, z);
                high = fmax(high, z);
            }
        }
        CHECK_NEAR(high - low, 1, 1e-4, "from valley to peak");
        const double x = 1.3, y = -2.1, h = 1e-4;
        const struct irregularity_height at = irregularity_height(&of, x, y);
        CHECK_NEAR((irregularity_height(&of, x + h, y).z - irregularity_height(&of, x - h, y).z) /
                       (2 * h),
                   at.slope[0], 1e-9, "slope in x");
        CHECK_NEAR((irregularity_height(&of, x, y + h).z - irregularity_height(&of, x, y - h).z) /
                       (2 * h),
                   at.slope[1], 1e-9, "slope in y");
    }
}

/* A plane between n and air, met at right angles: the path gains (n - 1) dz. */
static void check_path(void)
{
    static const char *const ideal = "wavelength d\naperture epd 8\nfocus table\n"
                                     "stop - 4 1.5 -\nsurface - 0 air -\n"
                                     "surface 30 90 1.5 - k=-0.44444444444444444\n";
    const struct irregularity of = {1, IRREGULARITY_SPHERICAL, 4};
    static struct looked wave;
    const struct look look = {
        .text = ideal, .irregularities = &of, .irregularity_count = 1, .kind = OPERAND_OPD};
    look_at(&look, &wave);
    /* RMS over the disc of 6 r^4 - 6 r^2 + 1 is 1/sqrt(5), and its mean 0 */
    double sum = 0;
    for (size_t i = 0; i < wave.rows; i++) {
        sum += wave.jacobian[i] * wave.jacobian[i];
    }
    CHECK_NEAR(sqrt(sum) * 587.5618e-6, (1.5 - 1) / 1.5 / sqrt(5), 1e-7, "path");
}

int main(void)
{
    check_span();
    check_path();
    check_first();
    check_spherical();
    check_mirror();
    check_moved();
    check_astigmatism();
    check_amounts();
    return check_report();
}
