/* base/kernel_fft.c - passes of a Fourier transform over lines side by side. */
/* SPDX-License-Identifier: MIT */
#include "base/fft.h"

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

/* What a pass goes over: parts are `apart` numbers from each other. */
struct pass {
    const struct fft_pass *of;
    size_t run; /* numbers that have the same twiddles */
    const double *re, *im;
    double *to_re, *to_im;
};

static void pass_2(const struct pass *pass)
{
    const size_t run = pass->run, apart = run * pass->of->length;
    for (size_t p = 0; p < pass->of->length; p++) {
        const double c = pass->of->cosine[p], s = pass->of->sine[p];
        const double *restrict ar = pass->re + run * p, *restrict ai = pass->im + run * p;
        const double *restrict br = ar + apart, *restrict bi = ai + apart;
        double *restrict yr = pass->to_re + 2 * run * p, *restrict yi = pass->to_im + 2 * run * p;
        double *restrict zr = yr + run, *restrict zi = yi + run;
        for (size_t q = 0; q < run; q++) {
            const double dr = ar[q] - br[q], di = ai[q] - bi[q];
            yr[q] = ar[q] + br[q];
            yi[q] = ai[q] + bi[q];
            zr[q] = dr * c - di * s;
            zi[q] = dr * s + di * c;
        }
    }
}

static void pass_3(const struct pass *pass)
{
    static const double root = 0.86602540378443864676; /* sin 120 deg */
    const size_t run = pass->run, apart = run * pass->of->length;
    for (size_t p = 0; p < pass->of->length; p++) {
        const double *w = pass->of->cosine + 2 * p, *v = pass->of->sine + 2 * p;
        const double c1 = w[0], c2 = w[1], s1 = v[0], s2 = v[1];
        const double *restrict xr = pass->re + run * p, *restrict xi = pass->im + run * p;
        double *restrict yr = pass->to_re + 3 * run * p, *restrict yi = pass->to_im + 3 * run * p;
        for (size_t q = 0; q < run; q++) {
            const double br = xr[q + apart], bi = xi[q + apart];
            const double cr = xr[q + 2 * apart], ci = xi[q + 2 * apart];
            const double tr = br + cr, ti = bi + ci;
            const double mr = xr[q] - 0.5 * tr, mi = xi[q] - 0.5 * ti;
            const double jr = root * (bi - ci), ji = -root * (br - cr); /* -i (b - c) */
            const double er = mr + jr, ei = mi + ji, fr = mr - jr, fi = mi - ji;
            yr[q] = xr[q] + tr;
            yi[q] = xi[q] + ti;
            yr[q + run] = er * c1 - ei * s1;
            yi[q + run] = er * s1 + ei * c1;
            yr[q + 2 * run] = fr * c2 - fi * s2;
            yi[q + 2 * run] = fr * s2 + fi * c2;
        }
    }
}

static void pass_4(const struct pass *pass)
{
    const size_t run = pass->run, apart = run * pass->of->length;
    for (size_t p = 0; p < pass->of->length; p++) {
        const double *w = pass->of->cosine + 3 * p, *v = pass->of->sine + 3 * p;
        const double c1 = w[0], c2 = w[1], c3 = w[2], s1 = v[0], s2 = v[1], s3 = v[2];
        const double *restrict xr = pass->re + run * p, *restrict xi = pass->im + run * p;
        double *restrict yr = pass->to_re + 4 * run * p, *restrict yi = pass->to_im + 4 * run * p;
        for (size_t q = 0; q < run; q++) {
            const double ar = xr[q], ai = xi[q], br = xr[q + apart], bi = xi[q + apart];
            const double cr = xr[q + 2 * apart], ci = xi[q + 2 * apart];
            const double dr = xr[q + 3 * apart], di = xi[q + 3 * apart];
            const double sr = ar + cr, si = ai + ci, tr = br + dr, ti = bi + di;
            const double mr = ar - cr, mi = ai - ci, jr = bi - di, ji = dr - br; /* -i (b - d) */
            const double er = mr + jr, ei = mi + ji, fr = sr - tr, fi = si - ti;
            const double gr = mr - jr, gi = mi - ji;
            yr[q] = sr + tr;
            yi[q] = si + ti;
            yr[q + run] = er * c1 - ei * s1;
            yi[q + run] = er * s1 + ei * c1;
            yr[q + 2 * run] = fr * c2 - fi * s2;
            yi[q + 2 * run] = fr * s2 + fi * c2;
            yr[q + 3 * run] = gr * c3 - gi * s3;
            yi[q + 3 * run] = gr * s3 + gi * c3;
        }
    }
}

