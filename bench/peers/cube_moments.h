/* What the rigid and the soft cube share: rules, moments of the gap over the faces, loads, counters; see cube.h.
 *
 * d and w are affine in X, so that force and moment follow from the moments of d^-6 (order 1) and of d^-3 (order 2);
 * per point this takes fourteen sums in place of the thirty of traction, force and moment one by one, and the loops
 * over points vectorise. This is the fastest form known to the writer: the rival is to be a strong one. Included by
 * `cube.c` and `cube_affine.c`, so that all of a right-hand side is compiled as one.
 */
#ifndef CUBE_MOMENTS_H
#define CUBE_MOMENTS_H

#include "cube.h"

#include <math.h>
#include <time.h>

#define ALPHA 7.29e-10 /* 0.03^6 */
#define BETA_NORMAL 5e-5
#define BETA_TANGENT 5e-5
#define GRAVITY 1.0
#define MOST 48

const char *const cube_rule_names[CUBE_RULES] = {"gauss-8", "graded-16", "gauss-48"};

/* Sums of d^-6 and d^-3 times 1, X; of d^-3 times X X (six). */
struct moments {
    double a[4], b[4], bb[6];
};

static int rule, count;
static double node[MOST], weight[MOST]; /* Gauss on [0, 1] */
static long calls = 0;

