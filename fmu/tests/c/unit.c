#include "unit.h"

#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Functions fmi2;
const double PERIOD = 2.0 * 3.14159265358979323846 / 1.15;

static void *library;
static char *description;
static char guid[64];
static int failed;

static void quit(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    exit(2);
}

static char *read_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        quit(path, "cannot be opened");
    fseek(file, 0, SEEK_END);
    long length = ftell(file);
    rewind(file);
    char *text = malloc((size_t)length + 1);
    if (!text || fread(text, 1, (size_t)length, file) != (size_t)length)
        quit(path, "cannot be read");
    text[length] = '\0';
    fclose(file);
    return text;
}

/* What stands behind `key` in quotes, after `from`. */
static void attribute(const char *from, const char *key, char *value, size_t room)
{
    const char *start = strstr(from, key);
    if (!start)
        quit(key, "is not in the description");
    start += strlen(key) + 1;
    size_t length = strcspn(start, "\"");
    if (length >= room)
        quit(key, "is too long");
    memcpy(value, start, length);
    value[length] = '\0';
}

static void *symbol(const char *name)
{
    void *found = dlsym(library, name);
    if (!found)
        quit(name, "is not exported");
    return found;
}

void load(const char *path, const char *xml)
{
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        quit(path, dlerror());
/* POSIX way of making a function pointer of what dlsym returns. */
#define RESOLVE(name) *(void **)&fmi2.name = symbol("fmi2" #name);
    FMI2_FUNCTIONS(RESOLVE)
#undef RESOLVE
    description = read_text(xml);
    attribute(description, "guid=", guid, sizeof guid);
}

void unload(void)
{
    free(description);
    if (dlclose(library))
        quit("dlclose", dlerror());
}

const char *own_guid(void)
{
    return guid;
}

fmi2ValueReference reference(const char *name)
{
    char key[128], number[16];
    snprintf(key, sizeof key, "<ScalarVariable name=\"%s\"", name);
    const char *row = strstr(description, key);
    if (!row)
        quit(name, "is no variable");
    attribute(row, "valueReference=", number, sizeof number);
    return (fmi2ValueReference)strtoul(number, NULL, 10);
}

void check(int holds, const char *what, const char *function, int line)
{
    if (holds)
        return;
    failed++;
    fprintf(stderr, "%s, line %d: %s does not hold\n", function, line, what);
}

void check_close(double value, double expected, double tolerance, const char *what,
                 const char *function, int line)
{
    if (fabs(value - expected) <= tolerance)
        return;
    failed++;
    fprintf(stderr, "%s, line %d: %s = %.17g, expected %.17g within %g\n", function, line, what,
            value, expected, tolerance);
}

int failures(void)
{
    return failed;
}

void refused(Unit *unit, fmi2Status status, const char *function, const char *word)
{
    const Log *log = &unit->log;
    int as_meant = status == fmi2Error && log->lines == 1 && log->status == fmi2Error &&
                   !strcmp(log->category, "errors") && !strcmp(log->name, "unit") &&
                   !strncmp(log->text, function, strlen(function)) && strstr(log->text, word);
    if (!as_meant) {
        failed++;
        fprintf(stderr, "%s (%s): status %d, %d lines, last one: %d %s %s: %s\n", function, word,
                (int)status, log->lines, (int)log->status, log->name, log->category, log->text);
    }
    unit->log.lines = 0;
}

static void logger(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                   fmi2String category, fmi2String format, ...)
{
    Log *log = &((Unit *)environment)->log;
    va_list arguments;
    log->lines++;
    log->status = status;
    snprintf(log->name, sizeof log->name, "%s", name);
    snprintf(log->category, sizeof log->category, "%s", category);
    va_start(arguments, format);
    vsnprintf(log->text, sizeof log->text, format, arguments);
    va_end(arguments);
}

Unit *make(const char *name)
{
    Unit *unit = calloc(1, sizeof *unit);
    if (!unit)
        quit("calloc", "no memory");
    unit->callbacks.logger = logger;
    unit->callbacks.allocateMemory = calloc;
    unit->callbacks.freeMemory = free;
    unit->callbacks.componentEnvironment = unit;
    unit->component = fmi2.Instantiate(name, fmi2CoSimulation, guid, NULL, &unit->callbacks,
                                       fmi2False, fmi2False);
    if (!unit->component)
        quit("fmi2Instantiate", unit->log.text);
    return unit;
}

void dispose(Unit *unit)
{
    CHECK(unit->log.lines == 0);
    fmi2.FreeInstance(unit->component);
    free(unit);
}

void begin(Unit *unit)
{
    OK(fmi2.SetupExperiment(unit->component, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    OK(fmi2.EnterInitializationMode(unit->component));
    OK(fmi2.ExitInitializationMode(unit->component));
}

void set_unloaded(Unit *unit)
{
    set(unit, "piercing.thickness", 0.0);
    set(unit, "piercing.travel", 0.0);
    set(unit, "initial.position", 6.901267951548);
    set(unit, "initial.velocity", 9.516655745459);
}

Unit *make_unloaded(void)
{
    Unit *unit = make("unit");
    set_unloaded(unit);
    begin(unit);
    return unit;
}

void set(Unit *unit, const char *name, double value)
{
    fmi2ValueReference vr = reference(name);
    OK(fmi2.SetReal(unit->component, &vr, 1, &value));
}

void set_integer(Unit *unit, const char *name, int value)
{
    fmi2ValueReference vr = reference(name);
    OK(fmi2.SetInteger(unit->component, &vr, 1, &value));
}

double get(Unit *unit, const char *name)
{
    fmi2ValueReference vr = reference(name);
    double value = NAN;
    OK(fmi2.GetReal(unit->component, &vr, 1, &value));
    return value;
}

int get_integer(Unit *unit, const char *name)
{
    fmi2ValueReference vr = reference(name);
    int value = -1;
    OK(fmi2.GetInteger(unit->component, &vr, 1, &value));
    return value;
}

void step(Unit *unit, double point, double size)
{
    OK(fmi2.DoStep(unit->component, point, size, fmi2True));
}
