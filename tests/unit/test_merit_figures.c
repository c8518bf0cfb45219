/* tests/unit/test_merit_figures.c - figures of lenses by what varies, against 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "merit_check.h"
#include "merit_truth.h"

/*
 * Each figure is written out here from its definition, and its derivative is a difference in 113
 * bits: of lenses by chance, far and near, and of mirrors.
 */
enum { SIDES = 4, WAVES = 3, MOST_FIELDS = 2, PUPILS = 3 };

/* The largest angle of incidence is of one ray at one surface. */
struct choice {
    size_t field, pupil, surface;
    bool is_made;
};

/* One residual of one lens. */
struct look {
    struct merit_bench *bench;
    const struct merit_slot *slot;
    const struct lens *lens;
    struct system primary;
    struct truth_first first;
    size_t at;
    struct choice choice;
};

static bool open_look(struct look *look, const double *v)
{
    const size_t position = look->bench->merit.places[look->slot->place].position;
    struct system_options options = system_options_default();
    struct error error;
    options.stop_radius = 1;
    look->lens = variables_put(&look->bench->variables, v, position);
    const bool done = system_compile(look->lens, lens_primary_wavelength(look->lens), &options,
                                     look->bench->arena, &look->primary, &error);
    CHECK(done);
    look->first = truth_first_of(&look->primary, NAN);
    return done;
}

/* The lens at a wavelength; NaN: the primary one. */
static struct system system_at(const struct look *look, double wavelength)
{
    struct system system = look->primary;
    struct system_options options = system_options_default();
    struct error error;
    options.stop_radius = 1;
    CHECK(isnan(wavelength) ||
          system_compile(look->lens, wavelength, &options, look->bench->arena, &system, &error));
    return system;
}

static const struct field_point *field_of(const struct look *look)
{
    return look->slot->operand->field != NULL
               ? &look->slot->operand->field->point
               : &look->bench->merit.places[look->slot->place].setup.edge;
}

/* Index behind the last surface, below 0 after an odd number of mirrors. */
static real last_index(const struct system *system)
{
    real n = precise_of(system->n[system->lens->surface_count]);
    for (size_t i = 0; i < system->lens->surface_count; i++) {
        n = surface_reflects(&system->lens->surfaces[i]) ? -n : n;
    }
    return n;
}

/* -------- paraxial -------- */

/* The image: of a far object the rear focal point. */
static real image_of(const struct system *system)
{
    struct truth_rays whole, front = {{0}, {0}};
    truth_paraxial(system, &whole, &front);
    const real n = precise_of(system->n[0]);
    const real reach =
        system->lens->object_is_infinite ? 0 : precise_of(system->lens->object.value) / n;
    const real y = system->lens->object_is_infinite ? whole.y[0] : whole.y[0] * reach + whole.y[1];
    const real v = system->lens->object_is_infinite ? whole.v[0] : whole.v[0] * reach + whole.v[1];
    return -last_index(system) * y / v;
}

/* Sum of (n' - n) c/(n n'): 1/R of Petzval's surface, times -1 in air. */
static real petzval_of(const struct system *system)
{
    const struct lens *lens = system->lens;
    real n = precise_of(system->n[0]), sum = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct precise_shape shape = precise_shape_of(&lens->surfaces[i]);
        const real size = precise_of(system->n[i + 1]);
        const real after = surface_reflects(&lens->surfaces[i]) ? -n : n < 0 ? -size : size;
        sum += (after - n) * (shape.c + 2 * shape.coefficient[0]) / (n * after);
        n = after;
    }
    return -sum;
}

/* Marginal and chief ray before the first surface: y and n u. */
struct basic {
    real y, v, chief_y, chief_v;
};

