/* Rates of the cube: see cube.h.
 *
 * d and w are affine in X, so that force and moment follow from the moments of d^-6 (order 1) and of d^-3 (order 2);
 * per point this takes fourteen sums in place of the thirty of traction, force and moment one by one, and the loops
 * over points vectorise. This is the fastest form known to the writer: the rival is to be a strong one.
 */
#include "cube.h"

#include <math.h>
#include <time.h>

#define ALPHA 7.29e-10 /* 0.03^6 */
#define BETA_NORMAL 5e-5
#define BETA_TANGENT 5e-5
#define GRAVITY 1.0
#define INERTIA (1.0 / 6.0)
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

/* Adds one face: X = x + s u + t v, whose gap is d + s du + t dv. */
static void add_face(struct moments *m, const double *x, const double *u, const double *v, double d, double du,
                     double dv) {
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

/* All six faces for the gap g + n.X; the lowest corner of each comes first. */
static int integrate(struct moments *m, double g, const double *n) {
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
            add_face(m, corner, u, v, d, fabs(n[b]), fabs(n[c]));
        }
    return 0;
}

void cube_start(double *y) {
    const double axis[3] = {1.0, 0.7, 0.3}, spin[3] = {1.0, 0.5, 2.0};
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]), s = sin(0.25) / length;
    double q[4] = {cos(0.25), s * axis[0], s * axis[1], s * axis[2]};
    double start[7] = {0, 0, 2.0, q[0], q[1], q[2], q[3]};
    for (int i = 0; i < 7; i++) y[i] = start[i];
    y[7] = 0.3;
    y[8] = y[9] = 0.0;
    /* W = R^T w: the conjugate quaternion turns spatial into body axes. */
    double r[3] = {-q[1], -q[2], -q[3]}, c[3], cc[3];
    for (int i = 0; i < 3; i++) c[i] = r[(i + 1) % 3] * spin[(i + 2) % 3] - r[(i + 2) % 3] * spin[(i + 1) % 3];
    for (int i = 0; i < 3; i++) cc[i] = r[(i + 1) % 3] * c[(i + 2) % 3] - r[(i + 2) % 3] * c[(i + 1) % 3];
    for (int i = 0; i < 3; i++) y[10 + i] = spin[i] + 2.0 * (q[0] * c[i] + cc[i]);
}

/* The rotation of a quaternion of any length. */
static void rotation(const double *q, double r[3][3]) {
    double f = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = 3 - i - j;
            double turn = i == j ? 0.0 : ((j - i + 3) % 3 == 1 ? -q[0] * q[1 + k] : q[0] * q[1 + k]);
            r[i][j] = f * (q[1 + i] * q[1 + j] + turn);
            if (i == j) r[i][j] += 1.0 - f * (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        }
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

int cube_rates(double t, const double *y, double *dy) {
    (void)t;
    calls++;
    double r[3][3], l[3][3], f[3], moment[3][3];
    const double *q = y + 3, *w = y + 10;
    rotation(q, r);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int b = (j + 1) % 3, c = (j + 2) % 3;
            l[i][j] = r[i][b] * w[c] - r[i][c] * w[b]; /* R [W]x */
        }
    struct moments m;
    if (integrate(&m, y[2], r[2])) {
        for (int i = 0; i < CUBE_DIMENSION; i++) dy[i] = NAN;
        return 1;
    }
    loads(&m, y + 7, l, f, moment);
    for (int i = 0; i < 3; i++) {
        dy[i] = y[7 + i];
        dy[7 + i] = f[i] - (i == 2 ? GRAVITY : 0.0);
    }
    dy[3] = -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]);
    for (int i = 0; i < 3; i++) {
        int b = (i + 1) % 3, c = (i + 2) % 3;
        dy[4 + i] = 0.5 * (q[0] * w[i] + q[1 + b] * w[c] - q[1 + c] * w[b]);
        /* t_i = eps_ijk (R^T M)_kj; a cube's inertia is a multiple of 1, so that W x I W = 0. */
        double torque = 0.0;
        for (int k = 0; k < 3; k++) torque += r[k][c] * moment[k][b] - r[k][b] * moment[k][c];
        dy[10 + i] = torque / INERTIA;
    }
    return 0;
}

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
