// What the Rust library expects of a C library for WASI, and Debian's does not have. A page has no threads, links or permissions.
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int *__errno_location(void) { return &errno; }

// There are no links: a path that leads somewhere is a real one.
char *realpath(const char *path, char *into) {
    struct stat found;
    if (stat(path, &found) != 0) return NULL;
    return into ? strcpy(into, path) : strdup(path);
}

int fchmod(int file, mode_t mode) { return 0; }

// Without threads the one there is does everything.
int pthread_create(void *thread, const void *attributes, void *(*run)(void *), void *with) { return ENOTSUP; }
int pthread_attr_init(void *attributes) { return 0; }
int pthread_attr_setstacksize(void *attributes, size_t size) { return 0; }
int pthread_attr_destroy(void *attributes) { return 0; }
int pthread_join(void *thread, void **result) { return ENOTSUP; }
int pthread_detach(void *thread) { return ENOTSUP; }