static struct basic basic_of(const struct look *look, const struct system *system)
{
    struct truth_rays whole, front = {{0}, {0}};
    const struct lens *lens = system->lens;
    const struct field_point *field = field_of(look);
    const real n = precise_of(system->n[0]), value = (real)field->value[1];
    struct basic basic;
    real cosine, sine;
    truth_paraxial(system, &whole, &front);
    if (lens->object_is_infinite) {
        precise_turn(value, &cosine, &sine);
        basic.chief_v = n * sine / cosine;
        basic.chief_y = -basic.chief_v * front.y[1] / front.y[0];
        basic.y = look->first.stop / front.y[0];
        basic.v = 0;
        return basic;
    }
    const real d = precise_of(lens->object.value), there = front.y[0] * d + front.y[1] * n;
    const real u = look->first.stop / there, slope = -front.y[0] * value / there;
    basic.y = u * d;
    basic.v = n * u;
    basic.chief_y = value + slope * d;
    basic.chief_v = n * slope;
    return basic;
}

/* [Welford86], the Seidel sums as optics/seidel.h has them. */
static real seidel_of(const struct look *look, const struct system *system, int which)
{
    const struct lens *lens = system->lens;
    struct basic ray = basic_of(look, system);
    real n = precise_of(system->n[0]), sums[5] = {0};
    const real H = ray.y * ray.chief_v - ray.chief_y * ray.v;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const struct precise_shape shape = precise_shape_of(surface);
        const real size = precise_of(system->n[i + 1]), c0 = shape.c;
        const real after = surface_reflects(surface) ? -n : n < 0 ? -size : size;
        const real c = c0 + 2 * shape.coefficient[0];
        const real A = ray.v + n * ray.y * c, B = ray.chief_v + n * ray.chief_y * c;
        const real v = ray.v - ray.y * (after - n) * c;
        const real chief_v = ray.chief_v - ray.chief_y * (after - n) * c;
        const real bend = v / (after * after) - ray.v / (n * n), y = ray.y, z = ray.chief_y;
        const real G = (shape.K * c0 * c0 * c0 - c * c * c) / 8 + shape.coefficient[1];
        const real E = 8 * G * (after - n);
        const real by_n = 1 / after - 1 / n, by_n2 = 1 / (after * after) - 1 / (n * n);
        sums[0] += -A * A * y * bend + E * y * y * y * y;
        sums[1] += -A * B * y * bend + E * y * y * y * z;
        sums[2] += -B * B * y * bend + E * y * y * z * z;
        sums[3] += -H * H * c * by_n;
        sums[4] +=
            -B * B * B * y * by_n2 + B * z * c * by_n * (2 * y * B - z * A) + E * y * z * z * z;
        const real way =
            i + 1 < lens->surface_count ? precise_of(surface->thickness.value) / after : 0;
        ray = (struct basic){y + v * way, v, z + chief_v * way, chief_v};
        n = after;
    }
    return sums[which];
}

/* What goes on along its tangent beyond half and twice the target. */
static real continued(real target, real power)
{
    const real x = target * power, half = (real)1 / 2;
    return x < half ? 2 * target - 4 * target * (x - half)
           : x > 2  ? target / 2 - target / 4 * (x - 2)
                    : 1 / power;
}

/* -------- real rays -------- */

static struct truth_question question_of(const struct look *look, const struct system *system,
                                         const struct field_point *field, double pupil)
{
    struct look at = *look;
    struct operand operand = *look->slot->operand;
    struct setup_field here = {*field, 1};
    struct merit_slot slot = *look->slot;
    operand.field = &here;
    slot.operand = &operand;
    at.slot = &slot;
    const struct basic basic = basic_of(&at, system);
    return (struct truth_question){.system = system,
                                   .first = &look->first,
                                   .field = field,
                                   .y = (real)pupil,
                                   .begin = {0, basic.chief_y + (real)pupil * basic.y}};
}

static real height_of(const struct look *look, double wavelength)
{
    const struct system system = system_at(look, wavelength);
    const struct truth_question question = question_of(look, &system, field_of(look), 0);
    struct precise_ray end;
    CHECK(truth_end(&question, &end));
    return end.x[1];
}

static real distortion_of(const struct look *look)
{
    const real value = (real)field_of(look)->value[1];
    real cosine, sine, ideal = value * look->first.magnification;
    if (look->lens->object_is_infinite) {
        precise_turn(value, &cosine, &sine);
        ideal = precise_of(look->primary.n[0]) * last_index(&look->primary) / look->first.power *
                sine / cosine;
    }
    return 100 * (height_of(look, look->slot->operand->wavelength) - ideal) / ideal;
}

