/* An importer in a few lines of C: the loaded library, instances with their logs, values by name. */
#ifndef UNIT_H
#define UNIT_H

#include "fmi2.h"

/* One pointer for each function of the library. */
typedef struct {
#define MEMBER(name) fmi2##name##TYPE *name;
    FMI2_FUNCTIONS(MEMBER)
#undef MEMBER
} Functions;

/* What the logger was told. */
typedef struct {
    int lines;
    fmi2Status status;
    char name[64];
    char category[64];
    char text[512];
} Log;

typedef struct {
    fmi2Component component;
    fmi2CallbackFunctions callbacks;
    Log log;
} Unit;

extern Functions fmi2;

/* Drive period of the default unit in s. */
extern const double PERIOD;

/* Loads the library and its description; ends the program if something is missing. */
void load(const char *library, const char *description);
void unload(void);
const char *own_guid(void);
fmi2ValueReference reference(const char *name);

/* Counts a failure unless `holds`, and says which it was. */
#define CHECK(holds) check((holds) != 0, #holds, __func__, __LINE__)
#define CLOSE(value, expected, tolerance)                                                          \
    check_close((value), (expected), (tolerance), #value, __func__, __LINE__)
#define OK(call) CHECK((call) == fmi2OK)
void check(int holds, const char *what, const char *function, int line);
void check_close(double value, double expected, double tolerance, const char *what,
                 const char *function, int line);
int failures(void);

/* Counts a failure unless `status` is fmi2Error, told in one line that names function and thing. */
void refused(Unit *unit, fmi2Status status, const char *function, const char *word);

Unit *make(const char *name);
void dispose(Unit *unit);
void begin(Unit *unit);
/* The unloaded machine on its periodic motion (Peterka 2003, point A), at drive angle 0. */
void set_unloaded(Unit *unit);
Unit *make_unloaded(void);
void set(Unit *unit, const char *name, double value);
void set_integer(Unit *unit, const char *name, int value);
double get(Unit *unit, const char *name);
int get_integer(Unit *unit, const char *name);
/* One communication step, which must succeed. */
void step(Unit *unit, double point, double size);

#endif
