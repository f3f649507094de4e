/* Rates of the rigid cube: see cube.h. */
#include "cube_moments.h"

#define INERTIA (1.0 / 6.0)

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
    static const double area[3] = {1.0, 1.0, 1.0};
    if (integrate(&m, y[2], r[2], area)) {
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