/* The angle whose tangent changes from T: as far as its derivative is concerned. */
static real angle_of(real tangent)
{
    const real nominal = (real)(double)tangent;
    /* atan by Newton's method on the sine and the cosine */
    real angle = (real)atan((double)nominal), cosine, sine;
    for (int i = 0; i < 4; i++) {
        precise_turn(angle, &cosine, &sine);
        angle += (tangent * cosine - sine) / (cosine + tangent * sine);
    }
    return angle;
}

static real telecentric_of(const struct look *look)
{
    const struct system system = system_at(look, look->slot->operand->wavelength);
    const struct truth_question question = question_of(look, &system, field_of(look), 0);
    struct precise_ray end;
    CHECK(truth_end(&question, &end));
    return angle_of(end.p[1] / end.p[2]);
}

/* Of one ray at one surface: sin i = |p x p'|/(n |p' - p|). */
static real incidence_at(const struct look *look, const struct choice *choice)
{
    static const double pupils[PUPILS] = {0, 1, -1};
    const struct merit_place *place = &look->bench->merit.places[look->slot->place];
    const struct system system = system_at(look, look->slot->operand->wavelength);
    const struct truth_question question = question_of(
        look, &system, &place->setup.fields[choice->field].point, pupils[choice->pupil]);
    struct precise_ray ray, before;
    CHECK(truth_start_of(&question, &ray));
    before = ray;
    for (size_t i = 0; i <= choice->surface; i++) {
        before = ray;
        CHECK(precise_surface(&ray, &system, i));
    }
    real along = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const real part = before.p[a] * ray.p[b] - before.p[b] * ray.p[a];
        square += part * part;
        along += (ray.p[k] - before.p[k]) * before.p[k];
    }
    return angle_of(precise_root(square) / truth_size(along));
}

/* Of all rays at a surface, of those that bend light; the same ray from then on. */
static real incidence_of(struct look *look)
{
    const struct merit_place *place = &look->bench->merit.places[look->slot->place];
    struct choice here = {.surface = 0};
    real largest = -1;
    for (size_t bending = 0; !look->choice.is_made; here.surface++) {
        bending += look->lens->surfaces[here.surface].kind != SURFACE_STOP;
        if (bending == look->at + 1) {
            break;
        }
    }
    for (size_t n = 0; n < place->setup.field_count * PUPILS && !look->choice.is_made; n++) {
        here.field = n / PUPILS;
        here.pupil = n % PUPILS;
        const real angle = incidence_at(look, &here);
        if (angle > largest) {
            look->choice = here;
            largest = angle;
        }
    }
    look->choice.is_made = true;
    return incidence_at(look, &look->choice);
}

/* -------- thicknesses -------- */

static real sag_of(const struct surface *surface, real r)
{
    const struct precise_shape shape = precise_shape_of(surface);
    const real q = r * r;
    real sag = shape.c * q / (1 + precise_root(1 - shape.K * shape.c * shape.c * q)), power = 1;
    for (int i = 0; i < LENS_EVEN; i++) {
        power *= q;
        sag += shape.coefficient[i] * power;
    }
    return sag;
}

/* Of lenses whose surfaces all are 40 mm wide, and whose stop stands in air. */
static real shape_of(const struct look *look)
{
    const enum operand_kind kind = look->slot->operand->kind;
    const struct lens *lens = look->lens;
    size_t found = 0;
    for (size_t i = 0; i + 1 < lens->surface_count; i++) {
        const struct surface *left = &lens->surfaces[i], *right = left + 1;
        real gap = precise_of(left->thickness.value);
        if (left->kind == SURFACE_STOP || medium_is_air(&left->medium) != (kind == OPERAND_AIR)) {
            continue;
        }
        if (right->kind == SURFACE_STOP) {
            gap += precise_of(right->thickness.value);
            right++;
        }
        const real edge = gap + sag_of(right, 20) - sag_of(left, 20);
        if (kind == OPERAND_AIR && found++ == look->at) {
            return gap;
        }
        if (found++ == look->at) {
            return kind == OPERAND_CENTER ? gap : edge;
        }
    }
    return 0;
}

/* -------- all of them -------- */