static void pass_5(const struct pass *pass)
{
    static const double a1 = 0.30901699437494742410, a2 = -0.80901699437494742410;
    static const double b1 = 0.95105651629515357212, b2 = 0.58778525229247312917;
    const size_t run = pass->run, apart = run * pass->of->length;
    for (size_t p = 0; p < pass->of->length; p++) {
        const double *restrict w = pass->of->cosine + 4 * p, *restrict v = pass->of->sine + 4 * p;
        const double *restrict xr = pass->re + run * p, *restrict xi = pass->im + run * p;
        double *restrict yr = pass->to_re + 5 * run * p, *restrict yi = pass->to_im + 5 * run * p;
        for (size_t q = 0; q < run; q++) {
            const double br = xr[q + apart], bi = xi[q + apart];
            const double cr = xr[q + 2 * apart], ci = xi[q + 2 * apart];
            const double dr = xr[q + 3 * apart], di = xi[q + 3 * apart];
            const double er = xr[q + 4 * apart], ei = xi[q + 4 * apart];
            const double sr = br + er, si = bi + ei, tr = cr + dr, ti = ci + di;
            const double ur = br - er, ui = bi - ei, vr = cr - dr, vi = ci - di;
            const double m1r = xr[q] + a1 * sr + a2 * tr, m1i = xi[q] + a1 * si + a2 * ti;
            const double m2r = xr[q] + a2 * sr + a1 * tr, m2i = xi[q] + a2 * si + a1 * ti;
            /* -i times the odd parts */
            const double n1r = b1 * ui + b2 * vi, n1i = -(b1 * ur + b2 * vr);
            const double n2r = b2 * ui - b1 * vi, n2i = -(b2 * ur - b1 * vr);
            const double zr[] = {m1r + n1r, m2r + n2r, m2r - n2r, m1r - n1r};
            const double zi[] = {m1i + n1i, m2i + n2i, m2i - n2i, m1i - n1i};
            yr[q] = xr[q] + sr + tr;
            yi[q] = xi[q] + si + ti;
            for (size_t k = 0; k < 4; k++) {
                yr[q + (k + 1) * run] = zr[k] * w[k] - zi[k] * v[k];
                yi[q + (k + 1) * run] = zr[k] * v[k] + zi[k] * w[k];
            }
        }
    }
}

void NAMED(kernel_fft, KERNEL)(const struct fft *fft, double *re, double *im, double *spare_re,
                               double *spare_im)
{
    double *from_re = re, *from_im = im, *to_re = spare_re, *to_im = spare_im;
    size_t run = FFT_LANES;
    for (size_t i = 0; i < fft->count; i++) {
        const struct fft_pass *of = &fft->passes[i];
        const struct pass pass = {of, run, from_re, from_im, to_re, to_im};
        if (of->radix == 4) {
            pass_4(&pass);
        } else if (of->radix == 2) {
            pass_2(&pass);
        } else if (of->radix == 3) {
            pass_3(&pass);
        } else {
            pass_5(&pass);
        }
        run *= of->radix;
        double *const swap_re = from_re, *const swap_im = from_im;
        from_re = to_re, from_im = to_im;
        to_re = swap_re, to_im = swap_im;
    }
    const size_t count = from_re == re ? 0 : fft->length * FFT_LANES;
    for (size_t i = 0; i < count; i++) {
        re[i] = from_re[i];
        im[i] = from_im[i];
    }
}
