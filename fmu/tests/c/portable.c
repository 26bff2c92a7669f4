/* Loads the library of an FMU, runs its default machine and prints what the mass did, with all
 * digits. The same source serves Linux, macOS and Windows.
 *
 *     portable LIBRARY GUID STOP_TIME STEP [NAME REFERENCE]...
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
static void *open_library(const char *path) {
    HMODULE library = LoadLibraryA(path);
    if (!library) fprintf(stderr, "error %lu of Windows\n", GetLastError());
    return (void *)library;
}
static void *find(void *library, const char *name) {
    return (void *)GetProcAddress((HMODULE)library, name);
}
static int close_library(void *library) { return !FreeLibrary((HMODULE)library); }
#else
#include <dlfcn.h>
static void *open_library(const char *path) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) fprintf(stderr, "%s\n", dlerror());
    return library;
}
static void *find(void *library, const char *name) { return dlsym(library, name); }
static int close_library(void *library) { return dlclose(library); }
#endif

typedef void *Component;
typedef unsigned int Reference;
typedef void (*Logger)(void *, const char *, int, const char *, const char *, ...);
typedef struct {
    Logger logger;
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, int);
    void *environment;
} Callbacks;

static void log_line(void *environment, const char *instance, int status, const char *category,
                     const char *format, ...) {
    va_list arguments;
    (void)environment;
    fprintf(stderr, "%s, status %d, %s: ", instance, status, category);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static void *required(void *library, const char *name) {
    void *function = find(library, name);
    if (!function) {
        fprintf(stderr, "%s is missing\n", name);
        exit(2);
    }
    return function;
}

static void check(int status, const char *call) {
    if (status != 0) {
        fprintf(stderr, "%s returned %d\n", call, status);
        exit(3);
    }
}

/* Runs one instance; the names and references follow on the command line. */
static void run(void *library, const char *guid, double stop_time, double step, int count,
                char **outputs) {
    static const Callbacks callbacks = {log_line, calloc, free, NULL, NULL};
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int,
                             int) = required(library, "fmi2Instantiate");
    int (*setup)(Component, int, double, double, int, double) =
        required(library, "fmi2SetupExperiment");
    int (*enter)(Component) = required(library, "fmi2EnterInitializationMode");
    int (*leave)(Component) = required(library, "fmi2ExitInitializationMode");
    int (*do_step)(Component, double, double, int) = required(library, "fmi2DoStep");
    int (*get_real)(Component, const Reference *, size_t, double *) =
        required(library, "fmi2GetReal");
    int (*terminate)(Component) = required(library, "fmi2Terminate");
    void (*free_instance)(Component) = required(library, "fmi2FreeInstance");

    Component component = instantiate("portable", 1, guid, NULL, &callbacks, 0, 0);
    if (!component) {
        fprintf(stderr, "no instance\n");
        exit(4);
    }
    check(setup(component, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
    check(enter(component), "fmi2EnterInitializationMode");
    check(leave(component), "fmi2ExitInitializationMode");
    long steps = (long)(stop_time / step + 0.5);
    for (long i = 0; i < steps; i++)
        check(do_step(component, (double)i * step, step, 1), "fmi2DoStep");
    for (int i = 0; i < count; i++) {
        Reference reference = (Reference)strtoul(outputs[2 * i + 1], NULL, 10);
        double value;
        check(get_real(component, &reference, 1, &value), "fmi2GetReal");
        printf("%s %.17g\n", outputs[2 * i], value);
    }
    check(terminate(component), "fmi2Terminate");
    free_instance(component);
}

int main(int argc, char **argv) {
    if (argc < 5 || argc % 2 == 0) {
        fprintf(stderr, "usage: %s LIBRARY GUID STOP_TIME STEP [NAME REFERENCE]...\n", argv[0]);
        return 1;
    }
    void *library = open_library(argv[1]);
    if (!library) {
        fprintf(stderr, "%s cannot be loaded\n", argv[1]);
        return 1;
    }
    run(library, argv[2], atof(argv[3]), atof(argv[4]), (argc - 5) / 2, argv + 5);
    return close_library(library);
}