static real length_of(const struct lens *lens)
{
    real sum = 0;
    for (size_t i = 0; i + 1 < lens->surface_count; i++) {
        sum += precise_of(lens->surfaces[i].thickness.value);
    }
    return sum;
}

/* What has two colours: the shortest less the longest of F d C. */
static const double blue = 0.4861327, red = 0.6562725;

static real first_of(const struct look *look, const struct system *system)
{
    const struct operand *operand = look->slot->operand;
    struct truth_rays whole, front = {{0}, {0}};
    truth_paraxial(system, &whole, &front);
    const real n = precise_of(system->n[0]), power = -whole.v[0];
    switch (operand->kind) {
    case OPERAND_EFL:
        return continued((real)operand->target, power);
    case OPERAND_PETZVAL:
        return continued((real)operand->target, petzval_of(system));
    case OPERAND_BFL:
        return last_index(system) * whole.y[0] / power;
    case OPERAND_FFL:
        return -n * whole.v[1] / power;
    case OPERAND_FNUMBER:
        return truth_size(1 / power) / (2 * look->first.radius);
    default:
        return 1 / (whole.v[0] * precise_of(system->lens->object.value) / n + whole.v[1]);
    }
}

static real figure_of(struct look *look)
{
    const struct operand *operand = look->slot->operand;
    const struct system system = system_at(look, operand->wavelength);
    switch (operand->kind) {
    case OPERAND_LENGTH:
        return length_of(look->lens);
    case OPERAND_AXIAL: {
        const struct system short_one = system_at(look, blue), long_one = system_at(look, red);
        return image_of(&short_one) - image_of(&long_one);
    }
    case OPERAND_S1:
    case OPERAND_S2:
    case OPERAND_S3:
    case OPERAND_S4:
    case OPERAND_S5:
        return seidel_of(look, &system, (int)(operand->kind - OPERAND_S1));
    case OPERAND_HEIGHT:
        return height_of(look, operand->wavelength);
    case OPERAND_DISTORTION:
        return distortion_of(look);
    case OPERAND_LATERAL:
        return height_of(look, blue) - height_of(look, red);
    case OPERAND_TELECENTRIC:
        return telecentric_of(look);
    case OPERAND_INCIDENCE:
        return incidence_of(look);
    case OPERAND_EDGE:
    case OPERAND_CENTER:
    case OPERAND_AIR:
        return shape_of(look);
    default:
        return first_of(look, &system);
    }
}

/* Differences whose error is of fourth order. */
static real slope_of(struct look *look, size_t variable)
{
    static const int steps[SIDES] = {-2, -1, 1, 2}, factors[SIDES] = {1, -8, 8, -1};
    const struct merit_bench *bench = look->bench;
    const double h = ldexp(1, ilogb(bench->variables.scale[variable]) - 13);
    real sum = 0;
    for (int k = 0; k < SIDES; k++) {
        double moved[MERIT_MOST];
        memcpy(moved, bench->v, sizeof moved);
        moved[variable] += steps[k] * h;
        if (open_look(look, moved)) {
            sum += factors[k] * figure_of(look) / (12 * (real)h);
        }
    }
    return sum;
}

/* One residual: its value, and its derivatives. */
static double check_one(struct look *look, double value, const double *row)
{
    const struct merit_bench *bench = look->bench;
    const struct operand *operand = look->slot->operand;
    double worst = 0;
    CHECK(open_look(look, bench->v));
    const double nominal = (double)figure_of(look);
    CHECK_NEAR(value, nominal, 1e-10 * fmax(1, fabs(nominal)), operand->name);
    for (size_t j = 0; j < bench->count; j++) {
        const double slope = (double)slope_of(look, j), mine = row[j] * operand->deviation;
        const double scale =
            fmax(fabs(slope), 1e-3 * fmax(1, fabs(nominal)) / bench->variables.scale[j]);
        const double off = fabs(mine - slope) / scale;
        worst = fmax(worst, off);
        CHECK(off <= 1e-9);
        if (!(off <= 1e-9)) {
            printf("    %s by %s: %.15g, expected %.15g\n", operand->name, bench->list[j].name,
                   mine, slope);
        }
    }
    return worst;
}

