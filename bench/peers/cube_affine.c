/* Rates of the soft cube: see cube.h.
 *
 *   m p'' = m g + f,   P'' J = M - V S,   J = m/12 1
 *   S = mu P + (lambda ln det P - mu) P^-T + 0.5 sym(P' P^-1) P^-T    (compressible neo-Hookean, viscous)
 *
 * Tractions are per deformed area: a face of normal e has |cof(P) e| times its area.
 */
#include "cube_moments.h"

#define MU 20.0
#define LAMBDA 100.0
#define VISCOSITY 0.5
#define EULER (1.0 / 12.0)

/* Columns b x c, c x a, a x b of the cofactor; the determinant. */
static double cofactor(const double *p, double *cof) {
    for (int k = 0; k < 3; k++) {
        const double *a = p + 3 * ((k + 1) % 3), *b = p + 3 * ((k + 2) % 3);
        cof[3 * k] = a[1] * b[2] - a[2] * b[1];
        cof[3 * k + 1] = a[2] * b[0] - a[0] * b[2];
        cof[3 * k + 2] = a[0] * b[1] - a[1] * b[0];
    }
    return p[0] * cof[0] + p[1] * cof[1] + p[2] * cof[2];
}

void cube_start(double *y) {
    const double axis[3] = {1.0, 0.7, 0.3}, spin[3] = {1.0, 0.5, 2.0};
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]), angle = 0.5;
    const double n[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
    double c = cos(angle), s = sin(angle), r[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = 3 - i - j;
            r[i][j] = i == j ? c + (1 - c) * n[i] * n[i] : (1 - c) * n[i] * n[j] + ((j - i + 3) % 3 == 1 ? -s : s) * n[k];
        }
    for (int i = 0; i < CUBE_DIMENSION; i++) y[i] = 0.0;
    y[2] = 2.0;
    y[12] = 0.3;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            int a = (i + 1) % 3, b = (i + 2) % 3;
            y[3 + 3 * k + i] = r[i][k];
            y[15 + 3 * k + i] = spin[a] * r[b][k] - spin[b] * r[a][k];
        }
}

int cube_rates(double t, const double *y, double *dy) {
    (void)t;
    calls++;
    const double *p = y + 3, *velocity = y + 12, *rate = y + 15;
    double cof[9], across[9], area[3], n[3], l[3][3], w[3][3], f[3], moment[3][3];
    double volume = cofactor(p, cof), inverse = 1.0 / volume;
    struct moments m;
    for (int k = 0; k < 3; k++) {
        const double *c = cof + 3 * k;
        area[k] = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
        n[k] = p[3 * k + 2];
    }
    if (!(volume > 0.0) || integrate(&m, y[2], n, area)) {
        for (int i = 0; i < CUBE_DIMENSION; i++) dy[i] = NAN;
        return 1;
    }
    for (int i = 0; i < 9; i++) across[i] = cof[i] * inverse;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            w[i][j] = rate[3 * j + i];
            l[i][j] = rate[i] * across[j] + rate[3 + i] * across[3 + j] + rate[6 + i] * across[6 + j];
        }
    loads(&m, velocity, w, f, moment);
    double pressure = LAMBDA * log(volume) - MU;
    for (int i = 0; i < 3; i++) {
        dy[i] = velocity[i];
        dy[12 + i] = f[i] - (i == 2 ? GRAVITY : 0.0);
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            double viscous = 0.0;
            for (int j = 0; j < 3; j++) viscous += 0.5 * (l[i][j] + l[j][i]) * across[3 * k + j];
            double stress = MU * p[3 * k + i] + pressure * across[3 * k + i] + VISCOSITY * viscous;
            dy[3 + 3 * k + i] = rate[3 * k + i];
            dy[15 + 3 * k + i] = (moment[i][k] - stress) / EULER;
        }
    return 0;
}
