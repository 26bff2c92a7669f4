/* Lets one call of a program fail: the n-th write to a file, fsync, rename, creation, change of length or allocation.
 *
 * Loaded before the C library (LD_PRELOAD). SOFTSTOP_FAULT is "kind number errno lasting": the call of that number, and
 * with lasting = 1 each later one, fails with errno; a write with errno 0 writes half. SOFTSTOP_FAULT_COUNTS names a file
 * that the numbers of calls are written to at the end. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { WRITE, SYNC, RENAME, CREATE, LENGTH, ALLOC, KINDS };
static const char *const NAMES[KINDS] = {"write", "sync", "rename", "create", "length", "alloc"};
static unsigned long counts[KINDS], number;
static int kind = -1, code, lasting;

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);

__attribute__((constructor)) static void begin(void)
{
    char name[16] = "";
    const char *fault = getenv("SOFTSTOP_FAULT");
    if (fault == NULL || sscanf(fault, "%15s %lu %d %d", name, &number, &code, &lasting) != 4)
        return;
    for (int one = 0; one < KINDS; ++one)
        if (strcmp(name, NAMES[one]) == 0)
            kind = one;
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("SOFTSTOP_FAULT_COUNTS");
    FILE *file = path == NULL ? NULL : fopen(path, "w");
    if (file == NULL)
        return;
    for (int one = 0; one < KINDS; ++one)
        fprintf(file, "%s %lu\n", NAMES[one], counts[one]);
    fclose(file);
}

static int fails(enum kind of)
{
    unsigned long now = __atomic_add_fetch(&counts[of], 1, __ATOMIC_RELAXED);
    if ((int)of != kind || (lasting ? now < number : now != number))
        return 0;
    errno = code;
    return 1;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define ANSWER(of, name, ...) return fails(of) ? -1 : NEXT(name)(__VA_ARGS__)

ssize_t write(int file, const void *bytes, size_t count)
{
    if (file > 2 && fails(WRITE)) {
        if (code != 0)
            return -1;
        count -= count / 2;
    }
    return NEXT(write)(file, bytes, count);
}

ssize_t writev(int file, const struct iovec *parts, int count)
{
    if (file > 2 && fails(WRITE)) {
        if (code != 0)
            return -1;
        count = 1;
    }
    return NEXT(writev)(file, parts, count);
}

int fsync(int file) { ANSWER(SYNC, fsync, file); }
int fdatasync(int file) { ANSWER(SYNC, fdatasync, file); }
int rename(const char *from, const char *to) { ANSWER(RENAME, rename, from, to); }
int ftruncate(int file, off_t length) { ANSWER(LENGTH, ftruncate, file, length); }
int ftruncate64(int file, off64_t length) { ANSWER(LENGTH, ftruncate64, file, length); }
int mkdir(const char *path, mode_t mode);
int mkdir(const char *path, mode_t mode) { ANSWER(CREATE, mkdir, path, mode); }

int open64(const char *path, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_CREAT) != 0 && fails(CREATE) ? -1 : NEXT(open64)(path, flags, mode);
}

void *malloc(size_t size) { return fails(ALLOC) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return fails(ALLOC) ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return fails(ALLOC) ? NULL : __libc_realloc(old, size); }
