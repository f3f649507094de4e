/* The cube of the comparison, rigid or soft: side 1, density 1, g = 1, one plane z = 0, three laws.
 *
 *   m p'' = m g + f,   I W' = t - W x I W,   q' = q o (0, W)/2,   P = R(q/|q|)
 *   traction = alpha d^-6 n - beta d^-3 (n (x) n) w - beta d^-3 (1 - n (x) n) w,   d the gap, w the velocity
 *
 * State, as in the library: p (3), quaternion (4), p' (3), W in body axes (3); with CUBE_AFFINE, of the soft cube of
 * `cube_affine.c`, p (3), P (9, column by column), p' (3), P' (9). The integrals over the six faces are
 * sums over one of the rules below, whose points and weights are the only thing that differs between them.
 */
#ifndef CUBE_H
#define CUBE_H

#ifdef CUBE_AFFINE
#define CUBE_DIMENSION 24
#else
#define CUBE_DIMENSION 13
#endif
#define CUBE_END 10.0

enum cube_rule {
    CUBE_GAUSS_8,    /* 8 x 8 Gauss points a face, 384 in all */
    CUBE_GRADED_16,  /* 16 x 16 a face, graded in log d from its lowest corner, 1536 in all */
    CUBE_GAUSS_48,   /* 48 x 48 a face, 13824 in all */
    CUBE_RULES
};

extern const char *const cube_rule_names[CUBE_RULES];

/* Chooses the rule of the calls that follow; not thread-safe. */
void cube_choose(int rule);

/* How many numbers the state has. */
int cube_dimension(void);

/* The state at t = 0. */
void cube_start(double *y);

/* The rates; returns 1, and leaves NaN, where a point of the rule (graded: a corner) is on or below the plane. */
int cube_rates(double t, const double *y, double *dy);

/* The time that this process has spent on a processor, in seconds: on a shared machine wall time says little. */
double cube_seconds(void);

/* The number of calls of cube_rates since this was last called. */
long cube_calls(void);

#endif
