/* What calls cost, in ns: medians of repeated runs.
 *
 *     bench LIBRARY DESCRIPTION
 */
#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define RUNS 41

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static int by_size(const void *one, const void *other)
{
    double difference = *(const double *)one - *(const double *)other;
    return (difference > 0) - (difference < 0);
}

typedef struct {
    Unit *unit;
    fmi2FMUstate start;
    fmi2FMUstate copy;
    size_t size;
    char *bytes;
    double from;
    double length;
    fmi2ValueReference outputs[3];
    fmi2ValueReference force;
} Bench;

/* Times `calls` repetitions; each run begins at the snapshot. */
static double median(const char *what, Bench *bench, void (*work)(Bench *, long), long calls)
{
    double times[RUNS];
    for (int run = 0; run < RUNS; run++) {
        OK(fmi2.SetFMUstate(bench->unit->component, bench->start));
        double begin = now();
        work(bench, calls);
        times[run] = (now() - begin) / (double)calls;
    }
    qsort(times, RUNS, sizeof *times, by_size);
    printf("%-58s %10.1f ns (best %.1f)\n", what, times[RUNS / 2], times[0]);
    return times[RUNS / 2];
}

/* Steps without going back: `calls` of them from where the snapshot is. */
static void steps(Bench *bench, long calls)
{
    double time = bench->from;
    for (long k = 0; k < calls; k++) {
        OK(fmi2.DoStep(bench->unit->component, time, bench->length, fmi2True));
        time += bench->length;
    }
}

static void restore_and_step(Bench *bench, long calls)
{
    for (long k = 0; k < calls; k++) {
        OK(fmi2.SetFMUstate(bench->unit->component, bench->start));
        OK(fmi2.DoStep(bench->unit->component, bench->from, bench->length, fmi2True));
    }
}

static void read_outputs(Bench *bench, long calls)
{
    double values[3];
    for (long k = 0; k < calls; k++)
        OK(fmi2.GetReal(bench->unit->component, bench->outputs, 3, values));
}

static void get_state(Bench *bench, long calls)
{
    for (long k = 0; k < calls; k++)
        OK(fmi2.GetFMUstate(bench->unit->component, &bench->copy));
}

static void set_state(Bench *bench, long calls)
{
    for (long k = 0; k < calls; k++)
        OK(fmi2.SetFMUstate(bench->unit->component, bench->start));
}

static void serialize(Bench *bench, long calls)
{
    for (long k = 0; k < calls; k++) {
        OK(fmi2.SerializedFMUstateSize(bench->unit->component, bench->start, &bench->size));
        OK(fmi2.SerializeFMUstate(bench->unit->component, bench->start, bench->bytes,
                                  bench->size));
    }
}

static void deserialize(Bench *bench, long calls)
{
    for (long k = 0; k < calls; k++) {
        fmi2FMUstate state = NULL;
        OK(fmi2.DeSerializeFMUstate(bench->unit->component, bench->bytes, bench->size, &state));
        OK(fmi2.FreeFMUstate(bench->unit->component, &state));
    }
}

static void directional(Bench *bench, long calls)
{
    double seed = 1.0, value;
    for (long k = 0; k < calls; k++)
        OK(fmi2.GetDirectionalDerivative(bench->unit->component, bench->outputs, 1, &bench->force,
                                         1, &seed, &value));
}

/* Puts the snapshot at `time` of the periodic motion; steps begin there. */
static void go_to(Bench *bench, double time)
{
    double impact, position;
    dispose(bench->unit);
    bench->unit = make_unloaded();
    step(bench->unit, 0.0, PERIOD);
    impact = get(bench->unit, "impact.time");
    bench->from = PERIOD + impact + time;
    step(bench->unit, PERIOD, bench->from - PERIOD);
    position = get(bench->unit, "position");
    CHECK((position > 10.0) == (time > 0.0 && time < 0.05));
    OK(fmi2.GetFMUstate(bench->unit->component, &bench->start));
}

static void small_steps(Bench *bench)
{
    bench->length = 1e-3;
    go_to(bench, 0.5);
    median("fmi2DoStep, 1e-3 s, free flight", bench, steps, 3000);
    bench->length = 1e-6;
    go_to(bench, 0.01);
    median("fmi2DoStep, 1e-6 s, in contact", bench, steps, 3000);
    bench->length = 1e-3;
    go_to(bench, -5e-4);
    double both = median("fmi2SetFMUstate and fmi2DoStep, 1e-3 s, one impact", bench,
                         restore_and_step, 3000);
    double set = median("fmi2SetFMUstate", bench, set_state, 3000);
    printf("%-58s %10.1f ns\n", "fmi2DoStep, 1e-3 s, one impact (difference)", both - set);
}

/* One step over a thousand periods, each with two crossings. */
static void long_step(Bench *bench)
{
    bench->length = 1000.0 * PERIOD;
    go_to(bench, 0.5);
    double time = median("fmi2DoStep over 1,000 periods", bench, steps, 1);
    printf("%-58s %10.1f ns\n", "  for each of its 2,000 crossings", time / 2000.0);
}

static void the_rest(Bench *bench)
{
    bench->length = PERIOD;
    go_to(bench, -5e-4);
    step(bench->unit, bench->from, PERIOD);
    OK(fmi2.GetFMUstate(bench->unit->component, &bench->start));
    median("fmi2GetReal of position, velocity, acceleration", bench, read_outputs, 3000);
    median("fmi2GetFMUstate over an old one", bench, get_state, 3000);
    median("fmi2SetFMUstate", bench, set_state, 3000);
    OK(fmi2.SerializedFMUstateSize(bench->unit->component, bench->start, &bench->size));
    bench->bytes = malloc(bench->size);
    median("size and fmi2SerializeFMUstate", bench, serialize, 1000);
    median("fmi2DeSerializeFMUstate and fmi2FreeFMUstate", bench, deserialize, 1000);
    printf("%-58s %10lu bytes\n", "a serialised state", (unsigned long)bench->size);
    free(bench->bytes);
    median("fmi2GetDirectionalDerivative over a period, one impact", bench, directional, 1000);
}

int main(int count, char **arguments)
{
    if (count != 3) {
        fprintf(stderr, "usage: bench LIBRARY DESCRIPTION\n");
        return 2;
    }
    load(arguments[1], arguments[2]);
    Bench bench = {0};
    bench.unit = make_unloaded();
    bench.outputs[0] = reference("position");
    bench.outputs[1] = reference("velocity");
    bench.outputs[2] = reference("acceleration");
    bench.force = reference("force");
    small_steps(&bench);
    long_step(&bench);
    the_rest(&bench);
    OK(fmi2.FreeFMUstate(bench.unit->component, &bench.start));
    OK(fmi2.FreeFMUstate(bench.unit->component, &bench.copy));
    dispose(bench.unit);
    unload();
    return failures() != 0;
}
