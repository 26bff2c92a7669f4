/* Memory of the unit (Linux: reads /proc/self).
 *
 *     memory LIBRARY DESCRIPTION cycles N   loads and unloads the library N times
 *     memory LIBRARY DESCRIPTION crowd N    keeps N running instances at a time
 */
#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Cycles until allocator and loader have all the memory that they keep. */
#define WARM_UP 500

static long resident_kib(void)
{
    long whole = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    CHECK(file && fscanf(file, "%ld %ld", &whole, &resident) == 2);
    if (file)
        fclose(file);
    return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

/* Whether a file is still mapped into this process. */
static int is_mapped(const char *path)
{
    char line[1024], *real = realpath(path, NULL);
    int mapped = 0;
    FILE *file = fopen("/proc/self/maps", "r");
    CHECK(real && file);
    while (real && file && fgets(line, sizeof line, file))
        mapped |= strstr(line, real) != NULL;
    if (file)
        fclose(file);
    free(real);
    return mapped;
}

/* A short life with steps, an error, and a snapshot that goes over bytes. */
static void live(void)
{
    Unit *unit = make("unit");
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    begin(unit);
    step(unit, 0.0, 10.0);
    refused(unit, fmi2.DoStep(unit->component, 0.0, 1.0, fmi2True), "fmi2DoStep", "last step ended");
    OK(fmi2.GetFMUstate(unit->component, &state));
    OK(fmi2.SerializedFMUstateSize(unit->component, state, &size));
    char *bytes = malloc(size);
    OK(fmi2.SerializeFMUstate(unit->component, state, bytes, size));
    OK(fmi2.DeSerializeFMUstate(unit->component, bytes, size, &copy));
    bytes[size - 1] ^= 1;
    fmi2FMUstate none = NULL;
    refused(unit, fmi2.DeSerializeFMUstate(unit->component, bytes, size, &none),
            "fmi2DeSerializeFMUstate", "altered");
    OK(fmi2.SetFMUstate(unit->component, copy));
    free(bytes);
    OK(fmi2.FreeFMUstate(unit->component, &state));
    OK(fmi2.FreeFMUstate(unit->component, &copy));
    dispose(unit);
}

static void cycles(const char *library, const char *description, long count)
{
    long warm = 0;
    for (long k = 0; k < count; k++) {
        if (k == WARM_UP)
            warm = resident_kib();
        load(library, description);
        live();
        unload();
    }
    CHECK(count > WARM_UP);
    CHECK(!is_mapped(library));
    long end = resident_kib();
    printf("resident after %d cycles: %ld KiB, after %ld: %ld KiB\n", WARM_UP, warm, count, end);
    CHECK(end - warm <= 256);
}

static void crowd(const char *library, const char *description, long count)
{
    load(library, description);
    live();
    Unit **units = calloc((size_t)count, sizeof *units);
    long before = resident_kib();
    for (long k = 0; k < count; k++) {
        units[k] = make("unit");
        begin(units[k]);
        step(units[k], 0.0, 10.0);
    }
    long end = resident_kib();
    double each = 1024.0 * (double)(end - before) / (double)count - (double)sizeof(Unit);
    printf("%ld instances: %ld KiB, %.0f bytes each without the importer's own\n", count,
           end - before, each);
    CHECK(each < 16384.0);
    double position = get(units[0], "position");
    for (long k = 0; k < count; k++) {
        CHECK(get(units[k], "position") == position);
        dispose(units[k]);
    }
    free(units);
    unload();
}

int main(int count, char **arguments)
{
    if (count == 5 && !strcmp(arguments[3], "cycles"))
        cycles(arguments[1], arguments[2], strtol(arguments[4], NULL, 10));
    else if (count == 5 && !strcmp(arguments[3], "crowd"))
        crowd(arguments[1], arguments[2], strtol(arguments[4], NULL, 10));
    else {
        fprintf(stderr, "usage: memory LIBRARY DESCRIPTION cycles|crowd N\n");
        return 2;
    }
    return failures() != 0;
}