static double check_case(const struct merit_case *of)
{
    struct arena arena = {0};
    struct error error = {0};
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double worst = 0;
    bool done = merit_bench_open(bench, of, &arena, &error);
    CHECK(done);
    if (done) {
        const struct merit *merit = &bench->merit;
        double *residuals = ARENA_ARRAY(&arena, merit->residual_count, double);
        double *jacobian = ARENA_ARRAY(&arena, merit->residual_count * bench->count, double);
        done = merit_evaluate(&bench->merit, bench->v, residuals, jacobian);
        CHECK(done);
        for (size_t s = 0; s < merit->slot_count && done; s++) {
            const struct merit_slot *slot = &merit->slots[s];
            for (size_t i = 0; i < slot->count; i++) {
                struct look look = {.bench = bench, .slot = slot, .at = i};
                const size_t row = slot->first + i;
                const double value =
                    residuals[row] * slot->operand->deviation + slot->operand->target;
                worst = fmax(worst, check_one(&look, value, jacobian + row * bench->count));
            }
        }
    }
    printf("%s%s", error.message, bench->merit.why.message);
    arena_free(&arena);
    return worst;
}

static const char all[] = "efl=80,efl@F=80,petzval=-150,bfl=70,ffl=-50,length=20,fnumber=5,axial,"
                          "S1,S2,S3,S4,S5,S1@F,S3@C,distortion,lateral,telecentric=1,telecentric@F,"
                          "edge=1,center=1,air=1,incidence=1,incidence@F=2";
static const char far[] = ",height@4deg=1,height@2deg@F=1";
static const char near[] = ",height@6mm=1,height@3mm@F=1,magnification=-1,magnification@C=-1";

static const char zoom[] = "wavelength d F C\nobject inf\naperture f/5\nfield angle 0 6\n"
                           "focus table\nposition wide tele\nlet gap 20 6\n"
                           "surface 60 4 1.6/50 30\nsurface -900 gap air 30\nstop - 2 air 20\n"
                           "surface -70 2 1.7/35 -\nsurface 90 12 air -\n"
                           "surface 50 5 1.62/60 30\nsurface -40 50 air 30\n";

static const char mirrors[] = "wavelength d F\nobject inf\naperture f/12\n"
                              "field angle 0 0.5\nfocus paraxial\n"
                              "stop - 5 air 20\n"
                              "surface -160 -50 mirror - k=-1\n"
                              "surface -100 60 mirror - k=-2 A4=1e-7\n"
                              "surface 90 3 1.52/64 -\n"
                              "surface 400 10 air -\n";

int main(void)
{
    if (sizeof(real) == sizeof(double)) {
        printf("figures: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    double worst = 0;
    size_t near_ones = 0;
    for (unsigned long long seed = 2; seed <= 4; seed++) {
        char text[MERIT_TEXT], names[MERIT_TEXT], goals[MERIT_TEXT];
        merit_random(seed, seed == 4, text, names);
        const bool is_near = strstr(text, "inf") == NULL;
        snprintf(goals, sizeof goals, "%s%s", all, is_near ? near : far);
        const struct merit_case of = {"by chance", text, names, goals, 0};
        near_ones += is_near;
        worst = fmax(worst, check_case(&of));
    }
    CHECK(near_ones > 0 && near_ones < 3);
    static const struct merit_case zooming = {
        "zoom", zoom, "R1 c2 t1 t3 n1 V4 c6",
        "efl=80,bfl@tele=60,axial,S1,S3@tele,lateral@wide,height@2deg=1,distortion,telecentric=1",
        0};
    worst = fmax(worst, check_case(&zooming));
    static const struct merit_case mirrored = {
        "mirrors", mirrors, "R2 k2 t2 c3 k3 t3 A4_3 n4 V4 R5 t5",
        "efl=500,bfl=60,fnumber=10,petzval=-200,length=20,S1,S2,S3,S4,S5,S5@F,height@0.4deg=1,"
        "distortion,telecentric,incidence=1",
        0};
    worst = fmax(worst, check_case(&mirrored));
    printf("worst error %.2g of scale\n", worst);
    return check_report();
}
