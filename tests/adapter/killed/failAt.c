// SPDX-License-Identifier: GPL-3.0-or-later

// A library to be preloaded: the FAIL_AT-th operation that changes files whose path
// holds FAIL_IN kills the program, or fails with the error of the number FAIL_WITH. A
// write that does so has written half. FAIL_LINKS: no file gets a second name. FAIL_LOG
// is a file that gets a line for each operation.

#define _GNU_SOURCE

#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// The function of this name that the program would have called.
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

struct Opened
{
    FILE* file;
    char path[4096];
};

static struct Opened opened[16];

static struct Opened* find(FILE* file)
{
    for (int i = 0; i < 16; ++i)
    {
        if (opened[i].file == file)
        {
            return &opened[i];
        }
    }
    return NULL;
}

static int isMeant(const char* path)
{
    const char* part = getenv("FAIL_IN");
    return part && path && strstr(path, part);
}

// Is this operation the one that fails?
static int isDue(const char* operation, const char* path)
{
    static int n = 0;
    const char* log = getenv("FAIL_LOG");
    const char* at = getenv("FAIL_AT");
    if (!isMeant(path))
    {
        return 0;
    }
    ++n;
    if (log)
    {
        FILE* to = NEXT(fopen)(log, "a");
        fprintf(to, "%s %s\n", operation, path);
        NEXT(fclose)(to);
    }
    return at && atoi(at) == n;
}

// The operation fails, or the program ends here.
static int fails(void)
{
    const char* with = getenv("FAIL_WITH");
    if (!with)
    {
        kill(getpid(), SIGKILL);
        pause();
    }
    errno = atoi(with);
    return -1;
}

FILE* fopen(const char* path, const char* mode)
{
    struct Opened* slot = find(NULL);
    const int writes = strpbrk(mode, "wa") && isMeant(path);
    if (writes && isDue("fopen", path))
    {
        fails();
        return NULL;
    }
    FILE* file = NEXT(fopen)(path, mode);
    if (file && writes && slot)
    {
        slot->file = file;
        strncpy(slot->path, path, sizeof slot->path - 1);
    }
    return file;
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file)
{
    struct Opened* slot = find(file);
    if (slot && isDue("fwrite", slot->path))
    {
        const size_t half = NEXT(fwrite)(bytes, 1, size * count / 2, file);
        fflush(file);
        fails();
        return half / size;
    }
    return NEXT(fwrite)(bytes, size, count, file);
}

int fclose(FILE* file)
{
    struct Opened* slot = find(file);
    if (!slot)
    {
        return NEXT(fclose)(file);
    }
    const int due = isDue("fclose", slot->path);
    if (due)
    {
        fails();
    }
    const int reason = errno;
    slot->file = NULL;
    const int result = NEXT(fclose)(file);
    errno = due ? reason : errno;
    return due ? EOF : result;
}

int link(const char* from, const char* to)
{
    if (getenv("FAIL_LINKS") && isMeant(to))
    {
        errno = EPERM;
        return -1;
    }
    return isDue("link", to) ? fails() : NEXT(link)(from, to);
}

int rename(const char* from, const char* to)
{
    return isDue("rename", to) ? fails() : NEXT(rename)(from, to);
}

int remove(const char* path) { return isDue("remove", path) ? fails() : NEXT(remove)(path); }

int unlink(const char* path) { return isDue("unlink", path) ? fails() : NEXT(unlink)(path); }

int rmdir(const char* path) { return isDue("rmdir", path) ? fails() : NEXT(rmdir)(path); }

int mkdir(const char* path, mode_t mode)
{
    return isDue("mkdir", path) ? fails() : NEXT(mkdir)(path, mode);
}
