/* The cube by SUNDIALS' CVODE: Adams with fixed-point iteration, BDF with a dense Newton method.
 *
 *   sundials REFERENCE
 *
 * REFERENCE has one line a rule: the state at t = 10 (13 numbers). Prints one line a run:
 *   solver rule rtol error milliseconds calls
 * error is the largest difference in a component; the time is the fastest of several runs, set-up included.
 */
#include "cube.h"

#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

enum solver { ADAMS, BDF, SOLVERS };
static const char *const names[SOLVERS] = {"cvode-adams", "cvode-bdf"};

static int rates(realtype t, N_Vector y, N_Vector dy, void *data) {
    (void)data;
    return cube_rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy)); /* 1: retry with a smaller step */
}

static void check(int flag, const char *what) {
    if (flag < 0) {
        fprintf(stderr, "%s failed with %d\n", what, flag);
        exit(1);
    }
}

static int by_cvode(SUNContext context, int solver, N_Vector y, double rtol) {
    void *memory = CVodeCreate(solver == ADAMS ? CV_ADAMS : CV_BDF, context);
    SUNMatrix matrix = NULL;
    SUNLinearSolver linear = NULL;
    SUNNonlinearSolver fixed_point = NULL;
    realtype t;
    check(CVodeInit(memory, rates, 0.0, y), "CVodeInit");
    check(CVodeSStolerances(memory, rtol, rtol), "tolerances");
    check(CVodeSetMaxNumSteps(memory, 10000000), "steps");
    check(CVodeSetMaxErrTestFails(memory, 100), "fails");
    if (solver == ADAMS) {
        fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
        check(CVodeSetNonlinearSolver(memory, fixed_point), "fixed point");
    } else {
        matrix = SUNDenseMatrix(CUBE_DIMENSION, CUBE_DIMENSION, context);
        linear = SUNLinSol_Dense(y, matrix, context);
        check(CVodeSetLinearSolver(memory, linear, matrix), "linear solver");
    }
    check(CVodeSetStopTime(memory, CUBE_END), "stop time");
    int flag = CVode(memory, CUBE_END, y, &t, CV_NORMAL);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    if (fixed_point) SUNNonlinSolFree(fixed_point);
    CVodeFree(&memory);
    return flag;
}

static void measure(SUNContext context, int solver, int rule, double rtol, const double *reference) {
    double fastest = INFINITY, spent = 0.0, error = 0.0;
    long calls = 0;
    N_Vector y = N_VNew_Serial(CUBE_DIMENSION, context);
    for (int run = 0; run < 15 && (run < 3 || spent < 1.0); run++) {
        cube_start(N_VGetArrayPointer(y));
        cube_calls();
        double start = cube_seconds();
        int flag = by_cvode(context, solver, y, rtol);
        double took = cube_seconds() - start;
        spent += took;
        if (took < fastest) fastest = took;
        calls = cube_calls();
        error = flag < 0 ? NAN : 0.0;
        for (int i = 0; i < CUBE_DIMENSION; i++)
            error = fmax(error, fabs(N_VGetArrayPointer(y)[i] - reference[i])) + (flag < 0 ? NAN : 0.0);
    }
    printf("%s %s %.0e %.3e %.4f %ld\n", names[solver], cube_rule_names[rule], rtol, error, 1e3 * fastest, calls);
    fflush(stdout);
    N_VDestroy(y);
}

int main(int count, char **arguments) {
    FILE *file = count == 2 ? fopen(arguments[1], "r") : NULL;
    if (!file) {
        fprintf(stderr, "usage: sundials REFERENCE\n");
        return 2;
    }
    SUNContext context;
    check(SUNContext_Create(NULL, &context), "context");
    for (int rule = 0; rule < CUBE_RULES; rule++) {
        double reference[CUBE_DIMENSION];
        for (int i = 0; i < CUBE_DIMENSION; i++)
            if (fscanf(file, "%lf", &reference[i]) != 1) return 2;
        cube_choose(rule);
        for (int solver = 0; solver < SOLVERS; solver++)
            for (int k = 5; k <= 13; k++)
                measure(context, solver, rule, pow(10.0, -k), reference);
    }
    SUNContext_Free(&context);
    fclose(file);
    return 0;
}