/* Gauss-Legendre nodes on [0, 1] by Newton's method on Legendre's recurrence. */
static void gauss(int n) {
    for (int i = 0; i < n; i++) {
        double x = cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1.0;
        for (int k = 0; k < 100; k++) {
            double p = 1.0, before = 0.0;
            for (int j = 0; j < n; j++) {
                double next = ((2 * j + 1) * x * p - j * before) / (j + 1);
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            double change = p / slope;
            x -= change;
            if (fabs(change) < 1e-16) break;
        }
        node[i] = 0.5 * (1.0 - x);
        weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
}

void cube_choose(int chosen) {
    static const int counts[CUBE_RULES] = {8, 16, 48};
    rule = chosen;
    count = counts[chosen];
    gauss(count);
}

/* Points s in [0, 1] and weights of an edge along which the gap grows from d by rise >= 0, uniform in log(d + rise s). */
static void grade(double d, double rise, double *s, double *w) {
    double span = log1p(rise / d);
    double whole = span > 1e-6 ? expm1(span) : 1.0;
    for (int i = 0; i < count; i++) {
        if (span > 1e-6) {
            double e = exp(node[i] * span);
            s[i] = (e - 1.0) / whole;
            w[i] = weight[i] * span * e / whole;
        } else {
            s[i] = node[i];
            w[i] = weight[i];
        }
    }
}

/* Sums over the points (s_i, t_j) of a face, with weights w_i v_j: of d^-6 {1, s, t} and d^-3 {1, s, t, ss, st, tt}.
 *
 * Eight t at a time are carried through all s, so that the inner loop is a few vector instructions; n is a constant in
 * each of the three copies that the compiler makes.
 */
static inline __attribute__((always_inline)) void sum_points(int n, double d, double du, double dv, const double *s,
                                                             const double *w, const double *t, const double *v,
                                                             double *sums) {
    for (int first = 0; first < n; first += 8) {
        double a0[8] = {0}, a1[8] = {0}, b0[8] = {0}, b1[8] = {0}, b2[8] = {0}, gap[8];
        for (int j = 0; j < 8; j++) gap[j] = d + t[first + j] * dv;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < 8; j++) {
                double r = 1.0 / (gap[j] + s[i] * du), cube = r * r * r;
                double b = w[i] * cube, a = b * cube, bs = b * s[i];
                a0[j] += a;
                a1[j] += a * s[i];
                b0[j] += b;
                b1[j] += bs;
                b2[j] += bs * s[i];
            }
        for (int j = 0; j < 8; j++) {
            double tj = t[first + j], vj = v[first + j];
            sums[0] += vj * a0[j];
            sums[1] += vj * a1[j];
            sums[2] += vj * tj * a0[j];
            sums[3] += vj * b0[j];
            sums[4] += vj * b1[j];
            sums[5] += vj * tj * b0[j];
            sums[6] += vj * b2[j];
            sums[7] += vj * tj * b1[j];
            sums[8] += vj * tj * tj * b0[j];
        }
    }
}

/* Adds one face of this area: X = x + s u + t v, whose gap is d + s du + t dv. */
static void add_face(struct moments *m, double area, const double *x, const double *u, const double *v, double d,
                     double du, double dv) {
    double s[MOST], ws[MOST], t[MOST], wt[MOST], p[9] = {0};
    switch (rule) {
    case CUBE_GAUSS_8:
        sum_points(8, d, du, dv, node, weight, node, weight, p);
        break;
    case CUBE_GRADED_16:
        grade(d, du, s, ws);
        grade(d, dv, t, wt);
        sum_points(16, d, du, dv, s, ws, t, wt, p);
        break;
    default:
        sum_points(48, d, du, dv, node, weight, node, weight, p);
    }
    for (int i = 0; i < 9; i++) p[i] *= area;
    m->a[0] += p[0];
    m->b[0] += p[3];
    for (int i = 0; i < 3; i++) {
        m->a[1 + i] += p[0] * x[i] + p[1] * u[i] + p[2] * v[i];
        m->b[1 + i] += p[3] * x[i] + p[4] * u[i] + p[5] * v[i];
    }
    for (int i = 0, k = 0; i < 3; i++)
        for (int j = i; j < 3; j++, k++)
            m->bb[k] += p[3] * x[i] * x[j] + p[4] * (x[i] * u[j] + u[i] * x[j]) + p[5] * (x[i] * v[j] + v[i] * x[j]) +
                        p[6] * u[i] * u[j] + p[7] * (u[i] * v[j] + v[i] * u[j]) + p[8] * v[i] * v[j];
}

/* All six faces for the gap g + n.X, of the areas of the three axes; the lowest corner of each comes first. */
static int integrate(struct moments *m, double g, const double *n, const double *area) {
    *m = (struct moments){0};
    /* A plain rule knows nothing of the corners: its cube sinks until a point meets the plane. */
    double first = rule == CUBE_GRADED_16 ? 0.0 : node[0];
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2) {
            int b = (axis + 1) % 3, c = (axis + 2) % 3;
            double corner[3], u[3] = {0}, v[3] = {0};
            corner[axis] = 0.5 * side;
            corner[b] = n[b] > 0 ? -0.5 : 0.5;
            corner[c] = n[c] > 0 ? -0.5 : 0.5;
            u[b] = n[b] > 0 ? 1.0 : -1.0;
            v[c] = n[c] > 0 ? 1.0 : -1.0;
            double d = g + n[0] * corner[0] + n[1] * corner[1] + n[2] * corner[2];
            if (d + first * (fabs(n[b]) + fabs(n[c])) <= 0.0) return 1;
            add_face(m, area[axis], corner, u, v, d, fabs(n[b]), fabs(n[c]));
        }
    return 0;
}

/* Force f and moment M_iA of the tractions, for the velocity w = y[7..10] + l X. */
static void loads(const struct moments *m, const double *velocity, double l[3][3], double *f, double moment[3][3]) {
    static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    for (int i = 0; i < 3; i++) {
        double beta = i == 2 ? BETA_NORMAL : BETA_TANGENT, repulsion = i == 2 ? ALPHA : 0.0;
        double sum = velocity[i] * m->b[0];
        for (int j = 0; j < 3; j++) sum += l[i][j] * m->b[1 + j];
        f[i] = repulsion * m->a[0] - beta * sum;
        for (int a = 0; a < 3; a++) {
            double first = velocity[i] * m->b[1 + a];
            for (int j = 0; j < 3; j++) first += l[i][j] * m->bb[at[j][a]];
            moment[i][a] = repulsion * m->a[1 + a] - beta * first;
        }
    }
}

int cube_dimension(void) { return CUBE_DIMENSION; }

long cube_calls(void) {
    long now = calls;
    calls = 0;
    return now;
}

double cube_seconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

#endif
