/* tests/ceres/test_thick_sums.c - rays added up and forgotten fit as all of them in 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "subject.h"

/* A check that prints figures when it fails. */
#define CHECK_TRUE(condition, ...)                                                                 \
    do {                                                                                           \
        bool good = (condition);                                                                   \
        check_at(good, __FILE__, __LINE__, #condition);                                            \
        if (!good) {                                                                               \
            printf(__VA_ARGS__);                                                                   \
            putchar('\n');                                                                         \
        }                                                                                          \
    } while (0)

__extension__ typedef __float128 quad;

enum { BASE_PARAMETERS = 3, MOST = 6, FIELDS = 9 };

/* A square root to 113 bits, by Newton's steps from 53. */
static quad root(quad x)
{
    quad r = sqrt((double)x);
    return r > 0 ? ((r + x / r) / 2 + x / ((r + x / r) / 2)) / 2 : 0;
}

/* Errors of ray i in x and y, in a plane: the definition of thick_lens_map, written anew. */
static void errors(const struct thick_rays *rays, size_t i, const quad *parameter, double plane,
                   quad *to)
{
    const quad in[2] = {rays->x[i], rays->y[i]}, slope[2] = {rays->p[i], rays->q[i]};
    const quad out[2] = {rays->x_out[i], rays->y_out[i]};
    const quad behind[2] = {rays->p_out[i], rays->q_out[i]};
    quad s = slope[0] * slope[0] + slope[1] * slope[1];
    quad d = s * (parameter[3] + s * (parameter[4] + s * parameter[5]));
    for (int k = 0; k < 2; k++) {
        quad h = in[k] + parameter[1] * slope[k], u = slope[k] * (1 + d) - h / parameter[0];
        to[k] = h + ((quad)plane - parameter[2]) * u - out[k] - (quad)plane * behind[k];
    }
}

/* All rays of a subject at one wavelength, residual by residual: what is to be minimised. */
struct whole {
    const struct thick_task *task;
    const struct thick_rays *rays;
    quad blur;
    quad *residuals; /* 4 a ray */
};

static void residuals(const struct whole *whole, const quad *parameter)
{
    const struct thick_rays *rays = whole->rays;
    quad means[FIELDS][2] = {{0}}, weights[FIELDS] = {0};
    for (size_t i = 0; i < rays->count; i++) {
        quad *e = whole->residuals + 4 * i, w = rays->weight[i];
        errors(rays, i, parameter, whole->task->planes[0], e);
        errors(rays, i, parameter, whole->task->planes[1], e + 2);
        weights[rays->field[i]] += w;
        means[rays->field[i]][0] += w * e[0];
        means[rays->field[i]][1] += w * e[1];
    }
    for (size_t i = 0; i < rays->count; i++) {
        size_t f = rays->field[i];
        quad *e = whole->residuals + 4 * i, w = root(rays->weight[i]);
        for (int k = 0; k < 2; k++) {
            quad mean = means[f][k] / weights[f];
            e[k] = w * (whole->blur * (e[k] - mean) + mean);
            e[2 + k] *= w * (quad)whole->task->plane_weights[1];
        }
    }
}

/* Rms slope against the mean of the field, as F wants it. */
static quad cone(const struct thick_rays *rays)
{
    quad means[FIELDS][2] = {{0}}, weights[FIELDS] = {0}, sum = 0, all = 0;
    for (size_t i = 0; i < rays->count; i++) {
        weights[rays->field[i]] += rays->weight[i];
        means[rays->field[i]][0] += (quad)rays->weight[i] * rays->p_out[i];
        means[rays->field[i]][1] += (quad)rays->weight[i] * rays->q_out[i];
    }
    for (size_t i = 0; i < rays->count; i++) {
        size_t f = rays->field[i];
        quad p = rays->p_out[i] - means[f][0] / weights[f];
        quad q = rays->q_out[i] - means[f][1] / weights[f];
        sum += rays->weight[i] * (p * p + q * q);
        all += rays->weight[i];
    }
    return root(sum / all);
}

/* x of A x = b, with Gauss's steps. */
static void solve(quad a[MOST][MOST + 1], size_t n, quad *x)
{
    for (size_t k = 0; k < n; k++) {
        for (size_t i = k + 1; i < n; i++) {
            quad share = a[i][k] / a[k][k];
            for (size_t j = k; j <= n; j++) {
                a[i][j] -= share * a[k][j];
            }
        }
    }
    for (size_t k = n; k-- > 0;) {
        x[k] = a[k][n];
        for (size_t j = k + 1; j < n; j++) {
            x[k] -= a[k][j] * x[j];
        }
        x[k] /= a[k][k];
    }
}

/* One step of Gauss and Newton over all rays; derivatives by differences of 113 bits. */
static void step(struct whole *whole, size_t n, quad *parameter, struct arena *arena)
{
    size_t rows = 4 * whole->rays->count;
    quad *jacobian = arena_array(arena, n * rows, sizeof *jacobian);
    quad normal[MOST][MOST + 1] = {{0}}, change[MOST];
    for (size_t k = 0; k < n; k++) {
        quad at[MOST], h = 1e-12 * (1 + fabs((double)parameter[k]));
        memcpy(at, parameter, sizeof at);
        at[k] = parameter[k] + h;
        residuals(whole, at);
        memcpy(jacobian + k * rows, whole->residuals, rows * sizeof(quad));
        at[k] = parameter[k] - h;
        residuals(whole, at);
        for (size_t i = 0; i < rows; i++) {
            jacobian[k * rows + i] = (jacobian[k * rows + i] - whole->residuals[i]) / (2 * h);
        }
    }
    residuals(whole, parameter);
    for (size_t i = 0; i < n; i++) {
        for (size_t r = 0; r < rows; r++) {
            for (size_t j = 0; j < n; j++) {
                normal[i][j] += jacobian[i * rows + r] * jacobian[j * rows + r];
            }
            normal[i][n] -= jacobian[i * rows + r] * whole->residuals[r];
        }
    }
    solve(normal, n, change);
    for (size_t k = 0; k < n; k++) {
        parameter[k] += change[k];
    }
}

static quad rms(const struct whole *whole, const quad *parameter, double plane)
{
    quad sum = 0, all = 0;
    for (size_t i = 0; i < whole->rays->count; i++) {
        quad e[2];
        errors(whole->rays, i, parameter, plane, e);
        sum += whole->rays->weight[i] * (e[0] * e[0] + e[1] * e[1]);
        all += whole->rays->weight[i];
    }
    return root(sum / all);
}

/* The limits are what 53 bits leave of places that are known to 1e-14 mm. */
static void test_whole(const char *name, double fnumber, double field, size_t terms,
                       const double limits[3])
{
    struct arena arena = {0};
    struct subject subject;
    struct thick_fit fit;
    struct error error;
    const struct subject_rays wanted = {
        .aperture = {APERTURE_FNUMBER, fnumber}, .field = field, .field_count = FIELDS, .rays = 30};
    CHECK(subject_open(name, &wanted, &arena, &subject, &error));
    subject.task.distortions = terms;
    CHECK(thick_fit(&subject.task, &arena, &fit, &error));
    quad parameter[MOST] = {subject.first.efl, subject.first.front_principal,
                            subject.first.rear_principal};
    struct whole whole = {&subject.task, &subject.rays, THICK_FOCUS_WEIGHT / cone(&subject.rays),
                          arena_array(&arena, 4 * subject.rays.count, sizeof(quad))};
    for (int k = 0; k < 5; k++) {
        step(&whole, BASE_PARAMETERS + terms, parameter, &arena);
    }
    for (size_t k = 0; k < BASE_PARAMETERS + terms; k++) {
        double off = fabs(fit.parameters[k] / (double)parameter[k] - 1);
        CHECK_TRUE(off < limits[k < BASE_PARAMETERS ? 0 : 1],
                   "%s f/%g, %zu terms: %s is %.15g, not %.15g: %.2g", name, fnumber, terms,
                   fit.names[k], fit.parameters[k], (double)parameter[k], off);
    }
    double image = fabs(fit.rms / (double)rms(&whole, parameter, subject.task.planes[0]) - 1);
    double pupil =
        fabs(fit.rms_second / (double)rms(&whole, parameter, subject.task.planes[1]) - 1);
    CHECK_TRUE(image < limits[2] && pupil < limits[2], "%s f/%g, %zu terms: rms off by %.2g, %.2g",
               name, fnumber, terms, image, pupil);
    arena_free(&arena);
}

int main(void)
{
    /* what is stopped down is blurred by less than the rounding of places allows to be known */
    test_whole("double-gauss", 2.03, 0.24, 0, (const double[3]){1e-10, 0, 1e-10});
    test_whole("double-gauss", 2.03, 0.24, 3, (const double[3]){1e-9, 4e-7, 1e-9});
    test_whole("wide-35", 4, 0.6, 2, (const double[3]){1e-10, 1e-9, 1e-10});
    test_whole("double-gauss", 1000, 0.24, 3, (const double[3]){1e-9, 1e-5, 1e-9});
    test_whole("double-gauss", 100000, 0.24, 3, (const double[3]){1e-9, 1e-3, 2e-5});
    return check_report();
}
